/**
 * @struct SplatDrawing
 * @brief  what the splat passes draw, and how
 */

#pragma once

#include "vtkType.h"

#include <array>
#include <optional>
#include <vector>

class vtkActor;
class vtkOpenGLRenderWindow;
class vtkRenderer;
class vtkShaderProgram;

namespace hop
{
class SplatBuffers;
class SplatView;

/** Which particles are drawn, in the numbers of splatKind (glsl/Disk.glsl). */
enum class DrawnKind
{
  Opaque = 0,
  Translucent = 1,
  All = 2
};

/** From which side particles are left out that are seen from it, in the numbers of splatHiddenSide (there). */
enum class CulledSide
{
  Inward = -1,
  None = 0,
  Outward = 1
};

struct SplatDrawing
{
  vtkOpenGLRenderWindow* Window = nullptr;
  SplatBuffers* Buffers = nullptr;
  const SplatView* View = nullptr;
  double RadiusScale = 1.;
  double Sharpness = 2.;
  DrawnKind Kind = DrawnKind::All;
  std::optional<int> Isovalue; // of these, the ones of this isovalue; without one, of all
  int Stride = 1;              // every how-manieth particle is drawn
  bool FacesViewer = false;    // there are no normals
  CulledSide HiddenSide = CulledSide::None;
  bool Colors = false;    // colours or lookup coordinates are accumulated
  bool Strongest = false; // the strongest particle of every pixel is found
  int NumberOfClippingPlanes = 0;
  float ClippingPlanes[6][4] = {}; // shifted model coordinates
  std::vector<double> Key;         // whatever else the picture depends on

  /** Chooses the kind and the hidden side: a renderer may draw an actor in two passes, opaque and translucent. */
  void ChooseParticles(vtkRenderer* renderer, vtkActor* actor, bool hasTranslucentCells);

  /** Those uniforms of glsl/Disk.glsl that a program uses, and where it finds the particles. */
  void SetUniforms(vtkShaderProgram* program) const;

  /** Of every Stride-th particle, those from the first to before the second are drawn. */
  std::array<vtkIdType, 2> GetDrawnRange() const;

  /** All that the picture depends on. */
  std::vector<double> GetWholeKey() const;

  /** Whether splats are so small in the picture that points do. */
  bool DrawsPoints() const;

  /**
   * Whether pixels show one isovalue only, however near the others are. (Otherwise there is one, or they are drawn
   * one after the other.)
   */
  bool TellsIsovaluesApart() const;

  /** Whether all particles of the stride are drawn, and none of them is cut by clipping planes. */
  bool DrawsAll() const;

  /** Whether splats are bent. */
  bool DrawsCurved() const;
};
}
