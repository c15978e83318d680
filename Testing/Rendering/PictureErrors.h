// Pixels of a picture of splats that differ from the same surface as rays see it.
#pragma once

#include "SurfaceCases.h"
#include "SurfacePicture.h"

enum class PixelError : char
{
  None,
  // No surface is drawn, though rays meet it at the pixel and all around.
  Hole,
  // Surface is drawn, though no ray at the pixel or around it meets any.
  Beyond,
  // The surface drawn lies more than a tenth of a spacing off, along its normal.
  Depth,
  // The brightness under a headlight is off by more than 25/255.
  Shade,
};

struct PictureErrors
{
  std::vector<PixelError> Pixels;
  // Of either picture.
  int Covered = 0;

  int Count(PixelError error) const;
};

// What is seen at a pixel counts as right if it is right for one of the nine pixels around: outlines and creases may
// run a pixel aside. At outlines a pixel may also be as bright as a mixture of them. Nothing is wrong within two spacings of the near plane, which cuts splats other than rays.
PictureErrors FindErrors(const SurfacePicture& drawn, const SurfacePicture& reference,
  const hop::testing::PictureCamera& camera, double spacing);

// Lower left corners of the squares with the most errors, the worst first, that do not overlap.
std::vector<glm::ivec2> WorstPlaces(const PictureErrors& errors, int size, int side, int count);

// Writes squares of both pictures and of the errors side by side, enlarged, a row each: a picture file (PNG).
void WriteCrops(const SurfacePicture& drawn, const SurfacePicture& reference,
  const PictureErrors& errors, int size, const std::vector<glm::ivec2>& corners, int side,
  const std::string& path);

// A view of all, as default pictures have it.
hop::testing::PictureCamera ViewOfAll(const SurfaceCase& surface, int size);

// A view, eight spacings to each side, of a place from a direction.
hop::testing::PictureCamera ViewNear(
  const SurfaceCase& surface, int size, const glm::dvec3& place, const glm::dvec3& back);

// Views, eight spacings to each side, of the places with the most particles at two edges, the first with the most.
std::vector<hop::testing::PictureCamera> ViewsOfCorners(
  const SurfaceCase& surface, int size, int count);
