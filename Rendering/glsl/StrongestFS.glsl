//VTK::System::Dec

// Third pass, where colours must not be mixed or particles are selected: the number of the particle
// that counts most at a pixel. Its own depth buffer compares logarithms of weights.

//Splat::Fragment::Dec

uniform sampler2D splatSeen;
uniform sampler2D splatVisibleDepth;
uniform float splatNearer; // 1: what lies before the visible depth is seen; -1: what lies behind it

out uint splatNumber; // of the particle, from 1 on; 0 where there is none

void main()
{
  float visible = texelFetch(splatVisibleDepth, ivec2(gl_FragCoord.xy), 0).r;
  if (splatOutside() || splatIsOfOther(splatSeen) ||
    splatNearer * (gl_FragCoord.z - visible) > 0.0)
  {
    discard;
  }
  // Where weights fall steeply, 1 minus a weight would be 1 although the splat is the only one.
  const float least = 1e-26;
  gl_FragDepth = 0.99 * log(max(splatWeight(), least)) / log(least);
  splatNumber = uint(splatParticle) + 1u;
}
