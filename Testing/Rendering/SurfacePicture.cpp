#include "SurfacePicture.h"

#include "BackgroundDepth.h"
#include "Common/VtkThreads.h"
#include "Conversion/GridElements.h"
#include "SurfaceCases.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkImageData.h"
#include "vtkPNGWriter.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkShaderProperty.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>

using hop::testing::PictureCamera;
using hop::testing::SeenPoint;

namespace
{
constexpr double DepthTarget = 0.02; // spacings
constexpr double NormalTarget = 2.;  // degrees

// Depth of the farthest corner of bounds.
double FarthestDepth(const double bounds[6], const PictureCamera& camera)
{
  double farthest = 0.;
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::dvec3 place(bounds[corner % 2], bounds[2 + corner / 2 % 2], bounds[4 + corner / 4]);
    farthest = std::max(farthest, camera.distance - glm::dot(place - camera.centre, camera.back));
  }
  return farthest;
}

struct Window
{
  vtkNew<vtkActor> Actor;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Render;
  double Near = 0.;
  double Far = 0.;

  Window(vtkPolyDataMapper* mapper, const PictureCamera& camera)
  {
    this->Actor->SetMapper(mapper);
    this->Actor->GetProperty()->SetColor(1., 1., 1.);
    this->Renderer->AddActor(this->Actor);
    this->Render->SetSize(camera.size, camera.size);
    this->Render->SetMultiSamples(0);
    this->Render->AddRenderer(this->Renderer);
    this->Near = std::max(
      { camera.distance - 1.5 * camera.halfHeight, 0.01 * camera.distance, camera.nearest });
    this->Far = std::max(
      camera.distance + 1.5 * camera.halfHeight, FarthestDepth(mapper->GetBounds(), camera));
    vtkCamera* vtk = this->Renderer->GetActiveCamera();
    const glm::dvec3 eye = camera.eye();
    const glm::dvec3 up = camera.up();
    vtk->SetPosition(eye.x, eye.y, eye.z);
    vtk->SetFocalPoint(camera.centre.x, camera.centre.y, camera.centre.z);
    vtk->SetViewUp(up.x, up.y, up.z);
    vtk->SetParallelProjection(camera.parallel);
    vtk->SetParallelScale(camera.halfHeight);
    vtk->SetViewAngle(2. * glm::degrees(std::atan(camera.halfHeight / camera.distance)));
    vtk->SetClippingRange(this->Near, this->Far);
  }

  double DepthOf(double zBuffer, bool parallel) const
  {
    if (zBuffer >= BackgroundDepth)
    {
      return std::numeric_limits<double>::infinity();
    }
    return parallel ? this->Near + zBuffer * (this->Far - this->Near)
                    : this->Near * this->Far / (this->Far - zBuffer * (this->Far - this->Near));
  }

  std::vector<glm::dvec3> Colors(int size)
  {
    this->Render->Render();
    vtkNew<vtkUnsignedCharArray> pixels;
    this->Render->GetPixelData(0, 0, size - 1, size - 1, 0, pixels, 0);
    std::vector<glm::dvec3> colors;
    for (vtkIdType i = 0; i < size * size; ++i)
    {
      const unsigned char* rgb = pixels->GetPointer(3 * i);
      colors.emplace_back(rgb[0] / 255., rgb[1] / 255., rgb[2] / 255.);
    }
    return colors;
  }
};
}

SurfacePicture DrawSurface(vtkPolyDataMapper* mapper, const PictureCamera& camera)
{
  Window window(mapper, camera);
  SurfacePicture picture;
  for (const glm::dvec3& color : window.Colors(camera.size))
  {
    picture.Shade.push_back(color.g);
  }
  std::vector<float> depth(camera.size * camera.size);
  window.Render->GetZbufferData(0, 0, camera.size - 1, camera.size - 1, depth.data());

  // The normal that VTK's lighting uses, as a colour; at outlines that of the surface that covers more.
  window.Actor->GetShaderProperty()->AddFragmentShaderReplacement("//VTK::Light::Impl", false,
    "//VTK::Light::Impl\n"
    "  gl_FragData[0] = vec4(0.5 * normalVCVSOutput + 0.5, opacity > 0.5 ? 1.0 : 0.0);\n",
    false);
  const std::vector<glm::dvec3> normals = window.Colors(camera.size);
  for (std::size_t i = 0; i < depth.size(); ++i)
  {
    const glm::dvec3 n = 2. * normals[i] - 1.;
    SeenPoint seen;
    seen.depth = window.DepthOf(depth[i], camera.parallel);
    seen.normal = glm::normalize(n.x * camera.right() + n.y * camera.up() + n.z * camera.back);
    picture.Seen.push_back(seen);
  }
  return picture;
}

std::vector<glm::dvec3> DrawColors(vtkPolyDataMapper* mapper, const PictureCamera& camera,
  const std::function<void(vtkProperty*)>& change)
{
  Window window(mapper, camera);
  window.Actor->GetProperty()->SetAmbient(1.);
  window.Actor->GetProperty()->SetDiffuse(0.);
  change(window.Actor->GetProperty());
  return window.Colors(camera.size);
}

