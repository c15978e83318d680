// What the fragment stages of the splat passes share. Inserted at //Splat::Fragment::Dec, behind the definitions that
// PassVS.glsl lists and these:
//   SPLAT_HAS_CLIP          1: particles have clip planes
//   SPLAT_GAP_SHARE         factor on the weight beyond a clip plane, see SplatPrimitives::GapShare
//   SPLAT_OTHER_SHARE       factor on the weight of colours beyond the particle's cell
//   SPLAT_GHOST_SHARE       factor on the weight of ghosts where the strongest particle is looked for
//   SPLAT_CLIPPING_PLANES   number of the mapper's clipping planes

#if SPLAT_POINTS
flat in vec4 splatPixelToDisk;
flat in vec2 splatCentrePixel;
flat in vec3 splatDepths;
vec2 splatDiskCoord = vec2(0.0); // set by splatMeetRay(); compilers warn of it otherwise
vec3 splatOffsetVC;
float splatDepthVC;
#elif SPLAT_CURVED
in vec2 splatPlaneCoord;
in vec3 splatPlaneOffset;
flat in vec3 splatDual[2];
flat in vec3 splatNormalMC;
flat in vec3 splatBend;
flat in vec3 splatNormalChange[2];
flat in float splatCentreDepth;
flat in vec3 splatClipDepths;
flat in float splatRadiusVC;
vec2 splatDiskCoord = vec2(0.0); // set by splatMeetRay(); compilers warn of it otherwise
float splatBelowDisk; // distance of the bent splat from its disk (MC)
vec3 splatOffsetVC;
float splatDepthVC;
#else
in vec2 splatDiskCoord;
in vec3 splatOffsetVC;
in float splatDepthVC;
#endif
flat in vec4 splatClipLines[SPLAT_CLIP_PLANES];
#if SPLAT_HAS_BORDERS
flat in vec4 splatBorderLines[SPLAT_BORDERS];
flat in float splatDiskToRadius;
#endif
flat in vec3 splatBeyondClip;
float splatShare = 1.0; // factor on the weight of the splat
in vec3 splatPointMC; // the fragment's place on the disk
vec3 splatPlaceMC;    // the fragment's place on the splat, which may be bent
flat in vec3 splatNormalVC;
flat in float splatSeenFromSide;
#if SPLAT_LAYERS
flat in float splatDepthToRadii;
#endif
flat in float splatMark;
flat in int splatParticle;
#if SPLAT_GHOSTS
flat in int splatGhost;
#endif

uniform vec3 splatFalloff; // sharpness; the Gaussian at the rim; squared reach (radii^2), see SplatProfile
uniform vec4 splatClippingPlane[6]; // MC

#if SPLAT_POINTS
//Splat::Ray::Dec

// The private framebuffers begin at the viewport's corner.
vec3 splatBehindPixel(vec2 pixel, float z)
{
  return splatOnRay(2.0 * pixel / splatViewport.zw - 1.0, z);
}

// Where the pixel's view ray meets the disk's plane, to first order.
bool splatMeetRay()
{
  splatPlaceMC = splatPointMC;
  splatDiskCoord = mat2(splatPixelToDisk.xy, splatPixelToDisk.zw) * (gl_FragCoord.xy - splatCentrePixel);
  splatDepthVC = splatDepths.x + dot(splatDepths.yz, splatDiskCoord);
  splatOffsetVC = splatBehindPixel(gl_FragCoord.xy, splatDepthVC) -
    splatBehindPixel(splatCentrePixel, splatDepths.x);
  return true;
}
#endif

#if SPLAT_CURVED
uniform vec4 splatEyeMC;
uniform mat4 splatMCVC;

vec3 splatSurfaceNormal()
{
  return normalize(
    splatNormalVC + splatDiskCoord.x * splatNormalChange[0] + splatDiskCoord.y * splatNormalChange[1]);
}

// Whether the normal differs by more than 45 degrees from the particle's, for which its change is as long as itself.
// Where the surface bends as much between particles, a paraboloid tells nothing of it; it would stick out.
bool splatBendsAway()
{
  vec3 change = splatDiskCoord.x * splatNormalChange[0] + splatDiskCoord.y * splatNormalChange[1];
  return dot(change, change) > dot(splatNormalVC, splatNormalVC);
}

