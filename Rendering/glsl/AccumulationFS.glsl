//VTK::System::Dec

// Second pass (M. Botsch et al., High-Quality Surface Splatting on Today's GPUs, 2005), with additive blending, tested
// against the first pass's depth: weighted sums of normal, offset, depth and colour over the visible surface's splats;
// where it matters that cells end, also of the colours' weights and of the lines there.

//VTK::Output::Dec

//Splat::Fragment::Dec

uniform sampler2D splatSeen;
#if SPLAT_LAYERS
uniform sampler2D splatVisibleDepth;
uniform float splatNearer; // 1: what lies before the visible depth is seen; -1: what lies behind it
#endif
uniform samplerBuffer splatColor; // RGBA, or lookup coordinates (position in the table, row)

void main()
{
  bool outside = splatOutside() || splatIsOfOther(splatSeen);
#if SPLAT_HAS_BORDERS
  float beyondCell = splatBeyondCell();
#endif
  if (outside)
  {
    discard;
  }
#if SPLAT_LAYERS
  splatShare *= splatLayerShare(texelFetch(splatVisibleDepth, ivec2(gl_FragCoord.xy), 0).r, splatNearer);
#endif
  float weight = splatWeight();
  float colorWeight = weight;
  gl_FragData[0] = weight * vec4(splatSurfaceNormal(), 1.0);
  gl_FragData[1] = weight * vec4(splatOffsetVC, splatDepthVC);
  //Splat::Border::Impl
  //Splat::Color::Impl
}