SurfacePicture CastSurface(const SurfaceCase& surface, const PictureCamera& camera)
{
  vtkDataArray* array = surface.Grid->GetPointData()->GetArray(surface.Array.c_str());
  // As the filter contours by default.
  const int component = array->GetNumberOfComponents() > 1 ? hop::InputBlocks::Magnitude : 0;
  const hop::InputBlocks blocks({ { surface.Grid, array, nullptr, "" } }, component);
  SurfacePicture picture;
  withThreads(
    [&](const hop::ParallelFor& parallelFor)
    {
      const hop::GridElements elements = hop::buildGridElements(
        blocks, hop::NodeSpacing::Uniform, { surface.Isovalue }, parallelFor);
      picture.Seen = hop::testing::castRays(
        elements.mesh, elements.fieldIsovalue(surface.Isovalue), camera, parallelFor);
    });
  for (int i = 0; i < camera.size * camera.size; ++i)
  {
    SeenPoint& seen = picture.Seen[i];
    const auto ray = camera.ray(i % camera.size + 0.5, i / camera.size + 0.5);
    if (glm::dot(seen.normal, ray.direction) > 0.)
    {
      seen.normal = -seen.normal;
    }
    picture.Shade.push_back(seen.covered() ? std::max(0., glm::dot(seen.normal, camera.back)) : 0.);
  }
  return picture;
}

void WriteShades(
  const std::vector<SurfacePicture>& pictures, const PictureCamera& camera, const std::string& path)
{
  const int count = static_cast<int>(pictures.size());
  vtkNew<vtkImageData> image;
  image->SetDimensions(count * camera.size, camera.size, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  auto* pixel = static_cast<unsigned char*>(image->GetScalarPointer());
  for (int y = 0; y < camera.size; ++y)
  {
    for (const SurfacePicture& picture : pictures)
    {
      const auto row = picture.Shade.begin() + static_cast<std::ptrdiff_t>(y) * camera.size;
      pixel = std::transform(row, row + camera.size, pixel,
        [](double shade) { return static_cast<unsigned char>(std::lround(255. * shade)); });
    }
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName(path.c_str());
  writer->Write();
}

namespace
{
double Percentile99(std::vector<double> values)
{
  if (values.empty())
  {
    return 0.;
  }
  auto at = values.begin() + static_cast<std::ptrdiff_t>(0.99 * (values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double ShareUpTo(const std::vector<double>& values, double bound)
{
  const auto within =
    std::count_if(values.begin(), values.end(), [bound](double v) { return v <= bound; });
  return values.empty() ? 1. : static_cast<double>(within) / values.size();
}

bool IsInterior(const std::vector<SeenPoint>& seen, int size, int x, int y)
{
  if (x < 2 || y < 2 || x >= size - 2 || y >= size - 2)
  {
    return false;
  }
  for (int dy = -2; dy <= 2; ++dy)
  {
    for (int dx = -2; dx <= 2; ++dx)
    {
      if (!seen[(y + dy) * size + x + dx].covered())
      {
        return false;
      }
    }
  }
  return true;
}
}

PictureFigures Compare(const SurfacePicture& drawn, const SurfacePicture& reference,
  const PictureCamera& camera, double spacing)
{
  PictureFigures figures;
  std::vector<double> depthErrors;
  std::vector<double> offsets;
  std::vector<double> normalErrors;
  int either = 0;
  double squares = 0.;
  for (int i = 0; i < camera.size * camera.size; ++i)
  {
    const SeenPoint& a = drawn.Seen[i];
    const SeenPoint& b = reference.Seen[i];
    squares += (drawn.Shade[i] - reference.Shade[i]) * (drawn.Shade[i] - reference.Shade[i]);
    either += a.covered() || b.covered();
    if (a.covered() && b.covered())
    {
      depthErrors.push_back(std::abs(a.depth - b.depth) / spacing);
      const glm::dvec3 ray = camera.ray(i % camera.size + 0.5, i / camera.size + 0.5).direction;
      offsets.push_back(depthErrors.back() * std::abs(glm::dot(ray, b.normal)));
      normalErrors.push_back(
        glm::degrees(std::acos(std::clamp(glm::dot(a.normal, b.normal), -1., 1.))));
    }
    figures.Holes +=
      !a.covered() && IsInterior(reference.Seen, camera.size, i % camera.size, i / camera.size);
  }
  figures.IntersectionOverUnion = either ? static_cast<double>(depthErrors.size()) / either : 1.;
  figures.DepthShare = ShareUpTo(depthErrors, DepthTarget);
  figures.Depth99 = Percentile99(depthErrors);
  figures.OffsetShare = ShareUpTo(offsets, DepthTarget);
  figures.NormalShare = ShareUpTo(normalErrors, NormalTarget);
  figures.Normal99 = Percentile99(normalErrors);
  figures.PeakSignalToNoise = 10. * std::log10(camera.size * camera.size / squares);
  return figures;
}

std::vector<PictureCamera> CamerasAround(const SurfaceCase& surface, bool parallel, int size)
{
  double bounds[6];
  surface.Particles->GetBounds(bounds);
  const glm::dvec3 low(bounds[0], bounds[2], bounds[4]);
  const glm::dvec3 high(bounds[1], bounds[3], bounds[5]);
  std::vector<PictureCamera> cameras;
  for (const glm::dvec3& direction : { glm::dvec3(0., 0., 1.), glm::dvec3(1., -0.3, 0.4),
         glm::dvec3(-0.7, -1.1, 0.6), glm::dvec3(0.3, 1., -0.8), glm::dvec3(-1., 0.2, -0.1) })
  {
    PictureCamera camera;
    camera.centre = 0.5 * (low + high);
    camera.back = glm::normalize(direction);
    camera.parallel = parallel;
    camera.halfHeight = 0.55 * glm::distance(low, high);
    camera.distance = 4. * camera.halfHeight;
    camera.size = size;
    cameras.push_back(camera);
  }
  return cameras;
}
