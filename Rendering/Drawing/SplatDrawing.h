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

/** Particles that are seen from this side are left out, in the numbers of splatHiddenSide (glsl/Disk.glsl). */
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
  double RadiusScale = 1.; // factor on all radii
  double Sharpness = 2.;   // of the weights, see SplatProfile
  DrawnKind Kind = DrawnKind::All;
  std::optional<int>
    Isovalue;     // number of the isovalue whose particles are drawn; without one, all are
  int Stride = 1; // every Stride-th particle is drawn
  bool FacesViewer = false; // there are no normals
  CulledSide HiddenSide = CulledSide::None;
  bool Colors = false;      // colours or lookup coordinates are accumulated
  bool Strongest = false;   // the strongest particle of every pixel is found
  bool Ghosts = false;      // ghosts have a part in the sums; without it they are left out
  bool ClipsColors = false; // colours end where cells end
  bool ColorGradients =
    false; // colours are lookup coordinates with derivatives; ClipsColors is true then
  double EdgeWidth = 0.; // of the lines where cells end, pixels; 0: there are none
  int NumberOfClippingPlanes = 0;
  float ClippingPlanes[6][4] = {}; // shifted model coordinates
  std::vector<double> Key;         // whatever the picture depends on that no other member says

  /** Chooses the kind and the hidden side: a renderer may draw an actor in two passes, opaque and translucent. */
  void ChooseParticles(vtkRenderer* renderer, vtkActor* actor, bool hasTranslucentCells);

  /** Sets the uniforms of glsl/Disk.glsl, and tells a program where it finds the particles. */
  void SetUniforms(vtkShaderProgram* program) const;

  /** The numbers of the particles that are drawn, counting every Stride-th one: from the first to before the second. */
  std::array<vtkIdType, 2> GetDrawnRange() const;

  /** All that the picture depends on. */
  std::vector<double> GetWholeKey() const;

  /** Whether splats are so small in the picture that points do. */
  bool DrawsPoints() const;

  /**
   * Whether each pixel shows one isovalue only, however near surfaces of other isovalues are. It is not needed where
   * there is one isovalue, nor where a drawing has the particles of one.
   */
  bool TellsIsovaluesApart() const;

  /** Whether layers of one isovalue that lie near each other are told apart. */
  bool TellsLayersApart() const;

  /** Whether splats have to be drawn with their own depth, because the thickness of a surface is too much. */
  bool TellsDepthsApart() const;

  /** Whether all particles of the stride are drawn, ghosts included, and no clipping plane cuts them. */
  bool DrawsAll() const;

  /** Whether it matters where the cells of particles end. */
  bool UsesBorders() const;

  /** Whether splats are bent. */
  bool DrawsCurved() const;
};
}
