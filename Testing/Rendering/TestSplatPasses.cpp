// VTK's lights, materials and render passes show splats as they show the triangles of the same sphere.
#include "SplatScene.h"

#include "vtkActor.h"
#include "vtkAppendPolyData.h"
#include "vtkCamera.h"
#include "vtkCameraPass.h"
#include "vtkDoubleArray.h"
#include "vtkEDLShading.h"
#include "vtkLightKit.h"
#include "vtkNew.h"
#include "vtkOpaquePass.h"
#include "vtkOpenGLRenderer.h"
#include "vtkOrderIndependentTranslucentPass.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderPassCollection.h"
#include "vtkRenderStepsPass.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSSAOPass.h"
#include "vtkSequencePass.h"
#include "vtkShadowMapBakerPass.h"
#include "vtkShadowMapPass.h"
#include "vtkSphereSource.h"
#include "vtkSurfaceSplatMapper.h"
#include "vtkTranslucentPass.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <functional>
#include <vector>

namespace
{
constexpr int Size = 256;

// How a scene is drawn: changes to the sphere's actor, the renderer and the window.
using Style = std::function<void(vtkActor*, vtkRenderer*, vtkRenderWindow*)>;

void Draw(vtkPolyDataMapper* sphere, const Style& style, vtkUnsignedCharArray* pixels)
{
  vtkNew<vtkActor> actor;
  actor->SetMapper(sphere);
  actor->GetProperty()->SetColor(0.9, 0.5, 0.3);
  vtkNew<vtkPlaneSource> floorSource;
  floorSource->SetOrigin(-4., -1.02, -4.);
  floorSource->SetPoint1(4., -1.02, -4.);
  floorSource->SetPoint2(-4., -1.02, 4.);
  vtkNew<vtkPolyDataMapper> floorMapper;
  floorMapper->SetInputConnection(floorSource->GetOutputPort());
  vtkNew<vtkActor> floor;
  floor->SetMapper(floorMapper);
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(0.2, 0.3, 0.4);
  renderer->AddActor(actor);
  renderer->AddActor(floor);
  vtkNew<vtkRenderWindow> window;
  window->SetSize(Size, Size);
  window->SetMultiSamples(0);
  window->SetAlphaBitPlanes(1);
  window->AddRenderer(renderer);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetPosition(2., 2.5, 4.);
  camera->SetFocalPoint(0., -0.2, 0.);
  camera->SetClippingRange(1., 12.);
  style(actor, renderer, window);
  window->Render();
  window->Render();
  window->GetPixelData(0, 0, Size - 1, Size - 1, 0, pixels, 0);
}

vtkSmartPointer<vtkPolyData> TriangulatedSphere(double radius)
{
  vtkNew<vtkSphereSource> source;
  source->SetRadius(radius);
  source->SetThetaResolution(200);
  source->SetPhiResolution(200);
  source->Update();
  return source->GetOutput();
}

// The share of pixels that differ visibly, and only at outlines may a few.
void ExpectTheSame(const Style& style, vtkPolyData* particles, vtkPolyData* mesh)
{
  vtkNew<vtkSurfaceSplatMapper> splats;
  splats->SetInputData(particles);
  vtkNew<vtkPolyDataMapper> triangles;
  triangles->SetInputData(mesh);
  vtkNew<vtkUnsignedCharArray> bySplats;
  vtkNew<vtkUnsignedCharArray> byTriangles;
  Draw(splats, style, bySplats);
  Draw(triangles, style, byTriangles);
  ASSERT_EQ(bySplats->GetNumberOfValues(), byTriangles->GetNumberOfValues());
  int different = 0;
  double brightness = 0.;
  for (vtkIdType i = 0; i < bySplats->GetNumberOfValues(); ++i)
  {
    different += std::abs(bySplats->GetValue(i) - byTriangles->GetValue(i)) > 12;
    brightness += bySplats->GetValue(i);
  }
  EXPECT_LT(different, 0.015 * bySplats->GetNumberOfValues());
  EXPECT_GT(brightness / bySplats->GetNumberOfValues(), 20.); // neither of them black
}

void ExpectTheSame(const Style& style)
{
  ExpectTheSame(style, FibonacciSphere(20000, 1., 0.027), TriangulatedSphere(1.));
}

void UsePass(vtkRenderer* renderer, vtkRenderPass* pass)
{
  vtkOpenGLRenderer::SafeDownCast(renderer)->SetPass(pass);
}
}

TEST(SplatPasses, LightKit)
{
  ExpectTheSame(
    [](vtkActor* actor, vtkRenderer* renderer, vtkRenderWindow*)
    {
      vtkNew<vtkLightKit> kit;
      kit->AddLightsToRenderer(renderer);
      actor->GetProperty()->SetSpecular(0.8);
      actor->GetProperty()->SetSpecularPower(30.);
    });
}

TEST(SplatPasses, PhysicallyBasedMaterial)
{
  ExpectTheSame(
    [](vtkActor* actor, vtkRenderer*, vtkRenderWindow*)
    {
      actor->GetProperty()->SetInterpolationToPBR();
      actor->GetProperty()->SetMetallic(0.5);
      actor->GetProperty()->SetRoughness(0.4);
      actor->GetProperty()->SetCoatStrength(0.5);
    });
}

