// What colour splats have: averaged scalars, categories, colours, opacity.
#include "SplatScene.h"

#include "vtkActor.h"
#include "vtkAppendPolyData.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkLookupTable.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSurfaceSplatMapper.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace
{
constexpr double Spacing = 0.0539;

class SplatColors : public testing::Test
{
protected:
  vtkSmartPointer<vtkPolyData> Sphere = FibonacciSphere(Count, 1., Spacing);
  SplatScene Scene{ Sphere };

  void SetUp() override
  {
    this->Scene.Mapper->SetModeToSplats();
    this->Scene.ShowPlainColors();
    this->Scene.LookFrom({ 0.5, 0.2, 1. }, false);
  }

  // A point array as a function of place, coloured through a table.
  template <typename F>
  void ColorBy(F&& value, vtkScalarsToColors* table)
  {
    vtkNew<vtkDoubleArray> values;
    values->SetName("Value");
    for (int i = 0; i < Count; ++i)
    {
      glm::dvec3 x;
      this->Sphere->GetPoint(i, &x.x);
      values->InsertNextValue(value(x));
    }
    this->Sphere->GetPointData()->AddArray(values);
    this->Scene.Mapper->SetLookupTable(table);
    this->Scene.Mapper->UseLookupTableScalarRangeOn();
    this->Scene.Mapper->SetScalarModeToUsePointFieldData();
    this->Scene.Mapper->SelectColorArray("Value");
  }

  void ExpectRedBelowBlueAbove()
  {
    this->Scene.ForEachPixelOnSphere(1., Inside,
      [&](int x, int y, glm::dvec3 p)
      {
        const glm::dvec3 seen = this->Scene.ColorAt(x, y);
        const bool red = glm::length(seen - glm::dvec3(255., 0., 0.)) < 2.;
        const bool blue = glm::length(seen - glm::dvec3(0., 0., 255.)) < 2.;
        ASSERT_TRUE(red || blue) << "mixed at pixel " << x << ", " << y;
        if (std::abs(p.y) > Spacing)
        {
          ASSERT_EQ(blue, p.y > 0.);
        }
      });
  }

  void ExpectColors(const std::function<glm::dvec3(glm::dvec3)>& colorAt, double tolerance)
  {
    const int pixels = this->Scene.ForEachPixelOnSphere(1., Inside,
      [&](int x, int y, glm::dvec3 p)
      {
        const glm::dvec3 seen = this->Scene.ColorAt(x, y);
        const glm::dvec3 wanted = colorAt(p);
        ASSERT_LT(glm::length(seen - wanted), tolerance)
          << "at pixel " << x << ", " << y << ": " << seen.r << " " << seen.g << " " << seen.b;
      });
    ASSERT_GT(pixels, 15000);
  }
};

vtkSmartPointer<vtkLookupTable> Ramp()
{
  // Red against height, with a green spike in the middle that mixed colours would wash out.
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  table->SetNumberOfTableValues(256);
  table->SetTableRange(-1., 1.);
  for (int i = 0; i < 256; ++i)
  {
    table->SetTableValue(i, i / 255., i >= 120 && i < 136 ? 1. : 0., 1. - i / 255.);
  }
  table->SetNanColor(1., 1., 1., 1.);
  return table;
}
}

TEST_F(SplatColors, TheScalarIsAveragedAndLookedUp)
{
  vtkSmartPointer<vtkLookupTable> table = Ramp();
  this->ColorBy([](glm::dvec3 x) { return x.y; }, table);
  this->Scene.Render();
  int wrong = 0;
  this->Scene.ForEachPixelOnSphere(1., Inside,
    [&](int x, int y, glm::dvec3 p)
    {
      const double entry = (p.y + 1.) * 128.;
      double rgb[3];
      table->GetColor(p.y, rgb);
      const glm::dvec3 wanted = 255. * glm::dvec3(rgb[0], rgb[1], rgb[2]);
      // Within a table entry of the edge of the spike either is right.
      const bool atEdge = std::abs(entry - 120.) < 1.5 || std::abs(entry - 136.) < 1.5;
      wrong += !atEdge && glm::length(this->Scene.ColorAt(x, y) - wanted) > 3.;
    });
  EXPECT_EQ(wrong, 0);
}

