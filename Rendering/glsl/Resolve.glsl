// The resolve pass, inserted into VTK's fragment shader behind definitions of SPLAT_OUTLINE, SPLAT_FOLDS (only
// with the former) and SPLAT_BACK_LAYER (0 or 1): what the sums say of the surface at a pixel.

//Splat::Ray::Dec

uniform sampler2D splatNormalWeight; // sums of weight * normal (VC, outward), weight
uniform sampler2D splatOffsetDepth;  // sums of weight * offset from the particle (VC), weight * z
uniform sampler2D splatColorSum;     // sums of weight * colour or lookup coordinates
uniform sampler2D splatSeen;         // r: 1 where there is surface; g: above 0.5 where it is seen from outward
uniform usampler2D splatStrongest; // number of the particle that counts most, from 1 on
uniform float splatLeastWeight; // pixels with surface have more than this summed weight, others none

bool splatHasSurface(ivec2 texel)
{
  return texelFetch(splatSeen, texel, 0).r > 0.5;
}

#if SPLAT_OUTLINE
//Splat::Outline::Dec
#endif

struct SplatSurface
{
  bool covered;
  float coverage; // of the pixel, 0 to 1; less than 1 at smoothed outlines
  ivec2 texel;
  float weight;
  vec3 positionVC;
  vec3 normalVC; // of the side that is seen
  float seenFrom; // 1: from outward
  float depth;    // for the depth buffer
};

#if SPLAT_BACK_LAYER
uniform sampler2D splatFrontNormalWeight; // as above, of the front layer
uniform sampler2D splatFrontOffsetDepth;
uniform sampler2D splatFrontSeen;
uniform float splatLayerDistance; // VC; layers closer than this are one

// Where the view ray meets one surface only, the back layer is the front layer once more.
bool splatIsFrontLayer(ivec2 texel, float z, float seenFrom, float towardsEye)
{
  float weight = texelFetch(splatFrontNormalWeight, texel, 0).w;
  float zFront = texelFetch(splatFrontOffsetDepth, texel, 0).w / max(weight, splatLeastWeight);
  float seenFromFront = texelFetch(splatFrontSeen, texel, 0).g < 0.5 ? -1.0 : 1.0;
  return seenFrom == seenFromFront && (zFront - z) * max(towardsEye, 0.1) < splatLayerDistance;
}
#endif

SplatSurface splatResolve()
{
  SplatSurface surface;
  surface.texel = ivec2(gl_FragCoord.xy - splatViewport.xy);
  vec2 pixelDC = 2.0 * (gl_FragCoord.xy - splatViewport.xy) / splatViewport.zw - 1.0;
  vec3 origin = splatOnRay(pixelDC, 0.0);
  vec3 toEye = normalize(origin - splatOnRay(pixelDC, -1.0));
  bool inside = splatHasSurface(surface.texel);
#if SPLAT_FOLDS
  ivec2 own = surface.texel;
#endif
#if SPLAT_OUTLINE
  surface.coverage = splatCoverage(surface.texel, inside, toEye);
#else
  surface.coverage = inside ? 1.0 : 0.0;
#endif
  surface.covered = surface.coverage > 0.0;
  vec4 normalWeight = texelFetch(splatNormalWeight, surface.texel, 0);
  surface.weight = surface.covered ? normalWeight.w : 1.0;
  surface.positionVC = vec3(0.0, 0.0, -1.0);
  surface.normalVC = vec3(0.0, 0.0, 1.0);
  surface.seenFrom = 1.0;
  surface.depth = 1.0;
  if (!surface.covered)
  {
    return surface;
  }
  vec4 offsetDepth = texelFetch(splatOffsetDepth, surface.texel, 0) / surface.weight;
  vec3 normal = normalize(normalWeight.xyz);
  surface.seenFrom = texelFetch(splatSeen, surface.texel, 0).g < 0.5 ? -1.0 : 1.0;

  // Disks touch the surface; at an offset d from where disk i touches, the surface lies
  // (n - n_i) . d / 2 below the disk, up to third order, as normals change linearly along d. n_i . d
  // is zero, so the weighted mean needs no more than the mean offset.
  float below = 0.5 * dot(normal, offsetDepth.xyz);
  float towardsEye = surface.seenFrom * dot(normal, toEye);
#if SPLAT_BACK_LAYER
  surface.covered = !splatIsFrontLayer(surface.texel, offsetDepth.w, surface.seenFrom, towardsEye);
#endif
  float z = offsetDepth.w - surface.seenFrom * below * toEye.z / max(towardsEye, 0.03);
  surface.positionVC = splatOnRay(pixelDC, z);
  // Beyond the outline the mean may point away, which lights would take for darkness.
  surface.normalVC = normalize(surface.seenFrom * normal - min(towardsEye, 0.0) * toEye);
  vec4 positionDC = splatVCDC * vec4(surface.positionVC, 1.0);
  // What is mixed in beyond the outline hides nothing that is drawn later.
  surface.depth =
    inside ? clamp(0.5 * positionDC.z / positionDC.w + 0.5, 0.0, 1.0) : 1.0;
#if SPLAT_FOLDS
  // Mixed into what this pixel shows: hidden by what is nearer than that, which is not written again.
  vec4 ownDC = splatVCDC * vec4(splatOnRay(pixelDC, splatMeanDepth(own) + 0.1 * splatJump), 1.0);
  surface.depth = clamp(0.5 * ownDC.z / ownDC.w + 0.5, 0.0, 1.0);
#endif
  return surface;
}

int splatStrongestAt(ivec2 texel)
{
  return int(texelFetch(splatStrongest, texel, 0).r) - 1;
}

// Where VTK's colour texture has the colour of the mean scalar: the lower of its two rows is the
// lookup table, the upper one the colour of what is no number.
vec2 splatLookupCoordinates(SplatSurface surface)
{
  vec2 sums = texelFetch(splatColorSum, surface.texel, 0).xy; // weight * position, weight of numbers
  return sums.y < 0.5 * surface.weight ? vec2(0.5, 0.75) : vec2(sums.x / sums.y, 0.25);
}
