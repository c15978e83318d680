//VTK::System::Dec

// Vertex stage of the modes 'Disks' and 'Points', inside VTK's template for polygonal data: VTK replaces the tags below
// by its own text, which finds the names that it expects (vertexMC, MCDCMatrix ...). splatVerticesPerParticle is 3 for
// disks and 1 for points. SPLAT_SMOOTH_OVERLAP is the overlap (radii) from which on the surface is almost smooth at a
// plane.

//Splat::Disk::Dec

uniform mat3 normalMatrix;

out vec2 splatDiskCoord;          // inside of the disk within the unit circle
flat out vec4 splatClipLines[3];  // see splatClipLine()
flat out vec3 splatNormalVC;      // normal of the side that is seen
flat out int splatParticle;
flat out float splatSeenFromSide; // 1: from outward (the normal points at the eye), -1: from inward

//VTK::CustomUniforms::Dec

//VTK::PositionVC::Dec

//VTK::Normal::Dec

//VTK::Light::Dec

//VTK::TCoord::Dec

//VTK::Color::Dec

//VTK::Clip::Dec

//VTK::Camera::Dec

//VTK::PrimID::Dec

//VTK::ValuePass::Dec

//VTK::Picking::Dec

void main()
{
  splatParticle = gl_VertexID / splatVerticesPerParticle * splatStride;
  SplatDisk disk = splatDiskOf(splatParticle);
  splatDiskCoord = splatVerticesPerParticle == 1 ? vec2(0.0) : splatCorner[gl_VertexID % 3];
  vec4 vertexMC = vec4(disk.centreMC + splatDiskCoord.x * disk.tangentMC +
      splatDiskCoord.y * disk.bitangentMC, 1.0);
  // Disks are not mixed: they go on over planes at which the surface is almost smooth, and end at all other planes.
  vec3 overlaps = splatOverlaps(splatParticle);
  for (int plane = 0; plane < 3; ++plane)
  {
    splatClipLines[plane] =
      overlaps[plane] >= SPLAT_SMOOTH_OVERLAP ? vec4(0.0) : splatClipLine(splatParticle, plane, disk);
  }
  splatSeenFromSide = disk.seenFrom;
  splatNormalVC = disk.seenFrom * (normalMatrix * disk.normalMC);

  //VTK::CustomBegin::Impl

  //VTK::Color::Impl

  //VTK::Normal::Impl

  //VTK::TCoord::Impl

  //VTK::Clip::Impl

  //VTK::PrimID::Impl

  //VTK::PositionVC::Impl

  //VTK::ValuePass::Impl

  //VTK::Light::Impl

  //VTK::Picking::Impl

  //VTK::CustomEnd::Impl

  if (disk.tangentMC == vec3(0.0))
  {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0); // outside of the picture: there is nothing to draw
  }
}
