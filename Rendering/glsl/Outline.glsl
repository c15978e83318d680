// Smooth outlines. Inserted at //Splat::Outline::Dec.
//
// Near the outline of a smooth surface the cosine between normal and view ray falls with the square
// root of the distance d to the outline in the picture: cos^2 = 2 d / R with the radius of curvature
// R. So cos^2 over its gradient is the distance in pixels, which says how much of a pixel is covered; before the
// outline and, extrapolated, beyond it.

// Pixels with a larger cos^2 are not beside an outline; 57 degrees. Chosen by experiment: a larger limit blurs boundary
// curves, a smaller one leaves steps at the outlines of small things, whose cos^2 grows by much from pixel to pixel.
const float splatOutlineLimit = 0.3;

// Gradients of cos^2 are at least this, so that nothing is divided by 0.
const float splatLeastGradient = 1e-6;

#if SPLAT_FOLDS
uniform float splatJump; // VC; pixels whose depths differ by more show different parts of the surface

// Mean z (VC) of the surface at a pixel, before any correction.
float splatMeanDepth(ivec2 texel)
{
  return texelFetch(splatOffsetDepth, texel, 0).w / texelFetch(splatNormalWeight, texel, 0).w;
}

float splatDepthOfInterest = 0.0; // z (VC) of the part of the surface whose outline is looked at
#endif

// cos^2, or -1 where there is no surface.
float splatFacing(ivec2 texel, vec3 toEye)
{
  vec4 normalWeight = texelFetch(splatNormalWeight, texel, 0);
  float cosine = dot(normalize(normalWeight.xyz), toEye);
  bool there = normalWeight.w > splatLeastWeight;
#if SPLAT_FOLDS
  there = there && abs(splatMeanDepth(texel) - splatDepthOfInterest) < splatJump;
#endif
  return there ? cosine * cosine : -1.0;
}

// Derivative of cos^2 over the pixels before and after one with surface, of which either may have none (less than 0).
float splatDerivative(float before, float here, float after)
{
  return before < 0.0 ? (after < 0.0 ? 0.0 : after - here)
                      : (after < 0.0 ? here - before : 0.5 * (after - before));
}

// Whether a pixel with surface has a neighbour without, or the other way round. The surface counts as going on beyond
// the viewport.
bool splatIsAtEdge(ivec2 texel, bool covered)
{
  ivec2 last = ivec2(splatViewport.zw) - 1;
  return splatHasSurface(min(texel + ivec2(1, 0), last)) != covered ||
    splatHasSurface(max(texel - ivec2(1, 0), 0)) != covered ||
    splatHasSurface(min(texel + ivec2(0, 1), last)) != covered ||
    splatHasSurface(max(texel - ivec2(0, 1), 0)) != covered;
}

// Share of a pixel with surface, at an edge of the surface, that lies inside of the outline.
float splatInnerCoverage(ivec2 texel, vec3 toEye)
{
  float here = splatFacing(texel, toEye);
  vec2 gradient =
    vec2(splatDerivative(
           splatFacing(texel - ivec2(1, 0), toEye), here, splatFacing(texel + ivec2(1, 0), toEye)),
      splatDerivative(
        splatFacing(texel - ivec2(0, 1), toEye), here, splatFacing(texel + ivec2(0, 1), toEye)));
  float coverage = clamp(here / max(length(gradient), splatLeastGradient) + 0.5, 0.5, 1.0);
  return here > splatOutlineLimit ? 1.0 : coverage;
}

// Share of a pixel without surface that lies inside of the outline, extrapolated from the next two pixels along `step`;
// 0 if the first of them has no surface or is not beside an outline.
float splatOuterCoverage(ivec2 texel, ivec2 step, vec3 toEye)
{
  float near = splatFacing(texel + step, toEye);
  float far = splatFacing(texel + 2 * step, toEye);
  if (near < 0.0 || far < near || near > splatOutlineLimit)
  {
    return 0.0;
  }
  ivec2 side = step.yx;
  float along = splatDerivative(
    splatFacing(texel + step - side, toEye), near, splatFacing(texel + step + side, toEye));
  float here = 2.0 * near - far;
  return here > 0.0 ? 0.0 : max(0.5 + here / max(length(vec2(far - near, along)), splatLeastGradient), 0.0);
}

#if SPLAT_FOLDS
// Where the surface lies in front of itself: the share with which the surface at a neighbour is to be mixed in. That is
// a part in front that reaches into this pixel, or a part behind where the part in front ends in this pixel. 0
// elsewhere. `texel` becomes the neighbour.
float splatCoverage(inout ivec2 texel, bool covered, vec3 toEye)
{
  float here = splatMeanDepth(texel);
  float coverage = 0.0;
  ivec2 best = texel;
  for (int i = 0; i < 4; ++i)
  {
    ivec2 step = ivec2(i == 0 ? 1 : (i == 1 ? -1 : 0), i == 2 ? 1 : (i == 3 ? -1 : 0));
    float there = splatMeanDepth(texel + step);
    float found = 0.0;
    if (covered && splatHasSurface(texel + step) && abs(there - here) > splatJump)
    {
      splatDepthOfInterest = max(here, there);
      found = there > here ? splatOuterCoverage(texel, step, toEye) : 1.0 - splatInnerCoverage(texel, toEye);
    }
    if (found > coverage)
    {
      coverage = found;
      best = texel + step;
    }
  }
  texel = best;
  return coverage;
}
#else
// The neighbour of a pixel without surface by which most of the pixel is covered, and this coverage.
ivec2 splatOutlineNeighbor(ivec2 texel, vec3 toEye, out float coverage)
{
  ivec2 best = texel;
  coverage = 0.0;
  for (int i = 0; i < 4; ++i)
  {
    ivec2 step = ivec2(i == 0 ? 1 : (i == 1 ? -1 : 0), i == 2 ? 1 : (i == 3 ? -1 : 0));
    float found = splatOuterCoverage(texel, step, toEye);
    if (found > coverage)
    {
      coverage = found;
      best = texel + step;
    }
  }
  return best;
}

// Coverage of a pixel. Beyond the outline `texel` becomes the neighbour to take the surface from.
float splatCoverage(inout ivec2 texel, bool covered, vec3 toEye)
{
  float coverage = covered ? 1.0 : 0.0;
  if (splatIsAtEdge(texel, covered))
  {
    if (covered)
    {
      coverage = splatInnerCoverage(texel, toEye);
    }
    else
    {
      texel = splatOutlineNeighbor(texel, toEye, coverage);
    }
  }
  return coverage;
}
#endif
