// One actor with disks in one window, and its pixels as points in space.
#pragma once

#include "Particles/SplatParticles.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <glm/glm.hpp>

#include <functional>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

class vtkActor;
class vtkDataArray;
class vtkPolyData;
class vtkRenderWindow;
class vtkRenderer;
class vtkSurfaceSplatMapper;

// Particles spread evenly (Fibonacci) over a sphere, with normals outward; the name of the radius
// array is 'Radius'. Without vertex cells.
vtkSmartPointer<vtkPolyData> FibonacciSphere(
  int count, double sphereRadius, double diskRadius, glm::dvec3 centre = glm::dvec3(0.));

// Particles at given places with given normals and one radius. Without vertex cells.
vtkSmartPointer<vtkPolyData> Disks(
  const std::vector<glm::dvec3>& positions, const std::vector<glm::dvec3>& normals, double radius);

// Adds one vertex cell a point: `order[cell]` is the point of the cell, or the cell's number.
void AddVertexCells(vtkPolyData* particles, const std::vector<vtkIdType>& order = {});

// Adds the shape operators of a sphere around the origin.
void AddShapeOfSphere(vtkPolyData* particles, double radius);

// What the mapper reads of particles whose radii are the array 'Radius'.
hop::SplatParticles ReadSplats(vtkPolyData* particles);

// Where a scene is looked at from.
struct SceneView
{
  glm::dvec3 Direction;
  bool Parallel;

  friend std::ostream& operator<<(std::ostream& os, const SceneView& view)
  {
    return os << (view.Parallel ? "parallel" : "perspective") << " from " << view.Direction.x << " "
              << view.Direction.y << " " << view.Direction.z;
  }
};

class SplatScene
{
public:
  static constexpr int Size = 256; // pixels, both ways

  // The mode is Disks until a test chooses another one. All positions that a scene gives or takes are relative to
  // `centre`.
  explicit SplatScene(vtkPolyData* particles, glm::dvec3 centre = glm::dvec3(0.));
  ~SplatScene();

  // Looks at the centre. `halfHeight` is what half the picture shows there. A light shines from the
  // camera until the renderer is given others.
  void LookFrom(glm::dvec3 direction, bool parallel, double distance = 4., double halfHeight = 1.3);

  // Unlit, so that colours come out as they are.
  void ShowPlainColors();

  // The normals that VTK's lighting uses instead of colours: read them with NormalAt().
  void ShowNormals();

  // Draws and reads the picture; fails the test on an OpenGL error.
  void Render();

  // After Render(): what is seen at a pixel, or nothing where it is background.
  std::optional<glm::dvec3> PositionAt(int x, int y) const;
  glm::dvec3 ColorAt(int x, int y) const;  // 0 to 255
  glm::dvec3 NormalAt(int x, int y) const; // unit, of the side that is seen
  int CountDrawnPixels() const;

  // Direction from a point to the eye, and where the ray of a pixel enters a sphere around the centre.
  glm::dvec3 ToEye(glm::dvec3 position) const;
  std::optional<glm::dvec3> HitSphere(double x, double y, double radius) const;

  // Calls for every pixel whose ray hits the sphere at more than `minimalCosine` to its surface:
  // away from the outline. Returns how many there were.
  int ForEachPixelOnSphere(double radius, double minimalCosine,
    const std::function<void(int x, int y, glm::dvec3 onSphere)>& check) const;

  // Calls for every pixel that is not background. Returns how many there were.
  int ForEachDrawnPixel(const std::function<void(int x, int y, glm::dvec3 position)>& check) const;

  vtkNew<vtkSurfaceSplatMapper> Mapper;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkRenderer> Renderer;
  vtkSmartPointer<vtkRenderWindow> Window;

private:
  struct Ray
  {
    glm::dvec3 Origin;
    glm::dvec3 Direction; // length 1 along the axis of the camera
  };
  Ray RayOf(double x, double y) const;

  glm::dvec3 Centre;
  glm::dvec3 Eye = { 0., 0., 4. }; // relative to the centre
  glm::dvec3 Right, Up, Back;      // unit vectors of the camera
  bool Parallel = false;
  double Distance = 4.;
  double HalfHeight = 1.3;
  double Near = 1.;
  double Far = 7.;
  std::vector<float> Depth;
  std::vector<unsigned char> Color;
};

// Number of particles on the spheres that tests draw, and where the spheres are looked at from.
constexpr int Count = 5000;
inline const SceneView SphereViews[] = { { { 0., 0., 1. }, false }, { { 0., 0., 1. }, true },
  { { -1., 2., 0.5 }, false }, { { 0.3, -1., -2. }, true } };

// Pixels that see a sphere at more than this cosine are away from its outline.
constexpr double Inside = 0.3;

// Fails the test unless something is seen at every pixel of the unit sphere away from its outline, and
// there are enough of these. Calls with what is seen, and with the sphere's place.
void ForEachPlaceOnSphere(const SplatScene& scene,
  const std::function<void(glm::dvec3 seen, glm::dvec3 onSphere)>& check, int atLeast = 15000);

// Cuts the unit sphere by a clipping plane. What lies before it by more than `margin` is to be seen, at
// most `tolerance` from the sphere, what lies behind it by as much is not. `centre` is the scene's.
void ExpectClippingPlaneCuts(
  SplatScene& scene, const SceneView& view, glm::dvec3 centre, double margin, double tolerance);

// One disk, seen from both sides, covers so many pixels, and none if backfaces are culled and its
// normal points away.
void ExpectBothSidesUnlessCulled(SplatScene& scene, int atLeast, int atMost);

// Stretches and moves the unit sphere: what is seen has these distances from its middle before that.
void ExpectStretchedSphere(
  SplatScene& scene, glm::dvec3 scale, double atLeast, double atMost, int pixels);

// Counts the warnings of an object and keeps the last one's text; errors count as well.
class WarningCounter
{
public:
  explicit WarningCounter(vtkSurfaceSplatMapper* mapper);
  int Count = 0;
  std::string Text;
};
