// Particles, cameras, properties and windows that nobody should ask for: no OpenGL error, no black picture, and the
// sphere among them is still seen.
#if __has_include("vtk_glad.h")
#include "vtk_glad.h"
#else
#include "vtk_glew.h"
#endif

#include "SplatScene.h"

#include "Common/SplatColumns.h"

#include "vtkActor.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkPlane.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSurfaceSplatMapper.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace
{
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
constexpr double Infinity = std::numeric_limits<double>::infinity();
// Particles of the sphere, and their radius: they are 0.16 apart.
constexpr int SphereCount = 500;
constexpr double SphereRadius = 0.22;
const glm::dvec3 Background(0.1, 0.4, 0.2);

class Dice
{
public:
  explicit Dice(unsigned seed)
    : Engine(seed)
  {
  }
  int Below(int count) { return static_cast<int>(this->Engine() % static_cast<unsigned>(count)); }
  double Between(double low, double high)
  {
    return low + (high - low) * this->Below(1 << 20) / (1 << 20);
  }
  double Within(double low, double high) // evenly in its logarithm
  {
    return std::exp(this->Between(std::log(low), std::log(high)));
  }
  bool Chance(double share) { return this->Between(0., 1.) < share; }
  template <class T>
  T Pick(std::initializer_list<T> choices)
  {
    return choices.begin()[this->Below(static_cast<int>(choices.size()))];
  }
  glm::dvec3 Vector()
  {
    return { this->Between(-1., 1.), this->Between(-1., 1.), this->Between(-1., 1.) };
  }

private:
  std::mt19937 Engine;
};

// Values that float32 or a shader may stumble over.
double OddNumber(Dice& dice)
{
  return dice.Pick(
    { NaN, Infinity, -Infinity, 0., -1., 1e-300, -1e-40, 1e-20, 1e20, -1e37, 1e39, 1e300 });
}

// A sphere, and particles that lack something, in its middle.
vtkSmartPointer<vtkPolyData> SphereAndOddParticles(Dice& dice)
{
  vtkSmartPointer<vtkPolyData> particles = FibonacciSphere(SphereCount, 1., SphereRadius);
  vtkDataArray* normals = particles->GetPointData()->GetNormals();
  vtkDataArray* radii = particles->GetPointData()->GetArray("Radius");
  for (int i = dice.Below(30); i > 0; --i)
  {
    glm::dvec3 place = 0.3 * dice.Vector();
    glm::dvec3 normal = dice.Vector();
    double radius = 0.1;
    switch (dice.Below(3))
    {
      case 0:
        place[dice.Below(3)] = dice.Pick({ NaN, Infinity, -Infinity });
        break;
      case 1:
        normal = dice.Chance(0.5) ? glm::dvec3(0.) : glm::dvec3(OddNumber(dice), 1., 0.);
        break;
      default:
        radius = dice.Pick({ NaN, Infinity, -1., 0., 1e-300, 1e-40 });
    }
    particles->GetPoints()->InsertNextPoint(&place.x);
    normals->InsertNextTuple(&normal.x);
    radii->InsertNextTuple1(radius);
  }
  return particles;
}

template <class Array>
void AddOddArray(vtkFieldData* data, const char* name, int components, vtkIdType tuples, Dice& dice)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  const bool isInteger = array->GetDataType() == VTK_INT;
  for (vtkIdType i = 0; i < tuples; ++i)
  {
    for (int c = 0; c < components; ++c)
    {
      array->SetComponent(i, c,
        isInteger             ? dice.Below(100)
          : dice.Chance(0.05) ? OddNumber(dice)
                              : dice.Between(-1., 1.));
    }
  }
  data->AddArray(array);
}

