// What drawing splats leaves behind: OpenGL's state, memory, pictures of other renderers; and what
// they have to do with other things in the scene.
#if __has_include("vtk_glad.h")
#include "vtk_glad.h"
#else
#include "vtk_glew.h"
#endif

#include "SplatScene.h"

#include "vtkActor.h"
#include "vtkAppendPolyData.h"
#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkHardwareSelector.h"
#include "vtkIdTypeArray.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"
#include "vtkSurfaceSplatMapper.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <string>

#ifndef GLAPIENTRY
#define GLAPIENTRY
#endif

namespace
{
constexpr double Spacing = 0.0539;

// The part of OpenGL's state that drawing has to do with. The program and the texture unit in use are
// VTK's to cache.
std::map<std::string, std::vector<GLint>> GraphicsState()
{
  std::map<std::string, std::vector<GLint>> state;
  const auto add = [&state](const char* name, GLenum what, int size)
  {
    std::vector<GLint> values(size);
    glGetIntegerv(what, values.data());
    state[name] = values;
  };
  add("draw framebuffer", GL_DRAW_FRAMEBUFFER_BINDING, 1);
  add("read framebuffer", GL_READ_FRAMEBUFFER_BINDING, 1);
  add("draw buffer", GL_DRAW_BUFFER0, 1);
  add("second draw buffer", GL_DRAW_BUFFER1, 1);
  add("viewport", GL_VIEWPORT, 4);
  add("scissor", GL_SCISSOR_BOX, 4);
  add("blend source", GL_BLEND_SRC_RGB, 1);
  add("blend destination", GL_BLEND_DST_RGB, 1);
  add("blend source alpha", GL_BLEND_SRC_ALPHA, 1);
  add("blend destination alpha", GL_BLEND_DST_ALPHA, 1);
  add("blend equation", GL_BLEND_EQUATION_RGB, 1);
  add("blend equation alpha", GL_BLEND_EQUATION_ALPHA, 1);
  add("depth function", GL_DEPTH_FUNC, 1);
  add("depth mask", GL_DEPTH_WRITEMASK, 1);
  add("color mask", GL_COLOR_WRITEMASK, 4);
  add("cull face", GL_CULL_FACE_MODE, 1);
  add("vertex array", GL_VERTEX_ARRAY_BINDING, 1);
  add("array buffer", GL_ARRAY_BUFFER_BINDING, 1);
  for (GLenum what : { GL_BLEND, GL_DEPTH_TEST, GL_SCISSOR_TEST, GL_STENCIL_TEST, GL_CULL_FACE,
         GL_MULTISAMPLE, GL_POLYGON_OFFSET_FILL, GL_PROGRAM_POINT_SIZE, GL_DEPTH_CLAMP,
         GL_CLIP_DISTANCE0, GL_CLIP_DISTANCE1 })
  {
    state["enabled " + std::to_string(what)] = { glIsEnabled(what) };
  }
  return state;
}

double ResidentMegabytes()
{
  std::ifstream file("/proc/self/statm");
  double total = 0.;
  double resident = 0.;
  file >> total >> resident;
  return resident * 4096. / 1e6;
}

// Names of textures and framebuffers that the context has.
int CountGraphicsObjects()
{
  int count = 0;
  for (GLuint name = 1; name < 4096; ++name)
  {
    count += glIsTexture(name) + glIsFramebuffer(name) + glIsBuffer(name) + glIsVertexArray(name);
  }
  return count;
}

vtkSmartPointer<vtkActor> PlaneAt(double z)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-3., -3., z);
  plane->SetPoint1(3., -3., z);
  plane->SetPoint2(-3., 3., z);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(plane->GetOutputPort());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetColor(0., 1., 0.);
  return actor;
}
}

TEST(SplatState, IsAsBefore)
{
  SplatScene scene(FibonacciSphere(Count, 1., Spacing));
  scene.Mapper->SetModeToSplats();
  scene.Render();
  for (double opacity : { 1., 0.5 })
  {
    for (int blendEquation : { GL_FUNC_ADD, GL_MAX })
    {
      scene.Actor->GetProperty()->SetOpacity(opacity);
      scene.Actor->SetIsRenderingTranslucentPolygonalGeometry(opacity < 1.);
      scene.LookFrom({ 1., 0.2, opacity }, blendEquation == GL_MAX); // the passes must run again
      glBlendEquation(blendEquation);
      const auto before = GraphicsState();
      scene.Mapper->Render(scene.Renderer, scene.Actor);
      EXPECT_EQ(GraphicsState(), before);
      EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
      glBlendEquation(GL_FUNC_ADD);
    }
  }
}

