//VTK::System::Dec

// Vertex stage of the splat passes (visibility, accumulation, strongest), behind definitions of
//   SPLAT_POINTS         1: splats are points; 0: triangles
//   SPLAT_CURVED         1: splats are bent to paraboloids
//   SPLAT_SKIPS_HIDDEN   1: points whose middle is hidden are left out
//   SPLAT_APART          1: splats are drawn with their own depth, so that isovalues or layers are told apart
//   SPLAT_LAYERS         1: there are layers near each other
//   SPLAT_CLIP_PLANES    largest number of clip planes of a particle, at least 1
//   SPLAT_HAS_BORDERS    1: it matters where cells end
//   SPLAT_BORDERS        number of borders that a particle may have
//   SPLAT_GHOSTS         1: there are ghosts
//   SPLAT_LEAST_PIXELS   smallest radius of a splat, pixels
//   SPLAT_LEAST_COSINE   smallest cosine by which the push of a point is divided
// Drawing/SplatPrimitives.cxx explains the last two.
//
// A splat is a triangle in the plane of its disk: so the rasterizer interpolates depth and disk coordinates, right for
// every projection, and the near plane clips it. Where all splats cover a few pixels only, each is a point instead,
// with the depth of its middle: a third of the vertices.

//Splat::Disk::Dec

uniform mat4 splatMCVC;
uniform mat4 splatVCDC;
uniform mat3 splatNormalMatrix; // normals from MC to VC
uniform int splatParallel;      // 1: parallel projection
uniform float splatPixel; // size of a pixel (VC) at distance 1, or everywhere if parallel
uniform float splatPush;  // by how many radii the disk is moved along the view ray, away from the eye
uniform float splatExtent; // radius of what is drawn of a splat, in radii: the reach of its profile, or 1
uniform vec4 splatViewport; // left, bottom, width, height in pixels

#if SPLAT_POINTS
flat out vec4 splatPixelToDisk; // matrix, by columns, from offsets in pixels to disk coordinates
flat out vec2 splatCentrePixel;
flat out vec3 splatDepths; // z in the middle (VC), and its derivatives along the disk coordinates
#elif SPLAT_CURVED
out vec2 splatPlaneCoord; // disk coordinates before the splat is bent
out vec3 splatPlaneOffset; // the same place, from the centre (VC)
flat out vec3 splatDual[2]; // products with these take an offset along the disk (MC) to disk coordinates
flat out vec3 splatNormalMC;
flat out vec3 splatBend; // see splatMeetRay()
flat out vec3 splatNormalChange[2]; // derivatives of the normal (VC) along the disk coordinates
flat out float splatCentreDepth; // z (VC)
flat out vec3 splatClipDepths; // cosines between the disk's normal and the clip planes' normals
flat out float splatRadiusVC;
#else
out vec2 splatDiskCoord; // inside of the splat within the unit circle
out vec3 splatOffsetVC;  // from the centre of the disk
out float splatDepthVC;  // z
#endif
flat out vec4 splatClipLines[SPLAT_CLIP_PLANES]; // see splatClipLine()
#if SPLAT_HAS_BORDERS
flat out vec4 splatBorderLines[SPLAT_BORDERS]; // see splatBorderLine()
flat out float splatDiskToRadius; // takes disk coordinates to offsets in the particle's own radius
#endif
flat out vec3 splatBeyondClip; // how far beyond its clip planes, across them, the splat fills gaps (MC)
out vec3 splatPointMC;           // for clipping planes
flat out vec3 splatNormalVC;     // outward; of length 1 if splats are flat
flat out float splatSeenFromSide;
#if SPLAT_LAYERS
flat out float splatDepthToRadii; // takes a difference in z to radii along the normal; 0: there is no layer nearby
#endif
flat out float splatMark; // tells sides and isovalues apart: g of splatSeen
flat out int splatParticle;
#if SPLAT_GHOSTS
flat out int splatGhost; // 1: the particle is a ghost
#endif

#if SPLAT_CURVED
uniform samplerBuffer splatShape; // shape operator (1 / MC), two texels a particle: xx, yy, zz | xy, yz, xz

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
  return plane >= splatClipPlanes()
    ? 0.0
    : dot(texelFetch(splatClip, splatClipTexel(particle, plane)).xyz, disk.normalMC);
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
// The derivative, in pixels, of the picture of a place with these clip coordinates along an offset (VC).
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
#if SPLAT_GHOSTS
  splatGhost = disk.ghost ? 1 : 0;