TEST_F(SplatColors, NumbersThatAreNoneHaveTheNanColor)
{
  vtkSmartPointer<vtkLookupTable> table = Ramp();
  this->ColorBy(
    [](glm::dvec3 x) { return x.y > 0. ? std::numeric_limits<double>::quiet_NaN() : -1.; }, table);
  this->Scene.Render();
  this->Scene.ForEachPixelOnSphere(1., Inside,
    [&](int x, int y, glm::dvec3 p)
    {
      if (std::abs(p.y) > Spacing)
      {
        const glm::dvec3 wanted = p.y > 0. ? glm::dvec3(255.) : glm::dvec3(0., 0., 255.);
        ASSERT_LT(glm::length(this->Scene.ColorAt(x, y) - wanted), 2.);
      }
    });
}

TEST_F(SplatColors, CategoriesAreNotMixed)
{
  vtkNew<vtkLookupTable> table;
  table->IndexedLookupOn();
  table->SetNumberOfTableValues(2);
  table->SetAnnotation(vtkVariant(0.), "low");
  table->SetAnnotation(vtkVariant(1.), "high");
  table->SetTableValue(0, 1., 0., 0.);
  table->SetTableValue(1, 0., 0., 1.);
  this->ColorBy([](glm::dvec3 x) { return x.y > 0. ? 1. : 0.; }, table);
  this->Scene.Render();
  this->ExpectRedBelowBlueAbove();
  this->Scene.Mapper->SetSharpness(20.);
  this->Scene.Mapper->SetRadiusScale(0.75); // places at the rims of all splats: tiny weights
  this->Scene.Render();
  this->ExpectRedBelowBlueAbove();
}

TEST_F(SplatColors, WithoutInterpolationColorsAreAveraged)
{
  vtkNew<vtkLookupTable> table;
  table->SetNumberOfTableValues(2);
  table->SetTableRange(0., 1.);
  table->SetTableValue(0, 1., 0., 0.);
  table->SetTableValue(1, 0., 0., 1.);
  this->ColorBy([](glm::dvec3 x) { return x.y > 0. ? 1. : 0.; }, table);
  this->Scene.Mapper->InterpolateScalarsBeforeMappingOff();
  this->Scene.Render();
  int mixed = 0;
  this->Scene.ForEachPixelOnSphere(1., Inside,
    [&](int x, int y, glm::dvec3 p)
    {
      const glm::dvec3 seen = this->Scene.ColorAt(x, y);
      ASSERT_NEAR(seen.r + seen.b, 255., 2.);
      mixed += seen.r > 50. && seen.b > 50.;
      if (std::abs(p.y) > 2. * Spacing)
      {
        ASSERT_NEAR(seen.b, p.y > 0. ? 255. : 0., 1.);
      }
    });
  EXPECT_GT(mixed, 100);
}

TEST_F(SplatColors, DirectColors)
{
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("Colors");
  colors->SetNumberOfComponents(3);
  for (int i = 0; i < Count; ++i)
  {
    colors->InsertNextTuple3(10., 200., 90.);
  }
  this->Sphere->GetPointData()->SetScalars(colors);
  this->Scene.Render();
  this->ExpectColors([](glm::dvec3) { return glm::dvec3(10., 200., 90.); }, 2.);

  // And back to the property's colour.
  this->Sphere->GetPointData()->SetScalars(nullptr);
  this->Scene.Actor->GetProperty()->SetColor(1., 0., 0.);
  this->Scene.Render();
  this->ExpectColors([](glm::dvec3) { return glm::dvec3(255., 0., 0.); }, 2.);
}

TEST_F(SplatColors, ModesMayChangeAtAnyTime)
{
  vtkSmartPointer<vtkLookupTable> table = Ramp();
  this->ColorBy([](glm::dvec3) { return -1.; }, table);
  for (int mode :
    { vtkSurfaceSplatMapper::Splats, vtkSurfaceSplatMapper::Disks, vtkSurfaceSplatMapper::Splats })
  {
    this->Scene.Mapper->SetMode(mode);
    this->Scene.Render();
    this->ExpectColors([](glm::dvec3) { return glm::dvec3(0., 0., 255.); }, 2.);
  }
  this->Scene.Mapper->SetModeToPoints();
  this->Scene.Render();
  EXPECT_GT(this->Scene.CountDrawnPixels(), 1500);
  EXPECT_LT(this->Scene.CountDrawnPixels(), 5001);
}

