// What the inward side looks like if the actor has a backface property.
#include "SplatScene.h"

#include "vtkActor.h"
#include "vtkDoubleArray.h"
#include "vtkLookupTable.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSurfaceSplatActor.h"
#include "vtkSurfaceSplatMapper.h"

#include <gtest/gtest.h>

namespace
{
const glm::dvec3 Blue(0., 0., 255.);
const glm::dvec3 Green(0., 255., 0.);
const glm::dvec3 Red(255., 0., 0.);
constexpr int Modes[] = { vtkSurfaceSplatMapper::Splats, vtkSurfaceSplatMapper::Disks,
  vtkSurfaceSplatMapper::Points };

void ExpectColorAt(const SplatScene& scene, int x, int y, glm::dvec3 color)
{
  const glm::dvec3 seen = scene.ColorAt(x, y);
  ASSERT_LT(glm::distance(seen, color), 3.)
    << "at pixel " << x << ", " << y << ": " << seen.r << " " << seen.g << " " << seen.b;
}

// At every pixel that is not background.
void ExpectColor(SplatScene& scene, glm::dvec3 color, int atLeast)
{
  scene.Render();
  const int pixels =
    scene.ForEachDrawnPixel([&](int x, int y, glm::dvec3) { ExpectColorAt(scene, x, y, color); });
  ASSERT_GT(pixels, atLeast);
}

// A sphere, red outside and blue inside.
class Backface : public testing::TestWithParam<int>
{
protected:
  vtkSmartPointer<vtkPolyData> Sphere = FibonacciSphere(Count, 1., 0.0539);
  SplatScene Scene{ Sphere };
  vtkNew<vtkProperty> Inside;
  int AtLeast = this->GetParam() == vtkSurfaceSplatMapper::Points ? 100 : 15000;

  void SetUp() override
  {
    this->Scene.Mapper->SetMode(this->GetParam());
    this->Scene.ShowPlainColors();
    this->Scene.Actor->GetProperty()->SetColor(1., 0., 0.);
    this->Inside->SetColor(0., 0., 1.);
    this->Scene.Actor->SetBackfaceProperty(this->Inside);
  }

  void LookFromWithin() { this->Scene.LookFrom({ 0., 0., 1. }, false, 0.3, 0.3); }

  void ColorByOneScalar(vtkScalarsToColors* table)
  {
    vtkNew<vtkDoubleArray> values;
    values->SetName("Value");
    values->SetNumberOfTuples(Count);
    values->Fill(0.5);
    this->Sphere->GetPointData()->SetScalars(values);
    this->Scene.Mapper->SetLookupTable(table);
  }
};

vtkSmartPointer<vtkLookupTable> OneColor(glm::dvec3 color, double opacity)
{
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  table->SetNumberOfTableValues(1);
  table->SetTableValue(0, color.r / 255., color.g / 255., color.b / 255., opacity);
  return table;
}
}

TEST_P(Backface, IsTheInwardSide)
{
  // Points of the far side are seen between those of the near one.
  if (this->GetParam() != vtkSurfaceSplatMapper::Points)
  {
    this->Scene.LookFrom({ 1., -0.5, 0.7 }, false);
    this->Scene.Render();
    this->Scene.ForEachPixelOnSphere(
      1., 0.3, [&](int x, int y, glm::dvec3) { ExpectColorAt(this->Scene, x, y, Red); });
  }
  this->LookFromWithin();
  ExpectColor(this->Scene, Blue, this->AtLeast);
}

TEST_P(Backface, ComesAndGoes)
{
  this->LookFromWithin();
  for (int i = 0; i < 2; ++i)
  {
    this->Scene.Actor->SetBackfaceProperty(nullptr);
    ExpectColor(this->Scene, Red, this->AtLeast);
    this->Scene.Actor->SetBackfaceProperty(this->Inside);
    ExpectColor(this->Scene, Blue, this->AtLeast);
  }
  this->Inside->SetColor(0., 1., 0.);
  ExpectColor(this->Scene, Green, this->AtLeast);
}

TEST_P(Backface, StaysTheInwardSideInAMirror)
{
  this->LookFromWithin();
  this->Scene.Actor->SetScale(-1., 1., 1.);
  ExpectColor(this->Scene, Blue, this->AtLeast);
}

TEST_P(Backface, IsNotThereWhereItIsCulled)
{
  this->Scene.Actor->GetProperty()->BackfaceCullingOn();
  for (double mirror : { 1., -1. })
  {
    this->Scene.Actor->SetScale(mirror, 1., 1.);
    this->LookFromWithin();
    this->Scene.Render();
    EXPECT_EQ(this->Scene.CountDrawnPixels(), 0);
    this->Scene.LookFrom({ 1., -0.5, 0.7 }, false);
    this->Scene.Render();
    EXPECT_GT(this->Scene.CountDrawnPixels(), this->AtLeast);
  }
}

TEST_P(Backface, IsLitWithItsOwnMaterial)
{
  this->LookFromWithin();
  vtkProperty* outside = this->Scene.Actor->GetProperty();
  outside->LightingOn();
  outside->SetSpecular(1.);
  this->Inside->SetAmbient(0.6);
  this->Inside->SetDiffuse(0.);
  ExpectColor(this->Scene, 0.6 * Blue, this->AtLeast);
  this->Inside->SetSpecular(1.);
  this->Inside->SetSpecularPower(0.);
  this->Inside->SetSpecularColor(0.4, 0., 0.);
  ExpectColor(this->Scene, 0.6 * Blue + 0.4 * Red, this->AtLeast);
}

