// What colour disks have: property, lookup table, direct colours, side of the normal, opacity.
#include "SplatScene.h"

#include "vtkActor.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkLookupTable.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSurfaceSplatMapper.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace
{
constexpr double DiskRadius = 0.04;
const glm::dvec3 Blue(0., 0., 255.);
const glm::dvec3 Red(255., 0., 0.);

vtkSmartPointer<vtkLookupTable> FourColors()
{
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  table->SetNumberOfTableValues(4);
  table->SetTableRange(0., 4.);
  table->SetTableValue(0, 1., 0., 0.);
  table->SetTableValue(1, 0., 1., 0.);
  table->SetTableValue(2, 0., 0.2, 1.);
  table->SetTableValue(3, 1., 1., 0.2);
  return table;
}

// Four classes by height: 0.5, 1.5, 2.5 and 3.5.
double ClassOf(double y)
{
  return std::floor(2. * (std::min(std::max(y, -0.99), 0.99) + 1.)) + 0.5;
}

vtkSmartPointer<vtkDoubleArray> Classes(vtkPolyData* particles, const std::vector<vtkIdType>& order)
{
  auto values = vtkSmartPointer<vtkDoubleArray>::New();
  values->SetName("Class");
  for (vtkIdType point : order)
  {
    double position[3];
    particles->GetPoint(point, position);
    values->InsertNextValue(ClassOf(position[1]));
  }
  return values;
}

std::vector<vtkIdType> Backwards(vtkIdType count)
{
  std::vector<vtkIdType> order(count);
  std::iota(order.rbegin(), order.rend(), vtkIdType(0));
  return order;
}

std::vector<vtkIdType> Forwards(vtkIdType count)
{
  std::vector<vtkIdType> order(count);
  std::iota(order.begin(), order.end(), vtkIdType(0));
  return order;
}

// Every pixel that is not within a disk of the border between two classes.
void ExpectClassColors(const SplatScene& scene, vtkLookupTable* table)
{
  const int pixels = scene.ForEachPixelOnSphere(1., Inside,
    [&](int x, int y, glm::dvec3 p)
    {
      if (ClassOf(p.y - 1.1 * DiskRadius) == ClassOf(p.y + 1.1 * DiskRadius))
      {
        double rgb[3];
        table->GetColor(ClassOf(p.y), rgb);
        for (int i = 0; i < 3; ++i)
        {
          ASSERT_NEAR(scene.ColorAt(x, y)[i], 255. * rgb[i], 1.) << "at pixel " << x << ", " << y;
        }
      }
    });
  ASSERT_GT(pixels, 15000);
}

void ExpectColor(const SplatScene& scene, glm::dvec3 color)
{
  const int pixels = scene.ForEachPixelOnSphere(1., Inside,
    [&](int x, int y, glm::dvec3)
    {
      ASSERT_LT(glm::distance(scene.ColorAt(x, y), color), 1.5)
        << "at pixel " << x << ", " << y << ": " << scene.ColorAt(x, y).r << " "
        << scene.ColorAt(x, y).g << " " << scene.ColorAt(x, y).b;
    });
  ASSERT_GT(pixels, 15000);
}
}

TEST(DiskColors, PropertyColorWithoutScalars)
{
  SplatScene scene(FibonacciSphere(Count, 1., DiskRadius));
  scene.ShowPlainColors();
  scene.Actor->GetProperty()->SetColor(1., 0.4, 0.);
  scene.Render();
  ExpectColor(scene, { 255., 102., 0. });
}

TEST(DiskColors, PointArrayThroughTheLookupTable)
{
  for (bool cells : { false, true })
  {
    vtkSmartPointer<vtkPolyData> sphere = FibonacciSphere(Count, 1., DiskRadius);
    sphere->GetPointData()->AddArray(Classes(sphere, Forwards(Count)));
    if (cells)
    {
      AddVertexCells(sphere, Backwards(Count)); // colours must follow the points, not the cells
    }
    SplatScene scene(sphere);
    scene.ShowPlainColors();
    vtkSmartPointer<vtkLookupTable> table = FourColors();
    scene.Mapper->SetLookupTable(table);
    scene.Mapper->UseLookupTableScalarRangeOn();
    scene.Mapper->InterpolateScalarsBeforeMappingOn(); // without effect, and no error either
    scene.Mapper->SetScalarModeToUsePointFieldData();
    scene.Mapper->SelectColorArray("Class");
    scene.Render();
    ExpectClassColors(scene, table);
  }
}

TEST(DiskColors, CellArrayThroughTheLookupTable)
{
  vtkSmartPointer<vtkPolyData> sphere = FibonacciSphere(Count, 1., DiskRadius);
  AddVertexCells(sphere, Backwards(Count));
  sphere->GetCellData()->AddArray(Classes(sphere, Backwards(Count)));
  SplatScene scene(sphere);
  scene.ShowPlainColors();
  vtkSmartPointer<vtkLookupTable> table = FourColors();
  scene.Mapper->SetLookupTable(table);
  scene.Mapper->UseLookupTableScalarRangeOn();
  scene.Mapper->SetScalarModeToUseCellFieldData();
  scene.Mapper->SelectColorArray("Class");
  scene.Render();
  ExpectClassColors(scene, table);
}

