/**
 * @struct ShaderText
 * @brief  the text that the programs of particles have in VTK's shader template, tag by tag
 *
 * The text depends on the members and on nothing else. VTK inserts its own text at the same tags; each function says
 * whether it is to be called before or after VTK's.
 */

#pragma once

#include "vtkShader.h" // for vtkShader::Type

#include <map>

namespace hop
{
/** Where the colour of a pixel comes from. */
struct SplatColoring
{
  enum class Source
  {
    Property, // the actor's property
    Colors,   // one colour a particle, averaged
    Lookup,   // averaged lookup coordinates
    Strongest // one colour a particle, the strongest one's
  };

  Source From = Source::Property;
  bool OpacityIsInColors = false; // the property's opacity is not multiplied in
  bool OfScalars = false;         // both sides have the colours of scalars

  bool operator!=(const SplatColoring& other) const;
};

struct ShaderText
{
  /** What one program draws of a picture. */
  enum class Part
  {
    Surface,  // the nearest surface
    Outline,  // the nearest surface with smooth outlines
    Folds,    // smooth outlines where the surface lies in front of itself
    BackLayer // the farthest surface, where it is not the nearest one
  };

  bool DrawsSplats =
    true; // the sums of a layer are resolved; otherwise each particle is drawn for itself
  bool DrawsPoints = false; // a particle that is drawn for itself is a point; otherwise a disk
  Part Drawn = Part::Surface;
  SplatColoring Coloring;
  bool ClipsColors = false;  // colours end where cells end
  bool DrawsEdges = false;   // lines are drawn there
  bool ColorsBySide = false; // each side has one colour, whatever the coloring says
  bool HasBackface = false;  // the inward side has a property of its own
  bool HasGhosts = false;    // pixels whose strongest particle is a ghost are left to another rank
  bool HasCoat = false;      // the material has a coat, whose normal VTK asks for
  int SelectionPass = -1;    // pass of vtkHardwareSelector; -1: nothing is selected

  /** Replaces the whole vertex stage, VTK's tags included. */
  void SetVertexStage(vtkShader* vertex) const;

  /** Inserts colours and opacities. Before VTK's text. */
  void InsertColor(vtkShader* fragment) const;

  /** Replaces what VTK's colours take for the front side. After VTK's text of colours. */
  void ReplaceSide(vtkShader* fragment) const;

  /** Replaces the normal. VTK's text is not inserted. */
  void ReplaceNormal(vtkShader* fragment) const;

  /** Replaces the position by the surface's. Before VTK's text. */
  void ReplacePosition(vtkShader* fragment) const;

  /** Discards what is no part of the surface. Before VTK's text of clipping planes. */
  void InsertClip(vtkShader* fragment) const;

  /** Replaces what a selection writes. Before VTK's text. */
  void ReplacePicking(const std::map<vtkShader::Type, vtkShader*>& shaders) const;

  /** Replaces the depth of the fragment by the surface's. After all other text. */
  void ReplaceDepth(vtkShader* fragment) const;

private:
  bool SidesDiffer() const;
  void InsertEdges(vtkShader* fragment) const;
  void InsertOpacity(vtkShader* fragment) const;
  void InsertSideColors(vtkShader* fragment) const;
  void InsertParticleColors(vtkShader* fragment) const;
};
}
