// Two mappers that have half of the particles each, and those that touch them as ghosts, draw what one mapper draws.
#include "SplatScene.h"

#include "vtkActor.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkHardwareSelector.h"
#include "vtkIdTypeArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"
#include "vtkSurfaceSplatMapper.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace
{
constexpr double Radius = 0.055;

std::vector<glm::dvec3> Places()
{
  const auto sphere = FibonacciSphere(Count, 1., Radius);
  std::vector<glm::dvec3> places(Count);
  for (int i = 0; i < Count; ++i)
  {
    sphere->GetPoint(i, &places[i].x);
  }
  return places;
}

// Patches of both halves, without symmetry.
bool IsOfFirst(const glm::dvec3& place)
{
  return std::sin(9. * place.x + 1.) * std::cos(8. * place.y) + std::sin(7. * place.z) > 0.;
}

// The particles of one half, and behind them the ghosts.
struct Half
{
  explicit Half(bool first, bool withGhosts = true)
  {
    std::vector<glm::dvec3> own;
    std::vector<glm::dvec3> ghosts;
    const std::vector<glm::dvec3> all = Places();
    std::copy_if(all.begin(), all.end(), std::back_inserter(own),
      [&](const glm::dvec3& place) { return IsOfFirst(place) == first; });
    std::copy_if(all.begin(), all.end(), std::back_inserter(ghosts),
      [&](const glm::dvec3& place)
      {
        return withGhosts && IsOfFirst(place) != first &&
          std::any_of(own.begin(), own.end(),
            [&](const glm::dvec3& other) { return glm::distance(place, other) < 2. * Radius; });
      });
    this->Own = static_cast<int>(own.size());
    vtkNew<vtkUnsignedCharArray> types;
    types->SetName(vtkDataSetAttributes::GhostArrayName());
    for (std::size_t i = 0; i < own.size() + ghosts.size(); ++i)
    {
      types->InsertNextValue(i < own.size() ? 0 : vtkDataSetAttributes::DUPLICATEPOINT);
    }
    own.insert(own.end(), ghosts.begin(), ghosts.end());
    this->Particles = Disks(own, own, Radius);
    this->Particles->GetPointData()->AddArray(types);
  }

  int Own = 0;
  vtkSmartPointer<vtkPolyData> Particles;
};

// A scene of one half, with the other half's actor besides.
struct TwoHalves
{
  explicit TwoHalves(bool withGhosts = true)
    : First(true, withGhosts)
    , Second(false, withGhosts)
    , Scene(First.Particles)
  {
    this->Scene.Mapper->SetModeToSplats();
    this->OtherMapper->SetInputData(this->Second.Particles);
    this->Other->SetMapper(this->OtherMapper);
    this->Scene.Renderer->AddActor(this->Other);
  }

  Half First;
  Half Second;
  SplatScene Scene;
  vtkNew<vtkSurfaceSplatMapper> OtherMapper;
  vtkNew<vtkActor> Other;
};

// How many pixels differ by more than a few levels of colour, or by a thousandth in their place.
int CountDifferences(SplatScene& scene, SplatScene& expected)
{
  int count = 0;
  for (int y = 0; y < SplatScene::Size; ++y)
  {
    for (int x = 0; x < SplatScene::Size; ++x)
    {
      const auto place = scene.PositionAt(x, y);
      const auto right = expected.PositionAt(x, y);
      const bool same = place.has_value() == right.has_value() &&
        (!place || glm::distance(*place, *right) < 1e-3) &&
        glm::distance(scene.ColorAt(x, y), expected.ColorAt(x, y)) < 6.;
      count += !same;
    }
  }
  return count;
}

// Selects all that is seen of an actor.
std::vector<vtkIdType> SelectAll(SplatScene& scene)
{
  vtkNew<vtkHardwareSelector> selector;
  selector->SetRenderer(scene.Renderer);
  selector->SetArea(0, 0, SplatScene::Size - 1, SplatScene::Size - 1);
  selector->SetFieldAssociation(vtkDataObject::FIELD_ASSOCIATION_POINTS);
  vtkSmartPointer<vtkSelection> selection;
  selection.TakeReference(selector->Select());
  std::vector<vtkIdType> all;
  for (unsigned int node = 0; node < selection->GetNumberOfNodes(); ++node)
  {
    auto* ids = vtkIdTypeArray::SafeDownCast(selection->GetNode(node)->GetSelectionList());
    all.insert(all.end(), ids->GetPointer(0), ids->GetPointer(ids->GetNumberOfTuples()));
  }
  return all;
}
}