TEST(SplatState, AThousandPicturesAndManySizesLeakNothing)
{
  SplatScene scene(FibonacciSphere(500, 1., 3.2 * Spacing));
  scene.Mapper->SetModeToSplats();
  scene.Render();
  int objects = 0;
  double memory = 0.;
  for (int picture = 0; picture < 1000; ++picture)
  {
    scene.LookFrom({ 1., 0.001 * picture, 1. }, picture % 2 == 0);
    scene.Window->SetSize(64 + 16 * (picture / 10 % 10), 64);
    scene.Window->Render();
    if (picture == 200) // every size was there twice
    {
      objects = CountGraphicsObjects();
      memory = ResidentMegabytes();
    }
  }
  EXPECT_EQ(CountGraphicsObjects(), objects);
  EXPECT_LT(ResidentMegabytes(), memory + 20.);
}

namespace
{
// How many pixels of the two pictures differ.
int CountDifferent(const SplatScene& a, const SplatScene& b)
{
  int count = 0;
  for (int y = 0; y < SplatScene::Size; ++y)
  {
    for (int x = 0; x < SplatScene::Size; ++x)
    {
      count += glm::distance(a.ColorAt(x, y), b.ColorAt(x, y)) > 0.;
    }
  }
  return count;
}
}

// Depth peeling draws an actor several times a picture.
TEST(SplatState, TranslucentIsosurfacesAreSplattedOnceAPicture)
{
  constexpr int count = 20000;
  constexpr int spheres = 3;
  vtkNew<vtkAppendPolyData> all;
  for (int sphere = 1; sphere <= spheres; ++sphere)
  {
    const double radius = sphere / static_cast<double>(spheres);
    const auto particles = FibonacciSphere(count, radius, radius * Spacing);
    vtkNew<vtkDoubleArray> isovalues;
    isovalues->SetName("Isovalue");
    isovalues->SetNumberOfTuples(count);
    isovalues->Fill(radius);
    particles->GetPointData()->AddArray(isovalues);
    all->AddInputData(particles);
  }
  all->Update();
  SplatScene scene(all->GetOutput());
  scene.Mapper->SetModeToSplats();
  scene.Actor->GetProperty()->SetOpacity(0.3);
  scene.Renderer->SetUseDepthPeeling(true);
  scene.Renderer->SetMaximumNumberOfPeels(8);
  scene.Render();

  scene.LookFrom({ 1., 2., 3. }, false);
  GLuint query = 0;
  GLuint primitives = 0;
  glGenQueries(1, &query);
  glBeginQuery(GL_PRIMITIVES_GENERATED, query);
  scene.Window->Render();
  glEndQuery(GL_PRIMITIVES_GENERATED);
  glGetQueryObjectuiv(query, GL_QUERY_RESULT, &primitives);
  glDeleteQueries(1, &query);
  // Two passes for each of two layers, and tiles of the picture each time.
  EXPECT_GE(primitives, GLuint{ 4 * spheres * count });
  EXPECT_LT(primitives, GLuint{ 5 * spheres * count });
}

// From picture to picture the surface fills less of the window, or another part of it.
TEST(SplatState, NothingIsLeftOfThePictureBefore)
{
  const auto look = [](SplatScene& scene, int picture)
  {
    scene.Mapper->SetModeToSplats();
    const bool translucent = picture % 2 == 1;
    scene.Actor->GetProperty()->SetOpacity(translucent ? 0.5 : 1.);
    scene.Actor->SetPosition(0.07 * picture, 0.05 * picture * (picture % 3 - 1), 0.);
    scene.LookFrom({ 0.1 * picture, 0.2, 1. }, picture % 4 > 1, 4., 1. + 0.4 * (picture / 2));
    scene.Render();
  };
  const auto particles = FibonacciSphere(Count, 1., Spacing);
  SplatScene scene(particles);
  for (int picture = 0; picture < 14; ++picture)
  {
    look(scene, picture);
    SplatScene fresh(particles);
    look(fresh, picture);
    EXPECT_EQ(CountDifferent(scene, fresh), 0) << picture;
  }
}

