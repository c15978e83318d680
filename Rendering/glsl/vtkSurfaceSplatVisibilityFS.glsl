//VTK::System::Dec

// First pass: the depth of the nearest splats, which the vertex stage has moved away from the eye, that
// there is one, and whether it is seen from outward. What lies in front of this depth belongs to the surface
// that is seen. The outermost rim of a splat counts too little to be seen alone.

//VTK::Output::Dec

//Splat::Fragment::Dec

void main()
{
  if (splatOutside() || splatAtRim())
  {
    discard;
  }
  gl_FragData[0] = vec4(1.0, 0.5 + 0.5 * splatSeenFromSide, 0.0, 0.0);
}
