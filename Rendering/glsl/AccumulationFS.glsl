//VTK::System::Dec

// Second pass, with additive blending and the first pass's depth to test against: weighted sums of
// what the splats of the surface that is seen know of it (Botsch et al. 2005).

//VTK::Output::Dec

//Splat::Fragment::Dec

uniform sampler2D splatSeen;
uniform samplerBuffer splatColor; // RGBA, or lookup coordinates (position in the table, row)

void main()
{
  if (splatOutside() || splatIsOfOther(splatSeen))
  {
    discard;
  }
  float weight = splatWeight();
  gl_FragData[0] = weight * vec4(splatSurfaceNormal(), 1.0);
  gl_FragData[1] = weight * vec4(splatOffsetVC, splatDepthVC);
  //Splat::Color::Impl
}
