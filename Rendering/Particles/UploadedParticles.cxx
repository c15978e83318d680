#include "OpenGL/Functions.h" // before everything that may include an OpenGL header

#include "Particles/UploadedParticles.h"

#include "Particles/CellColors.h"
#include "Particles/ParticleColors.h"
#include "vtkFloatArray.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <utility>

namespace hop
{
//------------------------------------------------------------------------------
std::optional<UploadedParticles::Report> UploadedParticles::Upload(
  vtkOpenGLRenderWindow* window, const ParticleInput& input)
{
  ParticleInput::Key key = input.GetKey();
  if (key == this->Key)
  {
    return std::nullopt;
  }
  SplatParticles particles = SplatParticles::FromPolyData(input.Data, input.DescribeArrays());
  this->Buffers.Upload(window, particles);
  const Report report{ particles.GetNumberOfParticles(), particles.Warped };
  this->PointIds = std::move(particles.PointIds);
  this->CellIds = std::move(particles.CellIds);
  this->Key = std::move(key);
  return report;
}

//------------------------------------------------------------------------------
bool UploadedParticles::UploadColors(vtkOpenGLRenderWindow* window, const ScalarColors& scalars,
  vtkDataArray* cellColors, vtkProperty* property)
{
  const vtkIdType count = this->Buffers.GetNumberOfParticles();
  const std::vector<vtkIdType>& own = scalars.OfCells ? this->CellIds : this->PointIds;
  std::vector<unsigned char> rgba = GatherColors(
    scalars.Rgba, scalars.Tuple >= 0 ? std::vector<vtkIdType>(count, scalars.Tuple) : own, count);
  if (cellColors)
  {
    ReplaceColors(rgba, cellColors, this->CellIds, count, property);
  }
  if (rgba.empty())
  {
    return false;
  }
  this->Buffers.UploadColors(window, rgba);
  // The colours of cells jump, if they differ at all.
  this->ClipsColors =
    this->Buffers.GetHasBorders() && (scalars.OfCells || this->Jump(BrightnessOf(rgba), nullptr));
  return true;
}

//------------------------------------------------------------------------------
// Where values jump from cell to cell they end there, and are averaged with their gradients.
void UploadedParticles::UploadLookup(vtkOpenGLRenderWindow* window, vtkFloatArray* coordinates)
{
  std::vector<float> texels =
    LookupTexels(coordinates, this->PointIds, this->Buffers.GetNumberOfParticles());
  std::vector<std::array<float, 2>> gradients;
  this->ClipsColors = this->Jump(PositionsOf(texels), &gradients);
  for (std::size_t i = 0; i < gradients.size(); ++i)
  {
    std::copy_n(gradients[i].data(), 2, &texels[4 * i + 2]);
  }
  this->Buffers.UploadColors(window, texels);
}

//------------------------------------------------------------------------------
// Whether the values by which particles are coloured jump where cells end; their gradients, if they do.
bool UploadedParticles::Jump(
  const std::vector<float>& values, std::vector<std::array<float, 2>>* gradients)
{
  bool jump = false;
  this->Buffers.Read(
    [&](const SplatBuffers::Mapped& particles)
    {
      const vtkIdType count = this->Buffers.GetNumberOfParticles();
      if (particles.Borders)
      {
        const CellColors colors(
          { particles.CentreRadius, particles.Normal, particles.Borders, count }, values);
        jump = colors.JumpBetweenCells();
        if (jump && gradients)
        {
          *gradients = colors.FitGradients();
        }
      }
    },
    true);
  return jump;
}

//------------------------------------------------------------------------------
void UploadedParticles::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Buffers.ReleaseGraphicsResources(window);
  this->Key = {};
}
}
