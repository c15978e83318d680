// The resolve pass: what the sums say of the surface at a pixel. Inserted into VTK's fragment shader behind the
// definitions of
//   SPLAT_OUTLINE      1: outlines are smooth
//   SPLAT_FOLDS        1: outlines where the surface lies in front of itself; SPLAT_OUTLINE is 1 then
//   SPLAT_BACK_LAYER   1: the back layer is drawn
//   SPLAT_CLIPS_COLORS 1: colours have weights of their own, as they end where cells end
//   SPLAT_EDGES        1: lines are drawn where cells end
//   SPLAT_GHOSTS       1: there are ghosts; the rank that has the strongest particle of a pixel draws it

//Splat::Ray::Dec

uniform sampler2D splatNormalWeight; // sums of weight * normal (VC, outward), weight
uniform sampler2D splatOffsetDepth;  // sums of weight * offset from the particle (VC), weight * z
uniform sampler2D splatColorSum;     // sums of weight * colour or lookup coordinates
uniform sampler2D splatBorderSum;    // sums of the weight that colours have, this weight * coverage by edges
uniform sampler2D splatSeen;         // r: 1 where there is surface; g: above 0.5 where it is seen from outward
uniform usampler2D splatStrongest; // number of the particle with the largest weight, see StrongestFS.glsl
uniform float splatLeastWeight; // pixels with surface have a larger summed weight than this; others have none

#if SPLAT_GHOSTS
bool splatIsDrawnElsewhere(ivec2 texel)
{
  return texelFetch(splatStrongest, texel, 0).r >= 0x80000000u;
}
#endif

bool splatHasSurface(ivec2 texel)
{
  return texelFetch(splatSeen, texel, 0).r > 0.5;
}

// Smallest cosines between normal and view ray that lengths along the ray are divided by, no unit. Both were chosen by
// experiment. A smaller one lets noise of the normals grow at outlines, a larger one changes the depth there.
const float splatLeastLayerCosine = 0.1; // for the distance of two layers
const float splatLeastDepthCosine = 0.03; // for the correction of the depth

// Depth of a colour that is mixed into the background beyond an outline. It hides nothing that is drawn later. Where the
// nearest of several ranks' pixels are taken, it comes before the cleared depth, 1: four steps of a buffer with 24 bits.
const float splatBackground = 1.0 - 1.0 / 4194304.0;

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
  vec3 normalVC; // unit, of the side that is seen
  float seenFrom; // 1: from outward
  float depth;    // for the depth buffer
};

#if SPLAT_BACK_LAYER
uniform sampler2D splatFrontNormalWeight; // as above, of the front layer
uniform sampler2D splatFrontOffsetDepth;
uniform sampler2D splatFrontSeen;
uniform float splatLayerDistance; // VC; layers closer to each other than this are one

// Where the view ray meets one surface only, the back layer is the front layer once more.
bool splatIsFrontLayer(ivec2 texel, float z, float seenFrom, float towardsEye)
{
  float weight = texelFetch(splatFrontNormalWeight, texel, 0).w;
  float zFront = texelFetch(splatFrontOffsetDepth, texel, 0).w / max(weight, splatLeastWeight);
  float seenFromFront = texelFetch(splatFrontSeen, texel, 0).g < 0.5 ? -1.0 : 1.0;
  return seenFrom == seenFromFront && (zFront - z) * max(towardsEye, splatLeastLayerCosine) < splatLayerDistance;
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
#if SPLAT_GHOSTS && SPLAT_FOLDS
  surface.covered = surface.covered && !splatIsDrawnElsewhere(own);
#elif SPLAT_GHOSTS
  surface.covered = surface.covered && !splatIsDrawnElsewhere(surface.texel);
#endif
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

  // Disk i touches the surface at its particle, with the normal n_i. At an offset d along the disk the surface lies
  // (n - n_i) . d / 2 below it, up to third order, as the normal changes linearly to n along d. n_i . d is zero, so
  // that the weighted mean over the disks needs no more than the mean offset.
  float below = 0.5 * dot(normal, offsetDepth.xyz);
  float towardsEye = surface.seenFrom * dot(normal, toEye);
#if SPLAT_BACK_LAYER
  surface.covered = !splatIsFrontLayer(surface.texel, offsetDepth.w, surface.seenFrom, towardsEye);
#endif
  float z = offsetDepth.w - surface.seenFrom * below * toEye.z / max(towardsEye, splatLeastDepthCosine);
  surface.positionVC = splatOnRay(pixelDC, z);
  // Beyond the outline the mean normal may point away from the eye, which would look dark.
  surface.normalVC = normalize(surface.seenFrom * normal - min(towardsEye, 0.0) * toEye);
  vec4 positionDC = splatVCDC * vec4(surface.positionVC, 1.0);
  surface.depth = inside ? clamp(0.5 * positionDC.z / positionDC.w + 0.5, 0.0, 1.0) : splatBackground;
#if SPLAT_FOLDS
  // The colour is mixed into what this pixel shows. So it is tested at the depth of that surface, a little farther:
  // a tenth of the jump that tells surfaces apart, far above rounding.
  vec4 ownDC = splatVCDC * vec4(splatOnRay(pixelDC, splatMeanDepth(own) + 0.1 * splatJump), 1.0);
  surface.depth = clamp(0.5 * ownDC.z / ownDC.w + 0.5, 0.0, 1.0);
#endif
  return surface;
}

// The weight that the sums of colours have.
float splatColorWeight(SplatSurface surface)
{
#if SPLAT_CLIPS_COLORS
  return texelFetch(splatBorderSum, surface.texel, 0).r;
#else
  return surface.weight;
#endif
}

#if SPLAT_EDGES
// The share of the pixel that is covered by lines where cells end.
float splatEdgeShare(SplatSurface surface)
{
  vec2 sums = texelFetch(splatBorderSum, surface.texel, 0).rg;
  return surface.covered ? sums.g / sums.r : 0.0;
}
#endif

int splatStrongestAt(ivec2 texel)
{
  return int(texelFetch(splatStrongest, texel, 0).r & 0x7fffffffu) - 1;
}

// The place of the mean scalar's colour in VTK's colour texture. The lower one of its two rows is the lookup table,
// with its middle at 0.25; the upper one, at 0.75, is the colour of values that are no numbers.
vec2 splatLookupCoordinates(SplatSurface surface)
{
  vec2 sums = texelFetch(splatColorSum, surface.texel, 0).xy; // weight * position, weight of numbers
  return sums.y < 0.5 * splatColorWeight(surface) ? vec2(0.5, 0.75) : vec2(sums.x / sums.y, 0.25);
}