// Arrays that the mapper knows by name, of the size and type that they have or of another one. Radii and normals keep
// their values where they keep their size.
void AddOddArrays(vtkPolyData* particles, Dice& dice)
{
  const vtkIdType count = particles->GetNumberOfPoints();
  const struct
  {
    const char* Name;
    int Components;
  } known[] = { { "Clip_Normal", 9 }, { "Clip_Distance", 3 }, { "Clip_Angle", 3 },
    { "Clip_Curvature", 3 }, { "Shape_Operator", 6 }, { "Original_Placement", 6 },
    { "Cell_Borders", 16 }, { "Isovalue", 1 },
    { hop::SplatColumnsArray, hop::splatColumnCount(hop::SplatColumns) }, { "Value", 1 } };
  for (const auto& [name, components] : known)
  {
    if (dice.Chance(0.3))
    {
      const int tuples =
        static_cast<int>(dice.Pick<vtkIdType>({ 0, 1, count / 2, count, count + 5 }));
      const int size = dice.Chance(0.3) ? 1 + dice.Below(20) : components;
      using Add = void (*)(vtkFieldData*, const char*, int, vtkIdType, Dice&);
      const auto add = dice.Pick<Add>(
        { AddOddArray<vtkDoubleArray>, AddOddArray<vtkFloatArray>, AddOddArray<vtkIntArray> });
      add(particles->GetPointData(), name, size, tuples, dice);
    }
  }
  if (dice.Chance(0.2))
  {
    particles->GetPointData()->GetArray("Radius")->Resize(dice.Below(SphereCount));
  }
}

// Vertex cells, some of which name points that are not there; colours of cells.
void AddOddCells(vtkPolyData* particles, Dice& dice)
{
  std::vector<vtkIdType> order(particles->GetNumberOfPoints());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    order[i] = static_cast<vtkIdType>(i);
  }
  AddVertexCells(particles, order);
  for (int i = dice.Below(4); i > 0; --i)
  {
    const vtkIdType point = dice.Pick<vtkIdType>({ -1, particles->GetNumberOfPoints(), 1LL << 40 });
    particles->GetVerts()->InsertNextCell(1, &point);
  }
  if (dice.Chance(0.5))
  {
    const vtkIdType cells = particles->GetNumberOfVerts();
    AddOddArray<vtkDoubleArray>(particles->GetCellData(), "Colours", dice.Pick({ 3, 4 }),
      dice.Pick<vtkIdType>({ 0, 1, cells / 2, cells }), dice);
  }
}

void ChooseScalars(SplatScene& scene, vtkPolyData* particles, Dice& dice)
{
  vtkSurfaceSplatMapper* mapper = scene.Mapper;
  mapper->SetScalarVisibility(dice.Chance(0.5));
  mapper->SetInterpolateScalarsBeforeMapping(dice.Chance(0.5));
  mapper->SetScalarRange(dice.Pick({ 0., -1., 1. }), dice.Pick({ 1., 2., 1e30 }));
  const char* names[] = { "Value", "Isovalue", "Radius", "missing", "Clip_Normal" };
  mapper->SetScalarModeToUsePointFieldData();
  mapper->SelectColorArray(names[dice.Below(5)]);
  mapper->SetColorModeToMapScalars();
  mapper->SetCellColorArrayName(
    dice.Chance(0.3) && particles->GetNumberOfVerts() > 0 ? "Colours" : nullptr);
}

