/**
 * @struct ShaderText
 * @brief  what the programs of particles have in VTK's shader template, tag by tag
 *
 * Our text depends on the members and on nothing else. VTK inserts its own at the same tags: functions say whether
 * they come before or after that.
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
    Property, // of the actor
    Colors,   // one a particle, averaged
    Lookup,   // averaged lookup coordinates
    Strongest // one a particle, not to be mixed
  };

  Source From = Source::Property;
  bool OpacityIsInColors = false; // the property's has no part in it then
  bool OfScalars = false;         // for both sides

  bool operator!=(const SplatColoring& other) const;
};

struct ShaderText
{
  /** What one program draws of a picture. */
  enum class Part
  {
    Surface,  // what is nearest
    Outline,  // the same, and smooth outlines
    Folds,    // outlines in front of the surface itself
    BackLayer // what is farthest, where that is another surface
  };

  bool DrawsSplats = true;  // resolves the sums of a layer; else each particle is drawn for itself
  bool DrawsPoints = false; // of particles for themselves
  Part Drawn = Part::Surface;
  SplatColoring Coloring;
  bool ColorsBySide = false; // instead of that
  bool HasBackface = false;  // a property of its own for the inward side
  bool HasCoat = false;      // asks for a normal of its own
  int SelectionPass = -1;    // of vtkHardwareSelector; -1: nothing is selected

  /** The vertex stage as a whole, with VTK's tags. */
  void SetVertexStage(vtkShader* vertex) const;

  /** Colours and opacities; before VTK's own. */
  void InsertColor(vtkShader* fragment) const;

  /** Which side VTK's own colours take for the front; after those. */
  void ReplaceSide(vtkShader* fragment) const;

  /** Instead of VTK's own. */
  void ReplaceNormal(vtkShader* fragment) const;

  /** Where the surface is; before VTK's own. */
  void ReplacePosition(vtkShader* fragment) const;

  /** What is no part of the surface; before VTK's own. */
  void InsertClip(vtkShader* fragment) const;

  /** What is selected; before VTK's own. */
  void ReplacePicking(const std::map<vtkShader::Type, vtkShader*>& shaders) const;

  /** Which depth all that asks for one means; after everything else. */
  void ReplaceDepth(vtkShader* fragment) const;

private:
  bool SidesDiffer() const;
  void InsertOpacity(vtkShader* fragment) const;
  void InsertSideColors(vtkShader* fragment) const;
  void InsertParticleColors(vtkShader* fragment) const;
};
}