// Where the pixel's view ray meets the splat, bent to the paraboloid at the height -Q(t) / 2 above the
// disk at disk coordinates t; Q(t) = bend.x t.x^2 + 2 bend.y t.x t.y + bend.z t.y^2. From the place p
// where the ray meets the plane of the disk the paraboloid is `along` e away, e the way to the eye:
//   along e.n + Q(p + along e) / 2 = 0,
// of which the solution on the side that is seen is taken. False if there is none: the ray passes the surface by.
bool splatMeetRay()
{
  vec3 toEyeMC = splatEyeMC.xyz - splatEyeMC.w * splatPointMC;
  vec2 e = vec2(dot(splatDual[0], toEyeMC), dot(splatDual[1], toEyeMC));
  mat2 q = mat2(splatBend.x, splatBend.y, splatBend.y, splatBend.z);
  float atPlace = dot(splatPlaneCoord, q * splatPlaneCoord);
  float slope = dot(splatNormalMC, toEyeMC) + dot(splatPlaneCoord, q * e);
  float square = slope * slope - dot(e, q * e) * atPlace;
  float along = -atPlace / (slope + splatSeenFromSide * sqrt(max(square, 0.0)));
  splatDiskCoord = splatPlaneCoord + along * e;
  splatPlaceMC = splatPointMC + along * toEyeMC;
  splatBelowDisk = -along * dot(splatNormalMC, toEyeMC);
  splatOffsetVC = splatPlaneOffset + along * (mat3(splatMCVC) * toEyeMC);
  splatDepthVC = splatCentreDepth + splatOffsetVC.z;
  splatOffsetVC -= dot(splatOffsetVC, splatSurfaceNormal()) * splatSurfaceNormal();
  return square >= 0.0 && !splatBendsAway();
}
#else
vec3 splatSurfaceNormal()
{
  return splatNormalVC;
}
#endif

#if !SPLAT_POINTS && !SPLAT_CURVED
bool splatMeetRay()
{
  splatPlaceMC = splatPointMC;
  return true;
}
#endif

#if SPLAT_HAS_CLIP
//Splat::Edge::Dec

// How far the fragment lies behind one of the particle's clip planes (MC).
float splatBehindClip(int plane)
{
  float behind = splatBehindLine(splatClipLines[plane], splatDiskCoord);
#if SPLAT_CURVED
  behind -= splatBelowDisk * splatClipDepths[plane];
#endif
  return behind;
}
#endif

// Call this first. Whether the fragment is no part of the splat.
bool splatOutside()
{
  // The comparison is also false where the disk coordinates are no numbers.
  bool outside = !splatMeetRay() || !(dot(splatDiskCoord, splatDiskCoord) <= 1.0);
#if SPLAT_HAS_CLIP
  for (int plane = 0; plane < SPLAT_CLIP_PLANES; ++plane)
  {
    float behind = splatBehindClip(plane);
    outside = outside || behind > splatBeyondClip[plane];
    splatShare = behind > 0.0 ? SPLAT_GAP_SHARE : splatShare;
  }
#endif
#if SPLAT_CLIPPING_PLANES
  for (int i = 0; i < SPLAT_CLIPPING_PLANES; ++i)
  {
    outside = outside || dot(splatClippingPlane[i], vec4(splatPlaceMC, 1.0)) < 0.0;
  }
#endif
  return outside;
}

#if (SPLAT_APART && SPLAT_CURVED) || (SPLAT_LAYERS && !SPLAT_POINTS)
uniform mat4 splatVCDC;
#endif

#if SPLAT_APART && (SPLAT_POINTS || SPLAT_CURVED)

// Depth of the splat itself, for the depth buffer. The rasterizer knows the depth of the splat's middle or of its plane
// only, with which surfaces near each other would break through each other.
float splatOwnDepth()
{
  float z = splatDepthVC;
#if SPLAT_CURVED
  // Later passes pull the plane by one radius, and the pulled plane must come before this depth: so the depth stays
  // less than a radius from the plane. Half a radius was chosen by experiment.
  float plane = splatCentreDepth + splatPlaneOffset.z;
  z = clamp(z, plane - 0.5 * splatRadiusVC, plane + 0.5 * splatRadiusVC);
#endif
  float depth = splatVCDC[2][2] * z + splatVCDC[3][2];
  return 0.5 * depth / (splatVCDC[2][3] * z + splatVCDC[3][3]) + 0.5;
}
#endif