// What a panel offers. Returns whether the sphere has to be seen all over.
bool ChooseProperties(SplatScene& scene, Dice& dice)
{
  vtkSurfaceSplatMapper* mapper = scene.Mapper;
  vtkProperty* property = scene.Actor->GetProperty();
  mapper->SetMode(dice.Below(3));
  mapper->SetSharpness(dice.Pick({ 0.1, 2., 20. }));
  mapper->SetStride(dice.Chance(0.2) ? 1 + dice.Below(5000) : 1);
  mapper->SetRadiusScale(dice.Chance(0.8) ? 1. : dice.Pick({ 0., 1e-3, 3., 1e10, VTK_DOUBLE_MAX }));
  mapper->SetColorByNormalDirection(dice.Chance(0.2));
  property->SetOpacity(dice.Pick({ 1., 1., 1., 1., 0.5, 0.3, 0. }));
  property->SetInterpolation(dice.Below(4)); // flat to physically based
  property->SetAmbient(0.3);
  property->SetDiffuse(dice.Between(0.3, 1.));
  property->SetSpecular(dice.Between(0., 1.));
  property->SetLighting(dice.Chance(0.8));
  property->SetEdgeVisibility(dice.Chance(0.3));
  property->SetEdgeColor(1., 1., 0.);
  property->SetLineWidth(static_cast<float>(dice.Pick({ 0.1, 1., 5., 1000. })));
  property->SetPointSize(static_cast<float>(dice.Pick({ 0.1, 3., 1000. })));
  property->SetBackfaceCulling(dice.Chance(0.1));
  property->SetFrontfaceCulling(dice.Chance(0.1));
  scene.Renderer->SetUseDepthPeeling(dice.Chance(0.3));
  mapper->RemoveAllClippingPlanes();
  for (int i = dice.Chance(0.1) ? dice.Below(7) : 0; i > 0; --i)
  {
    vtkNew<vtkPlane> plane;
    const glm::dvec3 normal = dice.Vector();
    plane->SetNormal(normal.x, normal.y, normal.z);
    mapper->AddClippingPlane(plane);
  }
  const double scale = mapper->GetRadiusScale();
  return mapper->GetMode() != vtkSurfaceSplatMapper::Points && mapper->GetStride() == 1 &&
    scale >= 1. && scale <= 3. && property->GetOpacity() > 0.2 && !property->GetBackfaceCulling() &&
    !property->GetFrontfaceCulling() && mapper->GetNumberOfClippingPlanes() == 0;
}

// Returns whether the sphere lies before the camera.
bool ChooseCamera(SplatScene& scene, Dice& dice)
{
  const double distance = dice.Chance(0.2) ? dice.Within(1e-3, 1.) : dice.Within(1.5, 1000.);
  scene.LookFrom(dice.Vector() + glm::dvec3(0., 0., 1e-3), dice.Chance(0.3), distance,
    std::min(dice.Within(0.05, 20.), 20. * distance));
  return distance > 1.;
}

// Counts the pixels of the sphere that show the background, and those that are black.
void ExpectSphereIsSeen(const SplatScene& scene)
{
  int background = 0;
  int black = 0;
  const int pixels = scene.ForEachPixelOnSphere(1., 0.5,
    [&](int x, int y, glm::dvec3)
    {
      const glm::dvec3 color = scene.ColorAt(x, y);
      background += glm::distance(color, 255. * Background) < 2.;
      black += color == glm::dvec3(0.);
    });
  EXPECT_LE(background, 0.02 * pixels) << "of " << pixels;
  EXPECT_LE(black, 0.02 * pixels) << "of " << pixels;
}
}

// Forty inputs, one after the other in the same mapper, and seven pictures of each.
TEST(SplatRobustness, HundredsOfRandomPictures)
{
  vtkNew<vtkPolyData> nothing;
  SplatScene scene(nothing);
  scene.Renderer->SetBackground(Background.x, Background.y, Background.z);
  int judged = 0;
  for (unsigned seed = 0; seed < 40; ++seed)
  {
    Dice dice(seed);
    vtkSmartPointer<vtkPolyData> particles = SphereAndOddParticles(dice);
    const bool plain = dice.Chance(0.6); // no array cuts or moves splats
    if (!plain)
    {
      AddOddArrays(particles, dice);
    }
    if (dice.Chance(0.5))
    {
      AddOddCells(particles, dice);
    }
    scene.Mapper->SetInputDataObject(particles);
    for (int picture = 0; picture < 7; ++picture)
    {
      SCOPED_TRACE(testing::Message() << "input " << seed << ", picture " << picture);
      ChooseScalars(scene, particles, dice);
      const bool covered = ChooseProperties(scene, dice);
      const bool before = ChooseCamera(scene, dice);
      scene.Render();
      if (plain && covered && before && !scene.Mapper->GetCellColorArrayName())
      {
        ExpectSphereIsSeen(scene);
        ++judged;
      }
    }
  }
  EXPECT_GT(judged, 22);
}