TEST(SplatPasses, BlendedTranslucency)
{
  ExpectTheSame(
    [](vtkActor* actor, vtkRenderer*, vtkRenderWindow*)
    {
      actor->GetProperty()->SetOpacity(0.5);
      actor->GetProperty()->LightingOff(); // triangles of one mesh are blended in no order
    });
}

TEST(SplatPasses, DepthPeeling)
{
  ExpectTheSame(
    [](vtkActor* actor, vtkRenderer* renderer, vtkRenderWindow*)
    {
      actor->GetProperty()->SetOpacity(0.5);
      renderer->SetUseDepthPeeling(true);
    });
}

TEST(SplatPasses, IsosurfacesShineThroughEachOther)
{
  vtkNew<vtkAppendPolyData> particles;
  vtkNew<vtkAppendPolyData> triangles;
  for (const double radius : { 1., 0.6, 0.3 })
  {
    const auto sphere = FibonacciSphere(20000, radius, 0.027 * radius);
    vtkNew<vtkDoubleArray> isovalues;
    isovalues->SetName("Isovalue");
    isovalues->SetNumberOfTuples(sphere->GetNumberOfPoints());
    isovalues->Fill(radius);
    sphere->GetPointData()->AddArray(isovalues);
    particles->AddInputData(sphere);
    triangles->AddInputData(TriangulatedSphere(radius));
  }
  particles->Update();
  triangles->Update();
  ExpectTheSame(
    [](vtkActor* actor, vtkRenderer* renderer, vtkRenderWindow*)
    {
      actor->GetProperty()->SetOpacity(0.3);
      renderer->SetUseDepthPeeling(true);
      renderer->SetMaximumNumberOfPeels(16);
    },
    particles->GetOutput(), triangles->GetOutput());
}

TEST(SplatPasses, OrderIndependentTranslucency)
{
  ExpectTheSame(
    [](vtkActor* actor, vtkRenderer* renderer, vtkRenderWindow*)
    {
      actor->GetProperty()->SetOpacity(0.5);
      vtkNew<vtkRenderStepsPass> steps;
      vtkNew<vtkTranslucentPass> geometry;
      vtkNew<vtkOrderIndependentTranslucentPass> translucent;
      translucent->SetTranslucentPass(geometry);
      steps->SetTranslucentPass(translucent);
      UsePass(renderer, steps);
    });
}

TEST(SplatPasses, AmbientOcclusion)
{
  ExpectTheSame(
    [](vtkActor*, vtkRenderer* renderer, vtkRenderWindow*)
    {
      vtkNew<vtkRenderStepsPass> steps;
      vtkNew<vtkSSAOPass> occlusion;
      occlusion->SetRadius(0.5);
      occlusion->SetBias(0.01);
      occlusion->SetKernelSize(64);
      occlusion->BlurOn();
      occlusion->SetDelegatePass(steps);
      UsePass(renderer, occlusion);
    });
}

TEST(SplatPasses, EyeDomeLighting)
{
  ExpectTheSame(
    [](vtkActor*, vtkRenderer* renderer, vtkRenderWindow*)
    {
      vtkNew<vtkRenderStepsPass> steps;
      vtkNew<vtkEDLShading> shading;
      shading->SetDelegatePass(steps);
      UsePass(renderer, shading);
    });
}

TEST(SplatPasses, FastAntialiasing)
{
  ExpectTheSame(
    [](vtkActor*, vtkRenderer* renderer, vtkRenderWindow*) { renderer->SetUseFXAA(true); });
}

TEST(SplatPasses, Multisampling)
{
  ExpectTheSame(
    [](vtkActor*, vtkRenderer*, vtkRenderWindow* window) { window->SetMultiSamples(4); });
}

TEST(SplatPasses, Shadows)
{
  ExpectTheSame(
    [](vtkActor*, vtkRenderer* renderer, vtkRenderWindow*)
    {
      vtkNew<vtkLightKit> kit;
      kit->AddLightsToRenderer(renderer);
      vtkNew<vtkShadowMapPass> shadows;
      vtkNew<vtkOpaquePass> opaque;
      vtkNew<vtkRenderPassCollection> passes;
      passes->AddItem(shadows->GetShadowMapBakerPass());
      passes->AddItem(shadows);
      vtkNew<vtkSequencePass> sequence;
      sequence->SetPasses(passes);
      vtkNew<vtkCameraPass> camera;
      camera->SetDelegatePass(sequence);
      UsePass(renderer, camera);
    });
}

TEST(SplatPasses, StereoAndTiles)
{
  ExpectTheSame(
    [](vtkActor*, vtkRenderer*, vtkRenderWindow* window)
    {
      window->SetStereoTypeToAnaglyph();
      window->StereoRenderOn();
      window->SetTileScale(2, 2);
      window->SetTileViewport(0.5, 0., 1., 0.5);
    });
}