TEST_F(SplatColors, OutwardIsBlueInwardIsRed)
{
  this->Scene.Mapper->ColorByNormalDirectionOn();
  this->Scene.Mapper->SetOutwardColor(0., 0., 1.);
  this->Scene.Mapper->SetInwardColor(1., 0., 0.);
  this->Scene.Render();
  this->ExpectColors([](glm::dvec3) { return glm::dvec3(0., 0., 255.); }, 2.);
  this->Scene.LookFrom({ 0., 0., 1. }, false, 0.3, 0.3); // from within
  this->Scene.Render();
  ASSERT_EQ(this->Scene.CountDrawnPixels(), SplatScene::Size * SplatScene::Size);
  for (int i = 0; i < SplatScene::Size * SplatScene::Size; ++i)
  {
    ASSERT_LT(glm::length(this->Scene.ColorAt(i % SplatScene::Size, i / SplatScene::Size) -
                glm::dvec3(255., 0., 0.)),
      2.);
  }
}

namespace
{
// Red of opacity 0.4 over green, `layers` times.
glm::dvec3 RedOverGreen(int layers)
{
  const double green = std::pow(0.6, layers);
  return 255. * glm::dvec3(1. - green, green, 0.);
}
}

TEST_F(SplatColors, AClosedTranslucentSurfaceHasTwoLayers)
{
  for (bool peeling : { false, true })
  {
    this->Scene.Renderer->SetUseDepthPeeling(peeling);
    this->Scene.Window->SetAlphaBitPlanes(1);
    this->Scene.Renderer->SetBackground(0., 1., 0.);
    this->Scene.Actor->GetProperty()->SetColor(1., 0., 0.);
    this->Scene.Actor->GetProperty()->SetOpacity(0.4);
    this->Scene.Render();
    this->ExpectColors([](glm::dvec3) { return RedOverGreen(2); }, 4.);
  }
}

TEST(SplatLayers, ATranslucentSheetIsThereOnce)
{
  for (bool peeling : { false, true })
  {
    std::vector<glm::dvec3> positions;
    for (int i = 0; i < 900; ++i)
    {
      positions.emplace_back(0.1 * (i % 30) - 1.45, 0.1 * (i / 30) - 1.45, 0.);
    }
    SplatScene scene(Disks(positions, std::vector<glm::dvec3>(900, { 0., 0., 1. }), 0.1));
    scene.Mapper->SetModeToSplats();
    scene.ShowPlainColors();
    scene.Renderer->SetUseDepthPeeling(peeling);
    scene.Renderer->SetBackground(0., 1., 0.);
    scene.Actor->GetProperty()->SetColor(1., 0., 0.);
    scene.Actor->GetProperty()->SetOpacity(0.4);
    scene.LookFrom({ 0.6, 0.2, 1. }, false, 4., 0.7);
    scene.Render();
    for (int i = 0; i < SplatScene::Size * SplatScene::Size; ++i)
    {
      const glm::dvec3 seen = scene.ColorAt(i % SplatScene::Size, i / SplatScene::Size);
      ASSERT_LT(glm::length(seen - RedOverGreen(1)), 4.) << "at pixel " << i;
    }
  }
}

namespace
{
constexpr double Keep = 2.;

// Vertex cells whose own colours depend on the place of their points.
void AddCellColors(vtkPolyData* particles, const std::function<glm::dvec4(glm::dvec3)>& colorAt)
{
  AddVertexCells(particles);
  vtkNew<vtkDoubleArray> colors;
  colors->SetName("Own");
  colors->SetNumberOfComponents(4);
  for (vtkIdType i = 0; i < particles->GetNumberOfPoints(); ++i)
  {
    glm::dvec3 place;
    particles->GetPoint(i, &place.x);
    const glm::dvec4 color = colorAt(place);
    colors->InsertNextTuple(&color.x);
  }
  particles->GetCellData()->AddArray(colors);
}
}