TEST(DiskColors, ANewLookupTableAndANewArrayAreSeen)
{
  vtkSmartPointer<vtkPolyData> sphere = FibonacciSphere(Count, 1., DiskRadius);
  sphere->GetPointData()->AddArray(Classes(sphere, Forwards(Count)));
  SplatScene scene(sphere);
  scene.ShowPlainColors();
  vtkSmartPointer<vtkLookupTable> table = FourColors();
  scene.Mapper->SetLookupTable(table);
  scene.Mapper->UseLookupTableScalarRangeOn();
  scene.Mapper->SetScalarModeToUsePointFieldData();
  scene.Mapper->SelectColorArray("Class");
  scene.Render();
  for (int i = 0; i < 4; ++i)
  {
    table->SetTableValue(i, 0.2, 0.2 * i, 1. - 0.2 * i);
  }
  scene.Render();
  ExpectClassColors(scene, table);

  scene.Mapper->ScalarVisibilityOff();
  scene.Actor->GetProperty()->SetColor(0., 0., 1.);
  scene.Render();
  ExpectColor(scene, Blue);
}

TEST(DiskColors, DirectRgbPointArray)
{
  vtkSmartPointer<vtkPolyData> sphere = FibonacciSphere(Count, 1., DiskRadius);
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("Colors");
  colors->SetNumberOfComponents(3);
  for (int i = 0; i < Count; ++i)
  {
    colors->InsertNextTuple3(10., 200., 90.);
  }
  sphere->GetPointData()->SetScalars(colors);
  SplatScene scene(sphere);
  scene.ShowPlainColors();
  scene.Render();
  ExpectColor(scene, { 10., 200., 90. });
}

TEST(DiskColors, OutwardIsBlueInwardIsRed)
{
  vtkSmartPointer<vtkPolyData> sphere = FibonacciSphere(Count, 1., DiskRadius);
  SplatScene scene(sphere);
  scene.ShowPlainColors();
  scene.Mapper->ColorByNormalDirectionOn();
  scene.Mapper->SetOutwardColor(0., 0., 1.);
  scene.Mapper->SetInwardColor(1., 0., 0.);
  for (bool parallel : { false, true })
  {
    scene.LookFrom({ 1., -0.5, 0.7 }, parallel);
    scene.Render();
    ExpectColor(scene, Blue);
  }

  vtkDataArray* normals = sphere->GetPointData()->GetNormals();
  for (vtkIdType i = 0; i < normals->GetNumberOfTuples(); ++i)
  {
    const double* n = normals->GetTuple3(i);
    normals->SetTuple3(i, -n[0], -n[1], -n[2]);
  }
  normals->Modified();
  for (bool parallel : { false, true })
  {
    scene.LookFrom({ 1., -0.5, 0.7 }, parallel);
    scene.Render();
    ExpectColor(scene, Red);
  }
}

TEST(DiskColors, DefaultsOfTheSidesAreABlueAndARed)
{
  vtkNew<vtkSurfaceSplatMapper> mapper;
  EXPECT_FALSE(mapper->GetColorByNormalDirection());
  EXPECT_GT(mapper->GetOutwardColor()[2], 2. * mapper->GetOutwardColor()[0]);
  EXPECT_GT(mapper->GetOutwardColor()[2], 2. * mapper->GetOutwardColor()[1]);
  EXPECT_GT(mapper->GetInwardColor()[0], 2. * mapper->GetInwardColor()[1]);
  EXPECT_GT(mapper->GetInwardColor()[0], 2. * mapper->GetInwardColor()[2]);
}

TEST(DiskColors, FromTheMiddleOfASphereAllIsInward)
{
  SplatScene scene(FibonacciSphere(Count, 1., DiskRadius));
  scene.ShowPlainColors();
  scene.Mapper->ColorByNormalDirectionOn();
  scene.Mapper->SetOutwardColor(0., 0., 1.);
  scene.Mapper->SetInwardColor(1., 0., 0.);
  scene.LookFrom({ 0., 0., 1. }, false, 0.3, 0.3);
  scene.Render();
  ASSERT_EQ(scene.CountDrawnPixels(), SplatScene::Size * SplatScene::Size);
  for (int y = 0; y < SplatScene::Size; ++y)
  {
    for (int x = 0; x < SplatScene::Size; ++x)
    {
      ASSERT_LT(glm::distance(scene.ColorAt(x, y), Red), 1.5);
    }
  }
}

TEST(DiskColors, OpacityMixesWithTheBackground)
{
  SplatScene scene(Disks({ { 0., 0., 0. } }, { { 0., 0., 1. } }, 0.5));
  scene.ShowPlainColors();
  scene.Renderer->SetBackground(0., 1., 0.);
  scene.Actor->GetProperty()->SetColor(1., 0., 0.);
  scene.Actor->GetProperty()->SetOpacity(0.4);
  scene.Render();
  const glm::dvec3 middle = scene.ColorAt(SplatScene::Size / 2, SplatScene::Size / 2);
  EXPECT_NEAR(middle.r, 0.4 * 255., 2.);
  EXPECT_NEAR(middle.g, 0.6 * 255., 2.);
}

// The picture is covered everywhere by parts of the drawn triangles that lie beyond their disks: these take no part in
// depth peeling, which would end before anything is seen.
TEST(DiskColors, LargeTranslucentDisksAreSeenWhereTheyArePeeled)
{
  SplatScene scene(FibonacciSphere(Count, 1., DiskRadius));
  scene.ShowPlainColors();
  scene.Actor->GetProperty()->SetColor(1., 0.4, 0.);
  scene.Actor->GetProperty()->SetOpacity(0.999);
  scene.Renderer->SetUseDepthPeeling(true);
  for (const double scale : { 1., 2., 3. })
  {
    scene.Mapper->SetRadiusScale(scale);
    scene.Render();
    ExpectColor(scene, { 255., 102., 0. });
  }
}
