#if __has_include("vtk_glad.h")
#include "vtk_glad.h"
#else
#include "vtk_glew.h"
#endif

#include "SplatScene.h"

#include "BackgroundDepth.h"

#include "vtkActor.h"
#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkPlane.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkShaderProperty.h"
#include "vtkSurfaceSplatMapper.h"

#include <gtest/gtest.h>

#include <cmath>

vtkSmartPointer<vtkPolyData> FibonacciSphere(
  int count, double sphereRadius, double diskRadius, glm::dvec3 centre)
{
  const double goldenAngle = M_PI * (3. - std::sqrt(5.));
  std::vector<glm::dvec3> positions;
  std::vector<glm::dvec3> normals;
  for (int i = 0; i < count; ++i)
  {
    const double z = 1. - (2. * i + 1.) / count;
    const double ring = std::sqrt(1. - z * z);
    normals.emplace_back(ring * std::cos(i * goldenAngle), ring * std::sin(i * goldenAngle), z);
    positions.push_back(centre + sphereRadius * normals.back());
  }
  return Disks(positions, normals, diskRadius);
}

vtkSmartPointer<vtkPolyData> Disks(
  const std::vector<glm::dvec3>& positions, const std::vector<glm::dvec3>& normals, double radius)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> normalArray;
  normalArray->SetName("Normals");
  normalArray->SetNumberOfComponents(3);
  vtkNew<vtkDoubleArray> radii;
  radii->SetName("Radius");
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    points->InsertNextPoint(&positions[i].x);
    normalArray->InsertNextTuple(&normals[i].x);
    radii->InsertNextValue(radius);
  }
  auto particles = vtkSmartPointer<vtkPolyData>::New();
  particles->SetPoints(points);
  particles->GetPointData()->SetNormals(normalArray);
  particles->GetPointData()->AddArray(radii);
  return particles;
}

void AddVertexCells(vtkPolyData* particles, const std::vector<vtkIdType>& order)
{
  vtkNew<vtkCellArray> vertices;
  for (vtkIdType i = 0; i < particles->GetNumberOfPoints(); ++i)
  {
    const vtkIdType point = order.empty() ? i : order[i];
    vertices->InsertNextCell(1, &point);
  }
  particles->SetVerts(vertices);
}

void AddShapeOfSphere(vtkPolyData* particles, double radius)
{
  vtkNew<vtkDoubleArray> shape;
  shape->SetName("Shape_Operator");
  shape->SetNumberOfComponents(6);
  for (vtkIdType i = 0; i < particles->GetNumberOfPoints(); ++i)
  {
    glm::dvec3 x;
    particles->GetPoint(i, &x.x);
    const glm::dvec3 n = glm::normalize(x);
    const double shapeOfUnitSphere[6] = { 1. - n.x * n.x, 1. - n.y * n.y, 1. - n.z * n.z,
      -n.x * n.y, -n.y * n.z, -n.x * n.z };
    for (int c = 0; c < 6; ++c)
    {
      shape->InsertNextValue(shapeOfUnitSphere[c] / radius);
    }
  }
  particles->GetPointData()->AddArray(shape);
}

//------------------------------------------------------------------------------
hop::SplatParticles ReadSplats(vtkPolyData* particles)
{
  auto arrays =
    hop::ParticleArrays::FromPointData(particles->GetPointData(), particles->GetNumberOfPoints());
  arrays.Radii = particles->GetPointData()->GetArray("Radius");
  return hop::SplatParticles::FromPolyData(particles, arrays);
}

//------------------------------------------------------------------------------
SplatScene::SplatScene(vtkPolyData* particles, glm::dvec3 centre)
  : Window(vtkSmartPointer<vtkRenderWindow>::New())
  , Centre(centre)
{
  this->Mapper->SetInputDataObject(particles);
  this->Mapper->SetModeToDisks();
  this->Actor->SetMapper(this->Mapper);
  this->Renderer->AddActor(this->Actor);
  this->Window->SetSize(Size, Size);
  this->Window->SetMultiSamples(0);
  this->Window->AddRenderer(this->Renderer);
  this->LookFrom({ 0., 0., 1. }, false);
}

SplatScene::~SplatScene() = default;

void SplatScene::LookFrom(glm::dvec3 direction, bool parallel, double distance, double halfHeight)
{
  this->Back = glm::normalize(direction);
  const glm::dvec3 notParallel =
    std::abs(this->Back.y) < 0.9 ? glm::dvec3(0., 1., 0.) : glm::dvec3(1., 0., 0.);
  this->Right = glm::normalize(glm::cross(notParallel, this->Back));
  this->Up = glm::cross(this->Back, this->Right);
  this->Parallel = parallel;
  this->Distance = distance;
  this->HalfHeight = halfHeight;
  this->Eye = distance * this->Back;
  this->Near = 0.02 * distance;
  this->Far = distance + 3.;

  vtkCamera* camera = this->Renderer->GetActiveCamera();
  const glm::dvec3 eye = this->Centre + this->Eye;
  camera->SetPosition(eye.x, eye.y, eye.z);
  camera->SetFocalPoint(this->Centre.x, this->Centre.y, this->Centre.z);
  camera->SetViewUp(this->Up.x, this->Up.y, this->Up.z);
  camera->SetParallelProjection(parallel);
  camera->SetParallelScale(halfHeight);
  camera->SetViewAngle(2. * glm::degrees(std::atan(halfHeight / distance)));
  camera->SetClippingRange(this->Near, this->Far);
}