TEST(SplatState, ReleasedResourcesAreBuiltAgain)
{
  SplatScene scene(FibonacciSphere(Count, 1., Spacing));
  scene.Mapper->SetModeToSplats();
  scene.Render();
  const int pixels = scene.CountDrawnPixels();
  const int objects = CountGraphicsObjects();
  scene.Mapper->ReleaseGraphicsResources(scene.Window);
  EXPECT_LT(CountGraphicsObjects(), objects - 10);
  scene.Render();
  EXPECT_EQ(scene.CountDrawnPixels(), pixels);
}

namespace
{
// As a driver that cannot draw into several floating-point textures at once.
GLenum GLAPIENTRY RefuseSeveralTargets(GLenum)
{
  GLint second = GL_NONE;
  glGetIntegerv(GL_DRAW_BUFFER1, &second);
  return second == GL_NONE ? GL_FRAMEBUFFER_COMPLETE : GL_FRAMEBUFFER_UNSUPPORTED;
}
}

TEST(SplatState, WithoutFloatingPointTargetsThereAreDisksAndOneWarning)
{
  vtkSmartPointer<vtkPolyData> sphere = FibonacciSphere(Count, 1., Spacing);
  SplatScene asDisks(sphere);
  asDisks.Render();

  SplatScene scene(sphere);
  WarningCounter warnings(scene.Mapper);
  scene.Render(); // the window loads OpenGL's functions
  scene.Mapper->SetModeToSplats();
  const auto check = glCheckFramebufferStatus; // a pointer of the OpenGL loader
  glCheckFramebufferStatus = RefuseSeveralTargets;
  scene.Render();
  scene.LookFrom({ 0., 1., 1. }, false);
  scene.Render();
  scene.LookFrom({ 0., 0., 1. }, false);
  scene.Render();
  glCheckFramebufferStatus = check;
  EXPECT_EQ(warnings.Count, 1) << warnings.Text;
  EXPECT_NE(warnings.Text.find("disks"), std::string::npos) << warnings.Text;
  EXPECT_EQ(scene.CountDrawnPixels(), asDisks.CountDrawnPixels());
}

TEST(SplatState, ReleasedResourcesMayComeBackOnABetterDriver)
{
  vtkSmartPointer<vtkPolyData> sphere = FibonacciSphere(Count, 1., Spacing);
  SplatScene fresh(sphere);
  fresh.Mapper->SetModeToSplats();
  fresh.Render();

  SplatScene scene(sphere);
  WarningCounter warnings(scene.Mapper);
  scene.Render(); // the window loads OpenGL's functions
  scene.Mapper->SetModeToSplats();
  const auto check = glCheckFramebufferStatus;
  glCheckFramebufferStatus = RefuseSeveralTargets;
  scene.Render();
  glCheckFramebufferStatus = check;
  EXPECT_EQ(warnings.Count, 1) << warnings.Text;
  scene.Mapper->ReleaseGraphicsResources(scene.Window);
  scene.Render();
  EXPECT_EQ(CountDifferent(scene, fresh), 0);
}

// As of a pane that is closed and opened again.
TEST(SplatState, AViewWithoutPixelsShowsSplatsOnceItHasSome)
{
  vtkSmartPointer<vtkPolyData> sphere = FibonacciSphere(Count, 1., Spacing);
  SplatScene fresh(sphere);
  fresh.Mapper->SetModeToSplats();
  fresh.Render();
  for (const glm::dvec2& size : { glm::dvec2(0., 1.), glm::dvec2(1., 0.), glm::dvec2(0., 0.) })
  {
    SplatScene scene(sphere);
    scene.Mapper->SetModeToSplats();
    WarningCounter warnings(scene.Mapper);
    scene.Renderer->SetViewport(0., 0., size.x, size.y);
    scene.Render();
    scene.Renderer->SetViewport(0., 0., 1., 1.);
    scene.Render();
    EXPECT_EQ(warnings.Count, 0) << warnings.Text;
    EXPECT_EQ(CountDifferent(scene, fresh), 0) << size.x << " x " << size.y;
  }
}

