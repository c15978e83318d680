//VTK::System::Dec

// Third pass, where colours must not be mixed, particles are selected or there are ghosts: the number of the particle with the largest
// weight at a pixel. The pass has a depth buffer of its own, which compares logarithms of weights.

//Splat::Fragment::Dec

uniform sampler2D splatSeen;
uniform sampler2D splatVisibleDepth;
uniform float splatNearer; // 1: what lies before the visible depth is seen; -1: what lies behind it

out uint splatNumber; // of the particle, from 1 on; 0 where there is none; the highest bit is set for ghosts

void main()
{
  float visible = texelFetch(splatVisibleDepth, ivec2(gl_FragCoord.xy), 0).r;
  bool outside = splatOutside() || splatIsOfOther(splatSeen) ||
    splatNearer * (gl_FragCoord.z - visible) > 0.0;
#if SPLAT_HAS_BORDERS
  float cellShare = splatCellShare(splatBeyondCell());
#else
  const float cellShare = 1.0;
#endif
  if (outside)
  {
    discard;
  }
#if SPLAT_LAYERS
  splatShare *= splatLayerShare(visible, splatNearer);
#endif
#if SPLAT_GHOSTS
  splatShare *= splatGhost == 1 ? SPLAT_GHOST_SHARE : 1.0;
#endif
  // Logarithms tell small weights apart, where 1 minus the weight would be rounded to 1. `least` is smaller than all
  // weights above 0 in float32: the smallest one, with the largest sharpness, in a gap and beyond its cell, is about 2e-23. The factor
  // 0.99 keeps weights of 0 nearer than the cleared depth, 1.
  const float least = 1e-26;
  gl_FragDepth = 0.99 * log(max(cellShare * splatWeight(), least)) / log(least);
  splatNumber = uint(splatParticle) + 1u;
#if SPLAT_GHOSTS
  splatNumber |= uint(splatGhost) << 31;
#endif
}