// Whether another side, or another isovalue, is seen at this pixel. Marks are whole 255ths.
bool splatIsOfOther(sampler2D seen)
{
  float difference = texelFetch(seen, ivec2(gl_FragCoord.xy), 0).g - splatMark;
  return abs(difference) > 0.5 / 255.0;
}

#if SPLAT_LAYERS
// Distances along the normal, in radii, by which a splat lies behind what is seen: up to the first it is of the same
// layer, from the second on it is of one that is hidden. Chosen by experiment: larger ones average layers that can be told
// apart, smaller ones show single splats where they stand unevenly.
const float SPLAT_SAME_LAYER = 0.06;
const float SPLAT_OTHER_LAYER = 0.15;

// The share of its weight that a splat beside another layer has, where `visible` is the depth that is seen.
float splatLayerShare(float visible, float nearer)
{
  float z = 2.0 * visible - 1.0;
  float seen = (splatVCDC[3][2] - z * splatVCDC[3][3]) / (z * splatVCDC[2][3] - splatVCDC[2][2]);
  float behind = nearer * (seen - splatDepthVC) * splatDepthToRadii;
  return mix(1.0, SPLAT_GAP_SHARE, smoothstep(SPLAT_SAME_LAYER, SPLAT_OTHER_LAYER, behind));
}
#endif

// Whether the fragment is farther from the particle than the splat makes a surface, see splatReach() in SplatProfile.h.
bool splatBeyondReach()
{
  return dot(splatDiskCoord, splatDiskCoord) > splatFalloff.z;
}

// The weight of SplatProfile: a Gaussian, lowered so that it ends with zero at the rim; 1 in the middle.
float splatWeight()
{
  float gaussian = exp(-splatFalloff.x * dot(splatDiskCoord, splatDiskCoord));
  return splatShare * (gaussian - splatFalloff.y) / (1.0 - splatFalloff.y);
}

#if SPLAT_HAS_BORDERS
uniform float splatEdgeWidth; // pixels

// Largest foreshortening that lines at borders follow. Where the surface is seen edge-on it bends away within a pixel,
// so that the plane of a splat tells nothing of lines there; they would cover its outline. Chosen by experiment.
const float SPLAT_MOST_FORESHORTENED = 5.0;

// How far the fragment lies beyond the particle's cell, in pixels; negative within. To be called where derivatives are
// defined, which is before anything is discarded.
float splatBeyondCell()
{
#if SPLAT_POINTS
  vec2 right = splatPixelToDisk.xy;
  vec2 up = splatPixelToDisk.zw;
#else
  vec2 right = dFdx(splatDiskCoord);
  vec2 up = dFdy(splatDiskCoord);
#endif
  // Size of a pixel (disk coordinates) where it is not foreshortened, at most by the square root of 2 too small.
  float shortest = abs(determinant(mat2(right, up))) / max(length(vec4(right, up)), 1e-30);
  float beyond = -1e6; // pixels, more than any picture has
  for (int i = 0; i < SPLAT_BORDERS; ++i)
  {
    vec4 line = splatBorderLines[i];
    float along = line.x * splatDiskCoord.y - line.y * splatDiskCoord.x;
    float behind = dot(line.xy, splatDiskCoord) - line.z - line.w * along * along;
    vec2 slope = line.xy - 2.0 * line.w * along * vec2(-line.y, line.x);
    float perPixel = min(length(vec2(dot(slope, right), dot(slope, up))),
      SPLAT_MOST_FORESHORTENED * shortest * length(slope));
    beyond = max(beyond, behind / max(perPixel, 1e-30)); // not divided by 0
  }
  return beyond;
}

// The share of the splat's weight with which it gives its colour to this pixel: 1 within the particle's cell, over one
// pixel hardly anything beyond it.
float splatCellShare(float beyondCell)
{
  return clamp(0.5 - beyondCell, SPLAT_OTHER_SHARE, 1.0);
}

// How much of the pixel the line covers that is drawn where the cell ends.
float splatEdgeCoverage(float beyondCell)
{
  return clamp(0.5 * splatEdgeWidth + 0.5 - abs(beyondCell), 0.0, 1.0);
}
#endif
