// Isosurfaces of one output that lie nearer to each other than splats are wide.
#include "SplatScene.h"

#include "vtkActor.h"
#include "vtkAppendPolyData.h"
#include "vtkCamera.h"
#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkHardwareSelector.h"
#include "vtkIdTypeArray.h"
#include "vtkLookupTable.h"
#include "vtkPlane.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"
#include "vtkSurfaceSplatMapper.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
const glm::dvec3 Red(255., 0., 0.);
const glm::dvec3 Blue(0., 0., 255.);

// The spacing that the filter gives so many particles on the unit sphere.
double SpacingOf(int count)
{
  return 0.0539 * std::sqrt(5000. / count);
}

vtkSmartPointer<vtkPolyData> Isosurface(
  int count, double sphereRadius, double diskRadius, double isovalue, const glm::dvec3& color)
{
  auto sphere = FibonacciSphere(count, sphereRadius, diskRadius);
  vtkNew<vtkDoubleArray> isovalues;
  isovalues->SetName("Isovalue");
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("Colors");
  colors->SetNumberOfComponents(3);
  for (int i = 0; i < count; ++i)
  {
    isovalues->InsertNextValue(isovalue);
    colors->InsertNextTuple(&color.x);
  }
  sphere->GetPointData()->AddArray(isovalues);
  sphere->GetPointData()->SetScalars(colors);
  return sphere;
}

// A red sphere of radius 1, and a blue one 0.4 spacings inside of it, with smaller disks: these would come
// before the red ones if the surfaces were thought as thick as their disks are wide.
struct NestedSpheres
{
  explicit NestedSpheres(int count)
    : Outer(Isosurface(count, 1., SpacingOf(count), 2., Red))
    , Inner(Isosurface(count, 1. - 0.4 * SpacingOf(count), 0.75 * SpacingOf(count), 1., Blue))
  {
  }

  vtkSmartPointer<vtkPolyData> Append() const
  {
    vtkNew<vtkAppendPolyData> both;
    both->AddInputData(this->Outer);
    both->AddInputData(this->Inner);
    both->Update();
    return both->GetOutput();
  }

  vtkSmartPointer<vtkPolyData> Outer;
  vtkSmartPointer<vtkPolyData> Inner;
};

void ExpectColorOnSphere(const SplatScene& scene, double minimalCosine, const glm::dvec3& color)
{
  const int pixels = scene.ForEachPixelOnSphere(1., minimalCosine,
    [&](int x, int y, glm::dvec3)
    {
      const glm::dvec3 seen = scene.ColorAt(x, y);
      ASSERT_LT(glm::distance(seen, color), 3.)
        << "at pixel " << x << ", " << y << ": " << seen.r << " " << seen.g << " " << seen.b;
    });
  ASSERT_GT(pixels, 10000);
}

// Particles are drawn as triangles if they are few, as points if they are many.
class SplatIsovalues : public testing::TestWithParam<int>
{
protected:
  NestedSpheres Spheres{ GetParam() };
  vtkSmartPointer<vtkPolyData> Both = Spheres.Append();
  SplatScene Scene{ Both };

  void SetUp() override
  {
    this->Scene.Mapper->SetModeToSplats();
    this->Scene.ShowPlainColors();
  }

  void ExpectTheOuterSphere()
  {
    ExpectColorOnSphere(this->Scene, 0.1, Red);
    ForEachPlaceOnSphere(this->Scene,
      [](glm::dvec3 seen, glm::dvec3 onSphere)
      { ASSERT_LT(glm::distance(seen, onSphere), 0.04 * SpacingOf(GetParam())); });
  }
};
}

INSTANTIATE_TEST_SUITE_P(Counts, SplatIsovalues, testing::Values(5000, 40000));

TEST_P(SplatIsovalues, OnlyTheNearestIsSeen)
{
  for (const SceneView& view : SphereViews)
  {
    SCOPED_TRACE(testing::Message() << view);
    this->Scene.LookFrom(view.Direction, view.Parallel);
    this->Scene.Render();
    this->ExpectTheOuterSphere();
  }
}

TEST_P(SplatIsovalues, OnlyTheNearestIsSeenFromInwardToo)
{
  vtkNew<vtkPlane> plane; // leaves the far half
  plane->SetNormal(0., 0., -1.);
  this->Scene.Mapper->AddClippingPlane(plane);
  this->Scene.LookFrom({ 0., 0., 1. }, true);
  this->Scene.Render();
  ExpectColorOnSphere(this->Scene, 0.4, Blue);
}

