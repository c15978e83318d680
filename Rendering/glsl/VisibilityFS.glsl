//VTK::System::Dec

// First pass: the depth of the nearest splat at each pixel, that there is one, from which side it is seen, and which
// isovalue it has. A splat has no part in it beyond its reach, where it counts too little to be seen alone.

//VTK::Output::Dec

//Splat::Fragment::Dec

void main()
{
  if (splatOutside() || splatBeyondReach())
  {
    discard;
  }
#if SPLAT_APART && (SPLAT_POINTS || SPLAT_CURVED)
  gl_FragDepth = splatOwnDepth();
#endif
  gl_FragData[0] = vec4(1.0, splatMark, 0.0, 0.0);
}
