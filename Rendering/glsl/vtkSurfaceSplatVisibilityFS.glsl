//VTK::System::Dec

// First pass: the depth of the nearest splats, which the vertex stage has moved away from the eye, and
// the side from which the nearest is seen. What lies in front of this depth belongs to the surface
// that is seen.

//VTK::Output::Dec

//Splat::Fragment::Dec

void main()
{
  if (splatOutside())
  {
    discard;
  }
  gl_FragData[0] = vec4(0.5 + 0.5 * splatSeenFromSide);
}