TEST(SplatState, SeveralRenderersShareAWindow)
{
  SplatScene scene(FibonacciSphere(Count, 1., Spacing));
  scene.Mapper->SetModeToSplats();
  scene.ShowPlainColors();
  scene.Renderer->SetViewport(0., 0., 0.5, 1.);
  vtkNew<vtkRenderer> right;
  right->SetViewport(0.5, 0., 1., 1.);
  right->AddActor(scene.Actor);
  right->SetActiveCamera(scene.Renderer->GetActiveCamera());
  scene.Window->AddRenderer(right);
  scene.Render();
  const int half = SplatScene::Size / 2;
  int covered = 0;
  for (int y = 0; y < SplatScene::Size; ++y)
  {
    for (int x = 0; x < half; ++x)
    {
      ASSERT_EQ(scene.PositionAt(x, y).has_value(), scene.PositionAt(x + half, y).has_value());
      ASSERT_EQ(scene.ColorAt(x, y), scene.ColorAt(x + half, y));
      covered += scene.PositionAt(x, y).has_value();
    }
  }
  EXPECT_GT(covered, 5000);
}

TEST(SplatState, OtherGeometryIsCutByTheSurface)
{
  for (bool translucent : { false, true })
  {
    SplatScene scene(FibonacciSphere(Count, 1., Spacing));
    scene.Mapper->SetModeToSplats();
    scene.ShowPlainColors();
    scene.Actor->GetProperty()->SetColor(1., 0., 0.);
    scene.Actor->GetProperty()->SetOpacity(translucent ? 0.5 : 1.);
    scene.Renderer->AddActor(PlaneAt(0.8));
    scene.LookFrom({ 0., 0., 1. }, true);
    scene.Render();
    scene.ForEachPixelOnSphere(1., 0.3,
      [&](int x, int y, glm::dvec3 p)
      {
        if (std::abs(p.z - 0.8) > 0.01)
        {
          const bool red = scene.ColorAt(x, y).r > 100.;
          ASSERT_EQ(red, p.z > 0.8) << "at pixel " << x << ", " << y;
        }
      });
  }
}

TEST(SplatState, MultisampledWindowsShowTheSameSurface)
{
  SplatScene scene(FibonacciSphere(Count, 1., Spacing));
  scene.Mapper->SetModeToSplats();
  scene.ShowPlainColors();
  scene.Window->SetMultiSamples(4);
  scene.Render();
  scene.ForEachPixelOnSphere(
    1., 0.1, [&](int x, int y, glm::dvec3) { ASSERT_GT(scene.ColorAt(x, y).r, 250.); });
}

TEST(SplatState, TheParticleThatCountsMostIsSelected)
{
  vtkSmartPointer<vtkPolyData> sphere = FibonacciSphere(Count, 1., Spacing);
  std::vector<vtkIdType> pointOfCell;
  for (vtkIdType i = 0; i < Count; ++i)
  {
    pointOfCell.push_back((i * 7 + 13) % Count);
  }
  AddVertexCells(sphere, pointOfCell);
  SplatScene scene(sphere);
  scene.Mapper->SetModeToSplats();
  scene.LookFrom({ 0.2, 0.1, 1. }, false);
  scene.Render();
  for (const glm::ivec2& pixel :
    { glm::ivec2(128, 128), glm::ivec2(90, 150), glm::ivec2(160, 77), glm::ivec2(60, 128) })
  {
    const glm::dvec3 seen = *scene.PositionAt(pixel.x, pixel.y);
    vtkIdType nearest = 0;
    double distance = 1e9;
    for (vtkIdType i = 0; i < Count; ++i)
    {
      glm::dvec3 position;
      sphere->GetPoint(i, &position.x);
      if (glm::distance(position, seen) < distance)
      {
        distance = glm::distance(position, seen);
        nearest = i;
      }
    }
    for (int association :
      { vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataObject::FIELD_ASSOCIATION_CELLS })
    {
      vtkNew<vtkHardwareSelector> selector;
      selector->SetRenderer(scene.Renderer);
      selector->SetArea(pixel.x, pixel.y, pixel.x, pixel.y);
      selector->SetFieldAssociation(association);
      vtkSmartPointer<vtkSelection> selection;
      selection.TakeReference(selector->Select());
      ASSERT_EQ(selection->GetNumberOfNodes(), 1u);
      auto* ids = vtkIdTypeArray::SafeDownCast(selection->GetNode(0)->GetSelectionList());
      ASSERT_EQ(ids->GetNumberOfTuples(), 1);
      const vtkIdType id = ids->GetValue(0);
      EXPECT_EQ(
        association == vtkDataObject::FIELD_ASSOCIATION_POINTS ? id : pointOfCell[id], nearest);
    }
  }
}