class SplatGhostsFrom : public ::testing::TestWithParam<SceneView>
{
};

TEST_P(SplatGhostsFrom, TwoMappersDrawWhatOneDraws)
{
  const std::vector<glm::dvec3> places = Places();
  SplatScene whole(Disks(places, places, Radius));
  whole.Mapper->SetModeToSplats();
  whole.LookFrom(GetParam().Direction, GetParam().Parallel);
  whole.Render();
  TwoHalves halves;
  halves.Scene.LookFrom(GetParam().Direction, GetParam().Parallel);
  halves.Scene.Render();
  EXPECT_LT(CountDifferences(halves.Scene, whole),
    100); // at outlines, where one half lies before the other

  TwoHalves without(false);
  without.Scene.LookFrom(GetParam().Direction, GetParam().Parallel);
  without.Scene.Render();
  EXPECT_GT(CountDifferences(without.Scene, whole), 1000) << "ghosts make no difference";
}

TEST_P(SplatGhostsFrom, TranslucentPixelsAreDrawnOnce)
{
  const std::vector<glm::dvec3> places = Places();
  SplatScene whole(Disks(places, places, Radius));
  TwoHalves halves;
  for (vtkActor* actor : { whole.Actor.Get(), halves.Scene.Actor.Get(), halves.Other.Get() })
  {
    actor->GetProperty()->SetOpacity(0.5);
    actor->GetProperty()
      ->BackfaceCullingOn(); // one layer: mappers do not sort theirs into each other
  }
  whole.Mapper->SetModeToSplats();
  for (SplatScene* scene : { &whole, &halves.Scene })
  {
    scene->LookFrom(GetParam().Direction, GetParam().Parallel);
    scene->Render();
  }
  int count = 0;
  for (int y = 0; y < SplatScene::Size; ++y)
  {
    for (int x = 0; x < SplatScene::Size; ++x)
    {
      count += glm::distance(halves.Scene.ColorAt(x, y), whole.ColorAt(x, y)) > 6.;
    }
  }
  EXPECT_LT(count, 10);
}

INSTANTIATE_TEST_SUITE_P(Views, SplatGhostsFrom, ::testing::ValuesIn(SphereViews));

TEST(SplatGhosts, AreNeverSelected)
{
  const Half half(true);
  ASSERT_GT(half.Particles->GetNumberOfPoints(), half.Own + 100);
  SplatScene scene(half.Particles);
  scene.LookFrom({ 0., 0., 1. }, false);
  for (const int mode : { vtkSurfaceSplatMapper::Splats, vtkSurfaceSplatMapper::Disks })
  {
    scene.Mapper->SetMode(mode);
    scene.Render();
    const std::vector<vtkIdType> found = SelectAll(scene);
    EXPECT_GT(found.size(), 500);
    EXPECT_LT(*std::max_element(found.begin(), found.end()), half.Own);
  }
}

TEST(SplatGhosts, AreLeftOutWhereTheyAreNotBlended)
{
  const auto drawn = [](const Half& half, bool blends, int stride)
  {
    SplatScene scene(half.Particles);
    scene.Mapper->SetModeToSplats();
    scene.Mapper->SetBlendGhosts(blends);
    scene.Mapper->SetStride(stride);
    scene.LookFrom({ 0., 0., 1. }, false);
    scene.Render();
    return scene.CountDrawnPixels();
  };
  const Half with(true);
  const Half without(true, false);
  EXPECT_EQ(drawn(with, false, 1), drawn(without, true, 1));
  EXPECT_EQ(drawn(with, true, 3), drawn(without, true, 3));
  EXPECT_LT(drawn(with, true, 1), drawn(without, true, 1)) << "borders are left to the other half";
}

TEST(SplatGhosts, HiddenPointsAreNotDrawn)
{
  const Half half(true);
  auto* types = vtkUnsignedCharArray::SafeDownCast(
    half.Particles->GetPointData()->GetArray(vtkDataSetAttributes::GhostArrayName()));
  types->Fill(vtkDataSetAttributes::HIDDENPOINT);
  SplatScene scene(half.Particles);
  scene.Mapper->SetModeToSplats();
  scene.LookFrom({ 0., 0., 1. }, false);
  scene.Render();
  EXPECT_EQ(scene.CountDrawnPixels(), 0);
}
