#include "Shading/ShaderText.h"

#include "OpenGL/ShaderDefine.h"
#include "Particles/Selection.h"
#include "Particles/SplatParticles.h"
#include "Passes/PictureTiles.h"
#include "SplatDiskGlsl.h"
#include "SplatDiskVSGlsl.h"
#include "SplatEdgeGlsl.h"
#include "SplatOutlineGlsl.h"
#include "SplatRayGlsl.h"
#include "SplatResolveGlsl.h"
#include "SplatResolveVSGlsl.h"
#include "vtkHardwareSelector.h"
#include "vtkShaderProgram.h"

#include <string>
#include <tuple>

namespace hop
{
namespace
{
using Source = SplatColoring::Source;

// Puts code in front of a tag and keeps the tag for VTK's own code.
void InsertBefore(vtkShader* shader, const std::string& tag, const std::string& code)
{
  std::string source = shader->GetSource();
  vtkShaderProgram::Substitute(source, tag, code + "\n" + tag, false);
  shader->SetSource(source);
}

// Puts code behind what VTK will put at a tag.
void InsertAfter(vtkShader* shader, const std::string& tag, const std::string& code)
{
  std::string source = shader->GetSource();
  vtkShaderProgram::Substitute(source, tag, tag + "\n" + code, false);
  shader->SetSource(source);
}

void Replace(vtkShader* shader, const std::string& what, const std::string& code)
{
  std::string source = shader->GetSource();
  vtkShaderProgram::Substitute(source, what, code);
  shader->SetSource(source);
}
}

//------------------------------------------------------------------------------
bool SplatColoring::operator!=(const SplatColoring& other) const
{
  return std::tie(this->From, this->OpacityIsInColors, this->OfScalars) !=
    std::tie(other.From, other.OpacityIsInColors, other.OfScalars);
}

//------------------------------------------------------------------------------
void ShaderText::SetVertexStage(vtkShader* vertex) const
{
  vertex->SetSource(this->DrawsSplats ? SplatResolveVSGlsl : SplatDiskVSGlsl);
  Replace(vertex, "SPLAT_TILE_SIZE", std::to_string(PictureTiles::Size));
  Replace(vertex, "SPLAT_FOLDS", std::to_string(this->Drawn == Part::Folds));
  Replace(vertex, "//Splat::Disk::Dec",
    ShaderDefine("SPLAT_SMOOTH_OVERLAP", SplatParticles::LeastSmoothOverlap) +
      ShaderDefine("SPLAT_BORDERS", SplatParticles::MaximumNumberOfBorders) + SplatDiskGlsl +
      "const int splatVerticesPerParticle = " + (this->DrawsPoints ? "1" : "3") + ";\n");
}

//------------------------------------------------------------------------------
// Code that is inserted behind a tag later stands before code that was inserted earlier: so edges and opacities,
// inserted first, come last.
void ShaderText::InsertColor(vtkShader* fragment) const
{
  this->InsertEdges(fragment);
  this->InsertOpacity(fragment);
  if (this->ColorsBySide)
  {
    this->InsertSideColors(fragment);
  }
  else
  {
    this->InsertParticleColors(fragment);
  }
}

// Lines have their colour whatever the light is, as VTK's own edges of polygons.
void ShaderText::InsertEdges(vtkShader* fragment) const
{
  if (this->DrawsEdges)
  {
    InsertBefore(fragment, "//VTK::Color::Dec", "uniform vec3 splatEdgeColor;");
    InsertAfter(fragment, "//VTK::Color::Impl",
      "  float splatEdge = splatEdgeShare(splat);\n"
      "  ambientColor = mix(ambientColor, splatEdgeColor, splatEdge);\n"
      "  diffuseColor *= 1.0 - splatEdge;\n");
  }
}

void ShaderText::InsertOpacity(vtkShader* fragment) const
{
  if (this->DrawsSplats)
  {
    InsertAfter(fragment, "//VTK::Color::Impl", "  opacity *= splat.coverage;\n");
  }
  if (this->HasBackface)
  {
    InsertBefore(fragment, "//VTK::Color::Dec", "uniform vec2 splatOpacities; // outward, inward");
    InsertAfter(fragment, "//VTK::Color::Impl",
      "  opacity *= splatSeenFromSide > 0.0 ? splatOpacities.x : splatOpacities.y;\n");
  }
}

void ShaderText::InsertSideColors(vtkShader* fragment) const
{
  InsertBefore(fragment, "//VTK::Color::Dec",
    "uniform vec3 splatOutwardColor;\n"
    "uniform vec3 splatInwardColor;");
  InsertAfter(fragment, "//VTK::Color::Impl",
    "  vec3 splatSide = splatSeenFromSide > 0.0 ? splatOutwardColor : splatInwardColor;\n"
    "  ambientColor = ambientIntensity * splatSide;\n"
    "  diffuseColor = diffuseIntensity * splatSide;\n");
}

void ShaderText::InsertParticleColors(vtkShader* fragment) const
{
  const Source from = this->Coloring.From;
  if (from == Source::Property || from == Source::Lookup)
  {
    return; // VTK's own colours are right
  }
  const bool averaged = from == Source::Colors && this->DrawsSplats;
  if (!averaged)
  {
    InsertBefore(fragment, "//VTK::Color::Dec", "uniform samplerBuffer splatColor;");
  }
  InsertAfter(fragment, "//VTK::Color::Impl",
    std::string("  vec4 splatRgba = ") +
      (averaged ? "texelFetch(splatColorSum, splat.texel, 0) / splatColorWeight(splat);\n"
                : "texelFetch(splatColor, splatParticle);\n") +
      (this->SidesDiffer() ? "  if (splatSeenFromSide > 0.0) {\n" : "  {\n") +
      "  ambientColor = ambientIntensity * splatRgba.rgb;\n"
      "  diffuseColor = diffuseIntensity * splatRgba.rgb;\n" +
      (this->Coloring.OpacityIsInColors ? "  opacity = splatRgba.a; }\n"
                                        : "  opacity = opacityUniform * splatRgba.a; }\n"));
}

//------------------------------------------------------------------------------
bool ShaderText::SidesDiffer() const
{
  return this->HasBackface && !this->Coloring.OfScalars && !this->ColorsBySide;
}

void ShaderText::ReplaceSide(vtkShader* fragment) const
{
  // VTK chooses between the two properties by gl_FrontFacing. It says nothing here, as the triangles and points that
  // splats are drawn by have sides of their own.
  Replace(fragment, "gl_FrontFacing", this->SidesDiffer() ? "(splatSeenFromSide > 0.0)" : "true");
}

//------------------------------------------------------------------------------
void ShaderText::ReplaceNormal(vtkShader* fragment) const
{
  Replace(fragment, "//VTK::Normal::Dec", this->DrawsSplats ? "" : "flat in vec3 splatNormalVC;\n");
  std::string code = this->DrawsSplats ? "vec3 normalVCVSOutput = splat.normalVC;\n"
                                       : "vec3 normalVCVSOutput = normalize(splatNormalVC);\n";
  if (this->HasCoat)
  {
    code += "  vec3 coatNormalVCVSOutput = normalVCVSOutput;\n";
  }
  Replace(fragment, "//VTK::Normal::Impl", code);
}

//------------------------------------------------------------------------------
void ShaderText::ReplacePosition(vtkShader* fragment) const
{
  if (!this->DrawsSplats)
  {
    return;
  }
  const bool folds = this->Drawn == Part::Folds;
  Replace(fragment, "//VTK::PositionVC::Dec",
    ShaderDefine("SPLAT_OUTLINE", folds || this->Drawn == Part::Outline) +
      ShaderDefine("SPLAT_FOLDS", folds) + ShaderDefine("SPLAT_EDGES", this->DrawsEdges) +
      ShaderDefine("SPLAT_CLIPS_COLORS", this->ClipsColors) +
      ShaderDefine("SPLAT_GHOSTS", this->HasGhosts) +
      ShaderDefine("SPLAT_BACK_LAYER", this->Drawn == Part::BackLayer) + SplatResolveGlsl);
  Replace(fragment, "//Splat::Ray::Dec", SplatRayGlsl);
  Replace(fragment, "//Splat::Outline::Dec", SplatOutlineGlsl);
  std::string code = "SplatSurface splat = splatResolve();\n"
                     "  vec4 vertexVC = vec4(splat.positionVC, 1.0);\n"
                     "  float splatSeenFromSide = splat.seenFrom;\n"
                     "  gl_FragDepth = splat.depth;\n";
  if (this->Coloring.From == Source::Strongest ||
    this->SelectionPass >= vtkHardwareSelector::MIN_KNOWN_PASS)
  {
    code += "  int splatParticle = splatStrongestAt(splat.texel);\n";
  }
  if (this->Coloring.From == Source::Lookup)
  {
    // Both names that versions of VTK from 9.2 on read.
    code += "  vec2 tcoordVCVSOutput = splatLookupCoordinates(splat);\n"
            "  vec2 colorTCoordVCVSOutput = tcoordVCVSOutput;\n";
  }
  Replace(fragment, "//VTK::PositionVC::Impl", code);
}

//------------------------------------------------------------------------------
// Depth peeling takes the depth of a fragment at PreColor, which VTK's template has before Clip: what is no part of a
// splat is discarded before that. Else depths would be peeled at which nothing is drawn, and peeling ends with a peel
// that draws nothing.
void ShaderText::InsertClip(vtkShader* fragment) const
{
  const std::string beforePeeling = "//VTK::DepthPeeling::PreColor";
  if (this->DrawsSplats)
  {
    Replace(fragment, "//VTK::Clip::Dec", ""); // the splat passes have clipped already
    Replace(fragment, "//VTK::Clip::Impl", "");
    InsertBefore(fragment, beforePeeling, "if (!splat.covered) discard;");
    return;
  }
  InsertBefore(fragment, "//VTK::Clip::Dec",
    "in vec2 splatDiskCoord;\n"
    "flat in vec4 splatClipLines[3];\n"
    "flat in int splatParticle;\n"
    "flat in float splatSeenFromSide;\n" +
      std::string(SplatEdgeGlsl));
  InsertBefore(fragment, beforePeeling,
    "if (dot(splatDiskCoord, splatDiskCoord) > 1.0 ||\n"
    "    splatBehindLine(splatClipLines[0], splatDiskCoord) > 0.0 ||\n"
    "    splatBehindLine(splatClipLines[1], splatDiskCoord) > 0.0 ||\n"
    "    splatBehindLine(splatClipLines[2], splatDiskCoord) > 0.0) discard;");
}

//------------------------------------------------------------------------------
void ShaderText::ReplacePicking(const std::map<vtkShader::Type, vtkShader*>& shaders) const
{
  const std::string code = SelectionCode(this->SelectionPass);
  if (!code.empty())
  {
    Replace(shaders.at(vtkShader::Fragment), "//VTK::Picking::Dec",
      "uniform samplerBuffer splatPointIds;\n");
    Replace(shaders.at(vtkShader::Fragment), "//VTK::Picking::Impl", code);
    Replace(shaders.at(vtkShader::Vertex), "//VTK::Picking::Dec", "");
    Replace(shaders.at(vtkShader::Vertex), "//VTK::Picking::Impl", "");
  }
}

//------------------------------------------------------------------------------
void ShaderText::ReplaceDepth(vtkShader* fragment) const
{
  if (this->DrawsSplats)
  {
    // Depth offsets and render passes ask for the fragment's depth, which is the tile's, and mean the surface's.
    Replace(fragment, "gl_FragCoord.z", "gl_FragDepth");
  }
}
}
