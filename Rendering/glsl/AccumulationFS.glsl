//VTK::System::Dec

// Second pass (M. Botsch et al., High-Quality Surface Splatting on Today's GPUs, 2005), with additive blending, tested
// against the first pass's depth: weighted sums of normal, offset, depth and colour over the visible surface's splats.

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