TEST_P(Backface, HasTheColorsOfScalars)
{
  this->LookFromWithin();
  vtkProperty* outside = this->Scene.Actor->GetProperty();
  outside->LightingOn();
  outside->SetAmbient(1.);
  outside->SetDiffuse(0.);
  this->Inside->SetSpecular(1.); // for polygons, too, it has no part in colours by scalars
  this->Inside->SetSpecularPower(0.);
  vtkSmartPointer<vtkLookupTable> table = OneColor(Green, 1.);
  this->ColorByOneScalar(table);
  for (bool interpolate : { true, false })
  {
    this->Scene.Mapper->SetInterpolateScalarsBeforeMapping(interpolate);
    ExpectColor(this->Scene, Green, this->AtLeast);
  }
  table->SetAnnotation(0.5, "all");
  table->IndexedLookupOn();
  ExpectColor(this->Scene, Green, this->AtLeast);
  this->Scene.Mapper->ScalarVisibilityOff();
  this->Inside->SetSpecular(0.);
  this->Inside->SetAmbient(1.);
  this->Inside->SetDiffuse(0.);
  ExpectColor(this->Scene, Blue, this->AtLeast);
}

TEST_P(Backface, ComesAfterTheColorsOfDirections)
{
  this->LookFromWithin();
  this->Scene.Mapper->ColorByNormalDirectionOn();
  this->Scene.Mapper->SetInwardColor(0., 1., 0.);
  ExpectColor(this->Scene, Green, this->AtLeast);
}

INSTANTIATE_TEST_SUITE_P(Modes, Backface, testing::ValuesIn(Modes));

namespace
{
// Two disks, one behind the other: the near one shows its inward side, the far one its outward side.
class TwoDisks : public testing::TestWithParam<int>
{
protected:
  vtkSmartPointer<vtkPolyData> Pair =
    Disks({ { 0., 0., 0.5 }, { 0., 0., -0.5 } }, { { 0., 0., -1. }, { 0., 0., 1. } }, 0.5);
  SplatScene Scene{ this->Pair };
  vtkNew<vtkProperty> Inward;

  void SetUp() override
  {
    this->Scene.Mapper->SetMode(this->GetParam());
    this->Scene.ShowPlainColors();
    this->Scene.Renderer->SetBackground(0., 1., 0.);
    this->Scene.LookFrom({ 0., 0., 1. }, true, 4., 1.);
    this->Scene.Actor->GetProperty()->SetColor(1., 0., 0.);
    this->Inward->SetColor(0., 0., 1.);
    this->Scene.Actor->SetBackfaceProperty(this->Inward);
  }

  void SetOpacities(double outward, double inward)
  {
    this->Scene.Actor->GetProperty()->SetOpacity(outward);
    this->Inward->SetOpacity(inward);
  }

  // Now the near one shows its outward side.
  void TurnOver()
  {
    vtkDataArray* normals = this->Pair->GetPointData()->GetNormals();
    for (vtkIdType i = 0; i < normals->GetNumberOfTuples(); ++i)
    {
      normals->SetComponent(i, 2, -normals->GetComponent(i, 2));
    }
    normals->Modified();
  }

  void ExpectInTheMiddle(glm::dvec3 color)
  {
    this->Scene.Render();
    ExpectColorAt(this->Scene, SplatScene::Size / 2, SplatScene::Size / 2, color);
  }

  // By an actor that draws each side with those of its kind.
  void DrawSidesApart()
  {
    vtkNew<vtkSurfaceSplatActor> apart;
    apart->ShallowCopy(this->Scene.Actor);
    this->Scene.Renderer->RemoveAllViewProps();
    this->Scene.Renderer->AddActor(apart);
  }
};
}

TEST_P(TwoDisks, HaveOpacitiesOfTheirOwn)
{
  this->SetOpacities(0.5, 0.2);
  this->Scene.Renderer->SetUseDepthPeeling(true);
  this->Scene.Window->SetAlphaBitPlanes(1);
  this->ExpectInTheMiddle(0.2 * Blue + 0.8 * (0.5 * Red + 0.5 * Green));
}

TEST_P(TwoDisks, AnOpaqueOutwardSideIsSeenThroughTheInwardOne)
{
  this->SetOpacities(1., 0.4);
  this->DrawSidesApart();
  for (bool peeling : { false, true })
  {
    this->Scene.Renderer->SetUseDepthPeeling(peeling);
    this->ExpectInTheMiddle(0.4 * Blue + 0.6 * Red);
  }
}

TEST_P(TwoDisks, AnOpaqueInwardSideIsSeenThroughTheOutwardOne)
{
  this->TurnOver();
  this->SetOpacities(0.4, 1.);
  this->DrawSidesApart();
  for (bool peeling : { false, true })
  {
    this->Scene.Renderer->SetUseDepthPeeling(peeling);
    this->ExpectInTheMiddle(0.4 * Red + 0.6 * Blue);
  }
}

INSTANTIATE_TEST_SUITE_P(
  Modes, TwoDisks, testing::Values(vtkSurfaceSplatMapper::Splats, vtkSurfaceSplatMapper::Disks));