namespace
{
glm::ivec3 MiddleOf(vtkRenderWindow* window)
{
  const int* size = window->GetSize();
  const int x = size[0] / 2;
  const int y = size[1] / 2;
  unsigned char* pixel = window->GetPixelData(x, y, x, y, 0, 0);
  const glm::ivec3 color(pixel[0], pixel[1], pixel[2]);
  delete[] pixel;
  return color;
}

bool IsBlackOrBackground(const glm::ivec3& color)
{
  return color == glm::ivec3(0) || glm::distance(glm::dvec3(color), 255. * Background) < 2.;
}

void ExpectWindowShowsSphere(SplatScene& scene, int width, int height)
{
  for (double opacity : { 1., 0.5 })
  {
    SCOPED_TRACE(testing::Message() << width << " x " << height << ", opacity " << opacity);
    scene.Actor->GetProperty()->SetOpacity(opacity);
    scene.Window->SetSize(width, height);
    scene.Window->Render();
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    EXPECT_FALSE(IsBlackOrBackground(MiddleOf(scene.Window)));
  }
}

void ExpectParticlesAreSeen(int count)
{
  SplatScene scene(FibonacciSphere(count, 1., std::min(1., 5. / std::sqrt(count))));
  scene.Renderer->SetBackground(Background.x, Background.y, Background.z);
  scene.Mapper->SetModeToSplats();
  scene.LookFrom({ 1., 0., 0. }, false);
  scene.Render();
  EXPECT_GT(scene.CountDrawnPixels(), count > 1 ? 15000 : 1000) << count;
}
}

TEST(SplatRobustness, WindowsOfManySizes)
{
  SplatScene scene(FibonacciSphere(SphereCount, 1., SphereRadius));
  scene.Renderer->SetBackground(Background.x, Background.y, Background.z);
  scene.Mapper->SetModeToSplats();
  scene.Render(); // listens to the driver from now on
  const int sizes[][2] = { { 1, 1 }, { 2, 1 }, { 1, 700 }, { 8192, 1 }, { 1, 8192 }, { 1777, 333 },
    { 3, 3 }, { 640, 480 } };
  for (const auto& [width, height] : sizes)
  {
    ExpectWindowShowsSphere(scene, width, height);
  }
}

// Takes some 10 GB where the driver draws in main memory.
TEST(SplatRobustness, DISABLED_TheLargestWindow)
{
  SplatScene scene(FibonacciSphere(SphereCount, 1., SphereRadius));
  scene.Renderer->SetBackground(Background.x, Background.y, Background.z);
  scene.Mapper->SetModeToSplats();
  scene.Render();
  ExpectWindowShowsSphere(scene, 8192, 8192);
}

TEST(SplatRobustness, OneParticleAndManyMore)
{
  for (int count : { 1, 100'000, 1'000'000 })
  {
    ExpectParticlesAreSeen(count);
  }
}

// Takes some 4 GB.
TEST(SplatRobustness, DISABLED_TenMillionParticles)
{
  ExpectParticlesAreSeen(10'000'000);
}

// One actor in window after window: each has a context of its own, and loses it in another way.
TEST(SplatRobustness, ContextsAreLostAndWindowsComeAndGo)
{
  SplatScene first(FibonacciSphere(SphereCount, 1., SphereRadius));
  first.Mapper->SetModeToSplats();
  first.Render();
  const int pixels = first.CountDrawnPixels();
  ASSERT_GT(pixels, 15000);
  vtkNew<vtkPolyData> nothing;
  for (int turn = 0; turn < 12; ++turn)
  {
    SCOPED_TRACE(testing::Message() << "window " << turn);
    SplatScene next(nothing);
    next.Renderer->AddActor(first.Actor);
    next.Render();
    EXPECT_EQ(next.CountDrawnPixels(), pixels);
    if (turn % 4 == 0)
    {
      first.Mapper->ReleaseGraphicsResources(next.Window);
      next.Render();
    }
    else if (turn % 4 == 1)
    {
      next.Window->Finalize(); // the context is gone, and made anew
      next.Render();
    }
    else if (turn % 4 == 2)
    {
      first.Render(); // both windows have the actor
      EXPECT_EQ(first.CountDrawnPixels(), pixels);
      next.Render();
    }
    EXPECT_EQ(next.CountDrawnPixels(), pixels);
  } // the window ends before the mapper
  first.Render();
  EXPECT_EQ(first.CountDrawnPixels(), pixels);
}