TEST_P(SplatIsovalues, TheStrongestParticleIsOneOfTheNearest)
{
  vtkNew<vtkLookupTable> categories;
  categories->IndexedLookupOn();
  categories->SetNumberOfTableValues(2);
  categories->SetAnnotation(vtkVariant(1.), "inner");
  categories->SetAnnotation(vtkVariant(2.), "outer");
  categories->SetTableValue(0, 0., 0., 1.);
  categories->SetTableValue(1, 1., 0., 0.);
  this->Scene.Mapper->SetLookupTable(categories);
  this->Scene.Mapper->SetScalarModeToUsePointFieldData();
  this->Scene.Mapper->SelectColorArray("Isovalue");
  this->Scene.Render();
  this->ExpectTheOuterSphere();
}

TEST_P(SplatIsovalues, OnlyParticlesOfTheNearestAreSelected)
{
  this->Scene.Render();
  vtkNew<vtkHardwareSelector> selector;
  selector->SetRenderer(this->Scene.Renderer);
  selector->SetArea(60, 60, 196, 196);
  selector->SetFieldAssociation(vtkDataObject::FIELD_ASSOCIATION_POINTS);
  vtkSmartPointer<vtkSelection> selection;
  selection.TakeReference(selector->Select());
  ASSERT_EQ(selection->GetNumberOfNodes(), 1u);
  auto* ids = vtkIdTypeArray::SafeDownCast(selection->GetNode(0)->GetSelectionList());
  ASSERT_GT(ids->GetNumberOfTuples(), 500);
  EXPECT_LT(ids->GetValueRange()[1], GetParam()); // the outer ones come first
}

TEST_P(SplatIsovalues, TheNearPlaneCutsThem)
{
  this->Scene.LookFrom({ 0., 0., 1. }, true);
  this->Scene.Renderer->GetActiveCamera()->SetClippingRange(3.2, 7.);
  this->Scene.Render();
  int wrong = 0;
  int cut = 0;
  this->Scene.ForEachPixelOnSphere(1., 0.3,
    [&](int x, int y, glm::dvec3 onSphere)
    {
      // Where the outer sphere is cut off, the inward side of the inner one is seen.
      const bool isCut = onSphere.z > 0.8;
      const bool isAtCut = std::abs(onSphere.z - 0.8) < 0.5 * SpacingOf(GetParam());
      wrong += !isAtCut && glm::distance(this->Scene.ColorAt(x, y), isCut ? Blue : Red) > 3.;
      cut += isCut;
    });
  EXPECT_GT(cut, 5000);
  EXPECT_LT(wrong, 10); // points are not cut themselves
}

TEST(SplatsOfManyIsovalues, AreToldApart)
{
  vtkNew<vtkAppendPolyData> all;
  const double spacing = SpacingOf(5000);
  for (int i = 0; i < 12; ++i)
  {
    all->AddInputData(Isosurface(5000, 1. - 0.2 * i * spacing, spacing, i, i ? Blue : Red));
  }
  all->Update();
  SplatScene scene(all->GetOutput());
  scene.Mapper->SetModeToSplats();
  scene.ShowPlainColors();
  scene.Render();
  ExpectColorOnSphere(scene, 0.1, Red);
}

// Few particles, whose planes would break through the surface in front.
TEST(BentSplatsOfTwoIsovalues, AreToldApart)
{
  constexpr int count = 500;
  const double gap = 0.3 * SpacingOf(count);
  vtkNew<vtkAppendPolyData> both;
  for (const double radius : { 1., 1. - gap })
  {
    const auto sphere =
      Isosurface(count, radius, SpacingOf(count), radius, radius == 1. ? Red : Blue);
    AddShapeOfSphere(sphere, radius);
    both->AddInputData(sphere);
  }
  both->Update();
  SplatScene scene(both->GetOutput());
  scene.Mapper->SetModeToSplats();
  scene.ShowPlainColors();
  for (const SceneView& view : SphereViews)
  {
    SCOPED_TRACE(testing::Message() << view);
    scene.LookFrom(view.Direction, view.Parallel);
    scene.Render();
    ExpectColorOnSphere(scene, Inside, Red);
  }
  vtkNew<vtkPlane> plane; // leaves the far half
  plane->SetNormal(0., 0., -1.);
  scene.Mapper->AddClippingPlane(plane);
  scene.LookFrom({ 0., 0., 1. }, true);
  scene.Render();
  ExpectColorOnSphere(scene, 0.5, Blue);
}
