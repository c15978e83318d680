// Hardware selection: which particle lies under a pixel.
#include "SplatScene.h"

#include "vtkActor.h"
#include "vtkDataObject.h"
#include "vtkHardwareSelector.h"
#include "vtkIdTypeArray.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"
#include "vtkSphereSource.h"
#include "vtkSurfaceSplatMapper.h"

#include <gtest/gtest.h>

namespace
{
constexpr double DiskRadius = 0.04;

// The particle under one pixel, -1 for none.
vtkIdType Select(SplatScene& scene, int association, int x, int y)
{
  vtkNew<vtkHardwareSelector> selector;
  selector->SetRenderer(scene.Renderer);
  selector->SetArea(x, y, x, y);
  selector->SetFieldAssociation(association);
  vtkSmartPointer<vtkSelection> selection;
  selection.TakeReference(selector->Select());
  if (!selection || selection->GetNumberOfNodes() != 1)
  {
    return -1;
  }
  auto* ids = vtkIdTypeArray::SafeDownCast(selection->GetNode(0)->GetSelectionList());
  return ids && ids->GetNumberOfTuples() == 1 ? ids->GetValue(0) : -1;
}

constexpr int Pixels[][2] = { { 128, 128 }, { 90, 150 }, { 160, 77 }, { 60, 128 } };

void ExpectSelectionOfWhatIsSeen(const std::vector<vtkIdType>& pointOfCell)
{
  vtkSmartPointer<vtkPolyData> sphere = FibonacciSphere(Count, 1., DiskRadius);
  AddVertexCells(sphere, pointOfCell);
  SplatScene scene(sphere);
  scene.LookFrom({ 0.2, 0.1, 1. }, false);
  scene.Render();
  for (const auto& [x, y] : Pixels)
  {
    const auto seen = scene.PositionAt(x, y);
    ASSERT_TRUE(seen);
    const vtkIdType point = Select(scene, vtkDataObject::FIELD_ASSOCIATION_POINTS, x, y);
    const vtkIdType cell = Select(scene, vtkDataObject::FIELD_ASSOCIATION_CELLS, x, y);
    ASSERT_GE(point, 0);
    ASSERT_GE(cell, 0);
    EXPECT_EQ(pointOfCell[cell], point);
    glm::dvec3 position;
    sphere->GetPoint(point, &position.x);
    EXPECT_LT(glm::distance(position, *seen), 1.01 * DiskRadius);
  }
  EXPECT_EQ(Select(scene, vtkDataObject::FIELD_ASSOCIATION_POINTS, 2, 2), -1);
  EXPECT_EQ(Select(scene, vtkDataObject::FIELD_ASSOCIATION_CELLS, 2, 2), -1);
}
}

TEST(DiskSelection, OneCellAPointInOrder)
{
  std::vector<vtkIdType> pointOfCell;
  for (vtkIdType i = 0; i < Count; ++i)
  {
    pointOfCell.push_back(i);
  }
  ExpectSelectionOfWhatIsSeen(pointOfCell);
}

TEST(DiskSelection, CellsInAnotherOrderThanPoints)
{
  std::vector<vtkIdType> pointOfCell;
  for (vtkIdType i = 0; i < Count; ++i)
  {
    pointOfCell.push_back((i * 7 + 13) % Count);
  }
  ExpectSelectionOfWhatIsSeen(pointOfCell);
}

TEST(DiskSelection, WithoutVertexCellsACellAtThePointIsSelected)
{
  vtkNew<vtkSphereSource> source;
  source->SetRadius(1.);
  source->SetThetaResolution(60);
  source->SetPhiResolution(60);
  source->Update();
  vtkPolyData* sphere = source->GetOutput();
  for (int mode : { vtkSurfaceSplatMapper::Disks, vtkSurfaceSplatMapper::Splats })
  {
    SplatScene scene(sphere);
    scene.Mapper->SetMode(mode);
    scene.LookFrom({ 0.2, 0.1, 1. }, false);
    scene.Render();
    for (const auto& [x, y] : Pixels)
    {
      const vtkIdType point = Select(scene, vtkDataObject::FIELD_ASSOCIATION_POINTS, x, y);
      const vtkIdType cell = Select(scene, vtkDataObject::FIELD_ASSOCIATION_CELLS, x, y);
      ASSERT_GE(point, 0);
      ASSERT_GE(cell, 0);
      ASSERT_LT(cell, sphere->GetNumberOfCells());
      EXPECT_TRUE(sphere->IsPointUsedByCell(point, cell)) << "at pixel " << x << ", " << y;
    }
  }
}

TEST(DiskSelection, WithoutCellsOnlyPointsAreSelected)
{
  SplatScene scene(FibonacciSphere(Count, 1., DiskRadius));
  scene.Render();
  for (const auto& [x, y] : Pixels)
  {
    EXPECT_GE(Select(scene, vtkDataObject::FIELD_ASSOCIATION_POINTS, x, y), 0);
    EXPECT_EQ(Select(scene, vtkDataObject::FIELD_ASSOCIATION_CELLS, x, y), -1);
  }
}