#endif
  splatSeenFromSide = disk.seenFrom;
  splatMark = (float(disk.isovalue) + (disk.seenFrom > 0.0 ? 128.0 : 0.0)) / 255.0;
  splatNormalVC = normalize(splatNormalMatrix * disk.normalMC);
  for (int plane = 0; plane < SPLAT_CLIP_PLANES; ++plane)
  {
    splatClipLines[plane] = splatClipLine(splatParticle, plane, disk);
  }
  splatBeyondClip = splatOverlapsAcross(splatParticle, disk);

  vec3 centreVC = (splatMCVC * vec4(disk.centreMC, 1.0)).xyz;
  mat3 rotateScale = mat3(splatMCVC);
  vec3 tangentVC = rotateScale * disk.tangentMC;
  vec3 bitangentVC = rotateScale * disk.bitangentMC;
  float radiusVC = sqrt(max(dot(tangentVC, tangentVC), dot(bitangentVC, bitangentVC)));
  bool nothing = radiusVC == 0.0;

  // Smaller splats would fall between the middles of pixels, and the others would be one or two at a pixel.
  float pixel = splatPixel * (splatParallel == 1 ? 1.0 : abs(centreVC.z));
  float enlarge = max(1.0, SPLAT_LEAST_PIXELS * pixel / max(radiusVC, 1e-30)); // not divided by 0
  for (int plane = 0; plane < SPLAT_CLIP_PLANES; ++plane)
  {
    splatClipLines[plane].xy *= enlarge;
  }
#if SPLAT_HAS_BORDERS
  for (int border = 0; border < SPLAT_BORDERS; ++border)
  {
    splatBorderLines[border] = splatBorderLine(splatParticle, border, disk);
    splatBorderLines[border].xy *= enlarge;
  }
  splatDiskToRadius = enlarge * splatRadiusScale;
#endif
#if SPLAT_LAYERS
  float towardsEye = splatParallel == 1 ? splatNormalVC.z : dot(splatNormalVC, normalize(centreVC));
  splatDepthToRadii = disk.besideLayer ? abs(towardsEye) / max(radiusVC, 1e-30) : 0.0; // not divided by 0
#endif
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
  // Neighbouring points of a surface that is seen at a slant differ in depth by their distance over this cosine, where
  // triangles in the same plane would not.
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
  vec3 alongTangent = splatShapeOf(splatParticle) * tangentMC;
  vec3 alongBitangent = splatShapeOf(splatParticle) * bitangentMC;
  splatPlaneCoord = place;
  splatPlaneOffset = offsetVC;
  splatDual[0] = tangentMC / square;
  splatDual[1] = bitangentMC / square;
  splatNormalMC = disk.normalMC;
  splatBend =
    vec3(dot(tangentMC, alongTangent), dot(tangentMC, alongBitangent), dot(bitangentMC, alongBitangent));
  splatNormalChange[0] = splatNormalMatrix * alongTangent;
  splatNormalChange[1] = splatNormalMatrix * alongBitangent;
  splatNormalVC = splatNormalMatrix * disk.normalMC;
  splatCentreDepth = centreVC.z;
  splatRadiusVC = radiusVC;
  splatClipDepths = vec3(splatClipDepth(splatParticle, 0, disk), splatClipDepth(splatParticle, 1, disk),
    splatClipDepth(splatParticle, 2, disk));
#else
  splatDiskCoord = place;
  splatOffsetVC = offsetVC;
  splatDepthVC = vertexVC.z;
#endif
#endif
#if SPLAT_APART
  // Near and far plane, for passes in which they cut the disk in its own place before it is moved.
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
    // Nearer to the eye than two radii the factor grows no more: a pull must not take the splat behind the eye.
    vertexVC *= 1.0 + splatPush * radiusVC / max(length(centreVC), 2.0 * radiusVC);
  }
  vec4 placeClip = splatVCDC * vec4(vertexVC, 1.0);
#if SPLAT_SKIPS_HIDDEN
  nothing = nothing || splatIsHidden(placeClip);
#endif
  gl_Position = nothing ? vec4(2.0, 2.0, 2.0, 1.0) : placeClip;
}