TEST_F(SplatColors, CellsMayHaveColorsOfTheirOwn)
{
  AddCellColors(this->Sphere,
    [](glm::dvec3 x) { return x.y > 0. ? glm::dvec4(0., 0., 1., Keep) : glm::dvec4(Keep); });
  this->Scene.Mapper->SetCellColorArrayName("Own");
  const auto expect = [this](glm::dvec3 below)
  {
    this->Scene.Render();
    this->Scene.ForEachPixelOnSphere(1., Inside,
      [&](int x, int y, glm::dvec3 p)
      {
        if (std::abs(p.y) > 2. * Spacing)
        {
          const glm::dvec3 wanted = p.y > 0. ? glm::dvec3(0., 0., 255.) : below;
          ASSERT_LT(glm::length(this->Scene.ColorAt(x, y) - wanted), 2.);
        }
      });
  };
  for (int mode : { vtkSurfaceSplatMapper::Splats, vtkSurfaceSplatMapper::Disks })
  {
    this->Scene.Mapper->SetMode(mode);
    this->Scene.Mapper->ScalarVisibilityOff();
    for (const glm::dvec3& own : { glm::dvec3(1., 0., 0.), glm::dvec3(0., 1., 0.) })
    {
      this->Scene.Actor->GetProperty()->SetColor(own.r, own.g, own.b);
      expect(255. * own);
    }
    this->Scene.Mapper->ScalarVisibilityOn();
    vtkNew<vtkLookupTable> yellow;
    yellow->SetNumberOfTableValues(1);
    yellow->SetTableValue(0, 1., 1., 0.);
    this->ColorBy([](glm::dvec3 x) { return x.z; }, yellow);
    expect({ 255., 255., 0. });
  }
}

TEST(SplatLayers, OpaqueParticlesAreSeenBehindTranslucentOnes)
{
  for (int mode : { vtkSurfaceSplatMapper::Splats, vtkSurfaceSplatMapper::Disks })
  {
    vtkNew<vtkAppendPolyData> both;
    both->AddInputData(FibonacciSphere(Count, 1., Spacing));
    both->AddInputData(FibonacciSphere(Count, 0.6, Spacing));
    both->Update();
    vtkPolyData* spheres = both->GetOutput();
    AddCellColors(spheres,
      [](glm::dvec3 x)
      { return glm::length(x) > 0.8 ? glm::dvec4(1., 0., 0., 0.4) : glm::dvec4(Keep); });
    SplatScene scene(spheres);
    scene.Mapper->SetMode(mode);
    scene.Mapper->SetCellColorArrayName("Own");
    scene.ShowPlainColors();
    scene.Renderer->SetBackground(0., 1., 0.);
    scene.Renderer->SetUseDepthPeeling(true);
    scene.Window->SetAlphaBitPlanes(1);
    scene.Actor->GetProperty()->SetColor(0., 0., 1.);
    scene.LookFrom({ 0.3, 0.2, 1. }, false);
    scene.Render();
    int checked = 0;
    scene.ForEachPixelOnSphere(0.6, Inside,
      [&](int x, int y, glm::dvec3)
      {
        const glm::dvec3 seen = scene.ColorAt(x, y);
        // Disks overlap, so that several translucent ones may lie before each other.
        const bool once = mode == vtkSurfaceSplatMapper::Splats;
        ASSERT_TRUE(once ? glm::length(seen - glm::dvec3(102., 0., 153.)) < 4.
                         : seen.r > 99. && std::abs(seen.r + seen.b - 255.) < 4.)
          << "at pixel " << x << ", " << y << ": " << seen.r << " " << seen.g << " " << seen.b;
        ++checked;
      });
    EXPECT_GT(checked, 5000);
  }
}

// The name tells particles opaque or translucent, too.
TEST(SplatLayers, CellColorsMayBeNamedAfterAPicture)
{
  vtkSmartPointer<vtkPolyData> sphere = FibonacciSphere(Count, 1., Spacing);
  AddCellColors(sphere, [](glm::dvec3 x) { return glm::dvec4(1., 0., 0., x.y > 0. ? 0.4 : Keep); });
  const auto show = [](SplatScene& scene)
  {
    scene.Mapper->SetModeToSplats();
    scene.ShowPlainColors();
    scene.Mapper->SetCellColorArrayName("Own");
    scene.Render();
  };
  SplatScene fresh(sphere);
  show(fresh);
  SplatScene scene(sphere);
  scene.Mapper->SetModeToSplats();
  scene.Render();
  show(scene);
  int different = 0;
  scene.ForEachPixelOnSphere(1., Inside,
    [&](int x, int y, glm::dvec3) { different += scene.ColorAt(x, y) != fresh.ColorAt(x, y); });
  EXPECT_EQ(different, 0);
}