void SplatScene::ShowPlainColors()
{
  this->Actor->GetProperty()->LightingOff();
  this->Actor->GetProperty()->SetAmbient(1.);
  this->Actor->GetProperty()->SetDiffuse(0.);
}

void SplatScene::ShowNormals()
{
  this->Actor->GetShaderProperty()->AddFragmentShaderReplacement("//VTK::Light::Impl", false,
    "//VTK::Light::Impl\n  gl_FragData[0] = vec4(0.5 * normalVCVSOutput + 0.5, 1.0);\n", false);
}

namespace
{
// Drivers report what was wrong here, and glGetError() would say only that something was.
void OnDriverMessage(
  GLenum, GLenum type, GLuint, GLenum, GLsizei, const GLchar* message, const void*)
{
  if (type == GL_DEBUG_TYPE_ERROR)
  {
    ADD_FAILURE() << "OpenGL: " << message;
  }
}

void ListenToDriver()
{
  if (glDebugMessageCallback)
  {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(OnDriverMessage, nullptr);
  }
}
}

void SplatScene::Render()
{
  if (this->Depth.empty())
  {
    this->Window->Start(); // makes the context
    ListenToDriver();
  }
  this->Window->Render();
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));

  this->Depth.resize(Size * Size);
  this->Window->GetZbufferData(0, 0, Size - 1, Size - 1, this->Depth.data());
  unsigned char* pixels = this->Window->GetPixelData(0, 0, Size - 1, Size - 1, 0, 0);
  this->Color.assign(pixels, pixels + 3 * Size * Size);
  delete[] pixels;
}

//------------------------------------------------------------------------------
SplatScene::Ray SplatScene::RayOf(double x, double y) const
{
  const double scale = this->HalfHeight / (0.5 * Size);
  const glm::dvec3 across =
    scale * ((x + 0.5 - 0.5 * Size) * this->Right + (y + 0.5 - 0.5 * Size) * this->Up);
  return this->Parallel ? Ray{ this->Eye + across, -this->Back }
                        : Ray{ this->Eye, across / this->Distance - this->Back };
}

std::optional<glm::dvec3> SplatScene::PositionAt(int x, int y) const
{
  const double depth = this->Depth[y * Size + x];
  if (depth >= BackgroundDepth)
  {
    return std::nullopt;
  }
  const double along = this->Parallel
    ? this->Near + depth * (this->Far - this->Near)
    : this->Near * this->Far / (this->Far - depth * (this->Far - this->Near));
  const Ray ray = this->RayOf(x, y);
  return ray.Origin + along * ray.Direction;
}

glm::dvec3 SplatScene::ColorAt(int x, int y) const
{
  const unsigned char* pixel = &this->Color[3 * (y * Size + x)];
  return { pixel[0], pixel[1], pixel[2] };
}

glm::dvec3 SplatScene::NormalAt(int x, int y) const
{
  const glm::dvec3 n = this->ColorAt(x, y) / 127.5 - 1.;
  return glm::normalize(n.x * this->Right + n.y * this->Up + n.z * this->Back);
}

int SplatScene::CountDrawnPixels() const
{
  int count = 0;
  for (float depth : this->Depth)
  {
    count += depth < BackgroundDepth;
  }
  return count;
}

glm::dvec3 SplatScene::ToEye(glm::dvec3 position) const
{
  return this->Parallel ? this->Back : glm::normalize(this->Eye - position);
}

std::optional<glm::dvec3> SplatScene::HitSphere(double x, double y, double radius) const
{
  const Ray ray = this->RayOf(x, y);
  const double a = glm::dot(ray.Direction, ray.Direction);
  const double b = glm::dot(ray.Origin, ray.Direction);
  const double c = glm::dot(ray.Origin, ray.Origin) - radius * radius;
  const double discriminant = b * b - a * c;
  if (discriminant < 0.)
  {
    return std::nullopt;
  }
  return ray.Origin + (-b - std::sqrt(discriminant)) / a * ray.Direction;
}

int SplatScene::ForEachPixelOnSphere(double radius, double minimalCosine,
  const std::function<void(int x, int y, glm::dvec3 onSphere)>& check) const
{
  int count = 0;
  for (int y = 0; y < Size; ++y)
  {
    for (int x = 0; x < Size; ++x)
    {
      const std::optional<glm::dvec3> hit = this->HitSphere(x, y, radius);
      if (hit && glm::dot(glm::normalize(*hit), this->ToEye(*hit)) > minimalCosine)
      {
        check(x, y, *hit);
        ++count;
      }
    }
  }
  return count;
}

