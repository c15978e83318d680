//VTK::System::Dec

// Vertex stage of the splat passes (visibility, accumulation, strongest), behind definitions of
// SPLAT_POINTS, SPLAT_LEAST_PIXELS, SPLAT_LEAST_COSINE and SPLAT_APART (isovalues are told apart: 0 or 1). A splat
// is a triangle in the plane of its disk, so that depth and disk coordinates are interpolated by the rasterizer,
// right for every projection, and the near plane clips it. Where all splats cover a few pixels only (SPLAT_POINTS
// 1), each is a point instead, of the depth of its middle: a third of the vertices.

//Splat::Disk::Dec

uniform mat4 splatMCVC;
uniform mat4 splatVCDC;
uniform mat3 splatNormalMatrix; // normals from MC to VC
uniform int splatParallel;      // 1: parallel projection
uniform float splatPixel; // size of a pixel (VC) at distance 1, or everywhere if parallel
uniform float splatPush;  // by how many radii the disk is moved along the view ray, away from the eye
uniform float splatExtent; // how far a splat reaches, in radii
uniform vec4 splatViewport; // left, bottom, width, height in pixels

#if SPLAT_POINTS
flat out vec4 splatPixelToDisk; // matrix, by columns, from offsets in pixels to disk coordinates
flat out vec2 splatCentrePixel;
flat out vec3 splatDepths; // z in the middle, and by how much it grows along the disk coordinates
#elif SPLAT_CURVED
out vec2 splatPlaneCoord; // disk coordinates before the splat is bent
out vec3 splatPlaneOffset; // the same place, from the centre (VC)
flat out vec3 splatDual[2]; // these two take offsets along the disk (MC) to disk coordinates
flat out vec3 splatNormalMC;
flat out vec3 splatBend; // see splatMeetRay()
flat out vec3 splatNormalChange[2]; // by how much the normal (VC) turns along the disk coordinates
flat out float splatCentreDepth;
flat out vec2 splatClipDepths; // by how much a place below the disk is before the clip planes
flat out float splatRadiusVC;
#else
out vec2 splatDiskCoord; // inside the unit circle = inside the splat
out vec3 splatOffsetVC;  // from the centre of the disk
out float splatDepthVC;  // z
#endif
flat out vec4 splatClipLines[2]; // see splatClipLine()
flat out vec2 splatBeyondClip;   // how far beyond them the splat fills gaps (MC)
out vec3 splatPointMC;           // for clipping planes
flat out vec3 splatNormalVC;     // outward, unit if flat
flat out float splatSeenFromSide;
flat out float splatMark; // tells splats of other sides and isovalues apart: g of splatSeen
flat out int splatParticle;

#if SPLAT_CURVED
uniform samplerBuffer splatShape; // derivative of the normal along the surface, xx, yy, zz | xy, yz, xz

mat3 splatShapeOf(int particle)
{
  vec3 d = texelFetch(splatShape, 2 * particle).xyz;
  vec3 o = texelFetch(splatShape, 2 * particle + 1).xyz;
  return mat3(d.x, o.x, o.z, o.x, d.y, o.y, o.z, o.y, d.z);
}
#endif

#if SPLAT_CURVED
float splatClipDepth(int particle, int plane, SplatDisk disk)
{
  return splatHasClip == 0 ? 0.0 : dot(texelFetch(splatClip, 3 * particle + plane).xyz, disk.normalMC);
}
#endif

#if SPLAT_SKIPS_HIDDEN
uniform sampler2D splatVisibleDepth;
uniform float splatNearer; // 1: what lies before the visible depth is seen; -1: what lies behind it

// Whether something hides the middle of a splat.
bool splatIsHidden(vec4 centreClip)
{
  vec3 centreDC = 0.5 * centreClip.xyz / centreClip.w + 0.5;
  ivec2 texel = ivec2(clamp(centreDC.xy * splatViewport.zw, vec2(0.0), splatViewport.zw - 1.0));
  return splatNearer * (centreDC.z - texelFetch(splatVisibleDepth, texel, 0).r) > 0.0;
}
#endif

#if SPLAT_POINTS
// Of an offset (VC) from a place with these clip coordinates, what becomes of it in pixels.
vec2 splatInPixels(vec3 offsetVC, vec4 placeClip)
{
  vec4 offset = splatVCDC * vec4(offsetVC, 0.0);
  return 0.5 * splatViewport.zw * (offset.xy - offset.w * placeClip.xy / placeClip.w) / placeClip.w;
}
#endif

