/**
 * @class UploadedParticles
 * @brief particles and their colours on the GPU, and the points and cells of the input that they are
 */

#pragma once

#include "Particles/ParticleInput.h"
#include "Particles/SplatBuffers.h"

#include <array>
#include <optional>
#include <vector>

class vtkFloatArray;
class vtkProperty;
class vtkUnsignedCharArray;

namespace hop
{
class UploadedParticles
{
public:
  SplatBuffers Buffers;

  /** What is to be said of an input that was uploaded. */
  struct Report
  {
    vtkIdType Particles; ///< of the input; Buffers may hold fewer
    bool Warped;         ///< see SplatParticles
  };

  /** Replaces the particles. Does nothing, and returns nothing, where they were made from the same input. */
  std::optional<Report> Upload(vtkOpenGLRenderWindow* window, const ParticleInput& input);

  /** Colours that scalars give, as vtkMapper::MapScalars() makes them. */
  struct ScalarColors
  {
    vtkUnsignedCharArray* Rgba; ///< nullptr: none
    bool OfCells;               ///< of the input's cells, not of its points
    vtkIdType Tuple;            ///< the one that all particles have; -1: each has its own
  };

  /**
   * Replaces the colours.
   * @param cellColors come before the scalars', see ReplaceColors(); nullptr: none
   * @param property gives colours where scalars do not
   * @return false if nothing gives particles colours of their own
   */
  bool UploadColors(vtkOpenGLRenderWindow* window, const ScalarColors& scalars,
    vtkDataArray* cellColors, vtkProperty* property);

  /** Replaces the colours by places in a lookup table, as vtkMapper::ColorCoordinates has them. */
  void UploadLookup(vtkOpenGLRenderWindow* window, vtkFloatArray* coordinates);

  /** Colours go on smoothly, until UploadColors() or UploadLookup() finds that they do not. */
  void ForgetColors() { this->ClipsColors = false; }

  /** Whether colours end where cells end. */
  bool GetClipsColors() const { return this->ClipsColors; }

  /** Whether particles are vertex cells of the input. */
  bool AreCells() const { return !this->CellIds.empty(); }

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  bool Jump(const std::vector<float>& values, std::vector<std::array<float, 2>>* gradients);

  std::vector<vtkIdType> PointIds;
  std::vector<vtkIdType> CellIds;
  ParticleInput::Key Key;
  bool ClipsColors = false;
};
}