int SplatScene::ForEachDrawnPixel(
  const std::function<void(int x, int y, glm::dvec3 position)>& check) const
{
  int count = 0;
  for (int y = 0; y < Size; ++y)
  {
    for (int x = 0; x < Size; ++x)
    {
      if (const auto position = this->PositionAt(x, y))
      {
        check(x, y, *position);
        ++count;
      }
    }
  }
  return count;
}

//------------------------------------------------------------------------------
void ForEachPlaceOnSphere(const SplatScene& scene,
  const std::function<void(glm::dvec3 seen, glm::dvec3 onSphere)>& check, int atLeast)
{
  const int pixels = scene.ForEachPixelOnSphere(1., Inside,
    [&](int x, int y, glm::dvec3 onSphere)
    {
      SCOPED_TRACE(testing::Message() << "pixel " << x << ", " << y);
      const auto position = scene.PositionAt(x, y);
      ASSERT_TRUE(position) << "a hole";
      check(*position, onSphere);
    });
  ASSERT_GT(pixels, atLeast);
}

void ExpectClippingPlaneCuts(
  SplatScene& scene, const SceneView& view, glm::dvec3 centre, double margin, double tolerance)
{
  scene.LookFrom(view.Direction, view.Parallel);
  // Keeps what lies 0.2 or more towards the viewer's upper right, whatever the view.
  const glm::dvec3 axis = glm::normalize(glm::cross(view.Direction, glm::dvec3(0.3, 0.9, 0.31)));
  const glm::dvec3 origin = centre + 0.2 * axis;
  vtkNew<vtkPlane> plane;
  plane->SetNormal(axis.x, axis.y, axis.z);
  plane->SetOrigin(origin.x, origin.y, origin.z);
  scene.Mapper->AddClippingPlane(plane);
  scene.Render();
  int kept = 0;
  int cut = 0;
  scene.ForEachPixelOnSphere(1., Inside,
    [&](int x, int y, glm::dvec3 onSphere)
    {
      const double side = glm::dot(onSphere, axis) - 0.2;
      const auto position = scene.PositionAt(x, y);
      if (side > margin)
      {
        ASSERT_TRUE(position);
        ASSERT_LT(glm::distance(*position, onSphere), tolerance);
        ++kept;
      }
      else if (side < -margin)
      {
        ASSERT_FALSE(position && glm::distance(*position, onSphere) < 0.01);
        ++cut;
      }
    });
  EXPECT_GT(kept, 3000);
  EXPECT_GT(cut, 3000);
  scene.Mapper->RemoveAllClippingPlanes();
}

void ExpectBothSidesUnlessCulled(SplatScene& scene, int atLeast, int atMost)
{
  const auto expectDrawn = [&]()
  {
    scene.Render();
    EXPECT_GE(scene.CountDrawnPixels(), atLeast);
    EXPECT_LE(scene.CountDrawnPixels(), atMost);
  };
  for (bool parallel : { false, true })
  {
    scene.LookFrom({ 0., 0., -1. }, parallel);
    scene.Actor->GetProperty()->BackfaceCullingOff();
    expectDrawn();
    scene.Actor->GetProperty()->BackfaceCullingOn();
    scene.Render();
    EXPECT_EQ(scene.CountDrawnPixels(), 0);
    scene.LookFrom({ 0., 0., 1. }, parallel);
    expectDrawn();
  }
}

void ExpectStretchedSphere(
  SplatScene& scene, glm::dvec3 scale, double atLeast, double atMost, int pixels)
{
  const glm::dvec3 place(0.1, 0., -0.1);
  scene.LookFrom({ 1., 1., 2. }, false);
  scene.Actor->SetScale(scale.x, scale.y, scale.z);
  scene.Actor->SetPosition(place.x, place.y, place.z);
  scene.Render();
  const int drawn = scene.ForEachDrawnPixel(
    [&](int x, int y, glm::dvec3 position)
    {
      const double distance = glm::length((position - place) / scale);
      ASSERT_GT(distance, atLeast) << "at pixel " << x << ", " << y;
      ASSERT_LT(distance, atMost) << "at pixel " << x << ", " << y;
    });
  EXPECT_GT(drawn, pixels);
}

//------------------------------------------------------------------------------
WarningCounter::WarningCounter(vtkSurfaceSplatMapper* mapper)
{
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(this);
  command->SetCallback(
    [](vtkObject*, unsigned long, void* self, void* text)
    {
      static_cast<WarningCounter*>(self)->Count++;
      static_cast<WarningCounter*>(self)->Text += static_cast<const char*>(text);
    });
  mapper->AddObserver(vtkCommand::WarningEvent, command);
  mapper->AddObserver(vtkCommand::ErrorEvent, command);
}