void main()
{
  splatParticle = gl_VertexID / (SPLAT_POINTS == 1 ? 1 : 3) * splatStride;
  SplatDisk disk = splatDiskOf(splatParticle);
  splatSeenFromSide = disk.seenFrom;
  splatMark = (float(disk.isovalue) + (disk.seenFrom > 0.0 ? 128.0 : 0.0)) / 255.0;
  splatNormalVC = normalize(splatNormalMatrix * disk.normalMC);
  splatClipLines[0] = splatClipLine(splatParticle, 0, disk);
  splatClipLines[1] = splatClipLine(splatParticle, 1, disk);
  splatBeyondClip = length(disk.tangentMC) * splatOverlaps(splatParticle);

  vec3 centreVC = (splatMCVC * vec4(disk.centreMC, 1.0)).xyz;
  mat3 rotateScale = mat3(splatMCVC);
  vec3 tangentVC = rotateScale * disk.tangentMC;
  vec3 bitangentVC = rotateScale * disk.bitangentMC;
  float radiusVC = sqrt(max(dot(tangentVC, tangentVC), dot(bitangentVC, bitangentVC)));
  bool nothing = radiusVC == 0.0;

  // A splat covers at least SPLAT_LEAST_PIXELS from its middle to its rim: smaller ones would fall
  // between the pixels, and of those that do not only one or two would make a pixel.
  float pixel = splatPixel * (splatParallel == 1 ? 1.0 : abs(centreVC.z));
  float enlarge = max(1.0, SPLAT_LEAST_PIXELS * pixel / max(radiusVC, 1e-30));
  splatClipLines[0].xy *= enlarge;
  splatClipLines[1].xy *= enlarge;
  tangentVC *= enlarge;
  bitangentVC *= enlarge;
  radiusVC *= enlarge;

#if SPLAT_POINTS
  vec4 centreClip = splatVCDC * vec4(centreVC, 1.0);
  mat2 toPixels = mat2(splatInPixels(tangentVC, centreClip), splatInPixels(bitangentVC, centreClip));
  mat2 toDisk = inverse(toPixels);
  splatPixelToDisk = vec4(toDisk[0], toDisk[1]);
  splatCentrePixel = (0.5 * centreClip.xy / centreClip.w + 0.5) * splatViewport.zw;
  splatDepths = vec3(centreVC.z, tangentVC.z, bitangentVC.z);
  splatPointMC = disk.centreMC;
  gl_PointSize = max(2.0 * splatExtent * radiusVC / pixel, 1.0);
  vec3 vertexVC = centreVC;
  // The depths of middles differ by as much more than those of neighbouring planes as they tilt.
  vec3 toEye = splatParallel == 1 ? vec3(0.0, 0.0, 1.0) : normalize(-centreVC);
  radiusVC /= max(abs(dot(splatNormalVC, toEye)), SPLAT_LEAST_COSINE);
#else
  vec2 place = splatExtent * splatCorner[gl_VertexID % 3];
  vec3 offsetVC = place.x * tangentVC + place.y * bitangentVC;
  splatPointMC =
    disk.centreMC + enlarge * (place.x * disk.tangentMC + place.y * disk.bitangentMC);
  vec3 vertexVC = centreVC + offsetVC;
#if SPLAT_CURVED
  vec3 tangentMC = enlarge * disk.tangentMC;
  vec3 bitangentMC = enlarge * disk.bitangentMC;
  float square = dot(tangentMC, tangentMC);
  vec3 turn = splatShapeOf(splatParticle) * tangentMC;
  vec3 biturn = splatShapeOf(splatParticle) * bitangentMC;
  splatPlaneCoord = place;
  splatPlaneOffset = offsetVC;
  splatDual[0] = tangentMC / square;
  splatDual[1] = bitangentMC / square;
  splatNormalMC = disk.normalMC;
  splatBend = vec3(dot(tangentMC, turn), dot(tangentMC, biturn), dot(bitangentMC, biturn));
  splatNormalChange[0] = splatNormalMatrix * turn;
  splatNormalChange[1] = splatNormalMatrix * biturn;
  splatNormalVC = splatNormalMatrix * disk.normalMC;
  splatCentreDepth = centreVC.z;
  splatRadiusVC = radiusVC;
  splatClipDepths = vec2(splatClipDepth(splatParticle, 0, disk), splatClipDepth(splatParticle, 1, disk));
#else
  splatDiskCoord = place;
  splatOffsetVC = offsetVC;
  splatDepthVC = vertexVC.z;
#endif
#endif
#if SPLAT_APART
  // Near and far plane, for passes in which they cut the disk where it is, not where it is moved to.
  vec4 clip = splatVCDC * vec4(vertexVC, 1.0);
  gl_ClipDistance[0] = clip.w + clip.z;
  gl_ClipDistance[1] = clip.w - clip.z;
#endif
  // Every point of the disk moves along its own view ray: the picture of the disk stays the same.
  if (splatParallel == 1)
  {
    vertexVC.z -= splatPush * radiusVC;
  }
  else
  {
    vertexVC *= 1.0 + splatPush * radiusVC / max(length(centreVC), 2.0 * radiusVC);
  }
  vec4 placeClip = splatVCDC * vec4(vertexVC, 1.0);
#if SPLAT_SKIPS_HIDDEN
  nothing = nothing || splatIsHidden(placeClip);
#endif
  gl_Position = nothing ? vec4(2.0, 2.0, 2.0, 1.0) : placeClip;
}
