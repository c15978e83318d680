// Where colours end that differ from cell to cell, and the lines that are drawn there, held against rays through the
// true polynomials.
#include "SurfaceCases.h"
#include "SurfacePicture.h"

#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkLookupTable.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkSurfaceSplatMapper.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

using hop::testing::PictureCamera;

namespace
{
constexpr int Size = 200;           // pixels
constexpr double Tolerance = 0.1;   // spacings, of the place of a border
constexpr double LeastCosine = 0.4; // between normal and view ray, of the pixels that are looked at

// A colour for each cell, far from those of the cells beside it.
glm::dvec3 ColorOf(std::int64_t cell)
{
  const auto channel = [cell](int factor) { return std::floor((cell * factor) % 251) / 255.; };
  return { channel(67), channel(101), channel(151) };
}

// Particles that know no borders: an array under its own name counts, not what the hidden one holds.
vtkSmartPointer<vtkPolyData> WithoutBorders(vtkPolyData* particles)
{
  auto without = vtkSmartPointer<vtkPolyData>::New();
  without->ShallowCopy(particles);
  vtkNew<vtkDoubleArray> borders;
  borders->SetName("Cell_Borders");
  borders->SetNumberOfComponents(16);
  borders->SetNumberOfTuples(particles->GetNumberOfPoints());
  borders->Fill(0.);
  without->GetPointData()->AddArray(borders);
  return without;
}

// Particles with the point array 'Color', the colours of their cells.
vtkSmartPointer<vtkPolyData> ColoredByCell(const SurfaceCase& surface)
{
  auto particles = vtkSmartPointer<vtkPolyData>::New();
  particles->ShallowCopy(surface.Particles);
  auto* cells = vtkIdTypeArray::SafeDownCast(particles->GetPointData()->GetArray("Cell_Id"));
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("Color");
  colors->SetNumberOfComponents(3);
  for (vtkIdType i = 0; cells && i < cells->GetNumberOfTuples(); ++i)
  {
    const glm::dvec3 color = 255. * ColorOf(cells->GetValue(i));
    colors->InsertNextTuple3(color.x, color.y, color.z);
  }
  particles->GetPointData()->AddArray(colors);
  return particles;
}

vtkNew<vtkSurfaceSplatMapper> MapperOf(vtkPolyData* particles, const char* array)
{
  vtkNew<vtkSurfaceSplatMapper> mapper;
  mapper->SetInputData(particles);
  mapper->SetScalarModeToUsePointFieldData();
  mapper->SelectColorArray(array);
  mapper->SetScalarVisibility(array != nullptr);
  return mapper;
}

struct BorderFigures
{
  int Pixels = 0;     // looked at
  int NearBorder = 0; // less than a spacing from a border, but farther than allowed, among them
  int Wrong = 0; // with the colour of another cell, or a mix, farther from a border than allowed
};

// How many pixels do not have the colour of their cell.
BorderFigures CompareCells(const std::vector<glm::dvec3>& drawn, const SurfacePicture& reference,
  const PictureCamera& camera, double spacing)
{
  BorderFigures figures;
  for (int i = 0; i < Size * Size; ++i)
  {
    const auto& seen = reference.Seen[i];
    const auto ray = camera.ray(i % Size + 0.5, i / Size + 0.5);
    const double cosine =
      seen.covered() ? -glm::dot(glm::normalize(ray.direction), seen.normal) : 0.;
    if (cosine < LeastCosine)
    {
      continue;
    }
    // A border that is one pixel off may be anywhere in this one.
    const double pixel =
      camera.pixel() * (camera.parallel ? 1. : seen.depth / camera.distance) / cosine;
    const bool far = seen.toBorder > Tolerance * spacing + pixel;
    const glm::dvec3 error = glm::abs(drawn[i] - ColorOf(seen.cell));
    ++figures.Pixels;
    figures.NearBorder += far && seen.toBorder < spacing;
    figures.Wrong += far && std::max({ error.x, error.y, error.z }) > 3. / 255.;
  }
  return figures;
}

void PrintTo(const BorderFigures& figures, std::ostream* os)
{
  *os << figures.Pixels << " pixels, " << figures.NearBorder << " near borders, " << figures.Wrong
      << " wrong";
}

struct FileCase
{
  std::string Name; // as MakeSurfaceCase() takes it
  // Share of the longest side; some pixels wide, so that a tenth of it is not lost in one pixel.
  double Spacing;
  double Zoom;                   // of the camera that sees all of the surface
  std::vector<bool> Projections; // whether they are parallel

  SurfaceCase Make() const { return MakeSurfaceCase(HOP_DATA "/" + this->Name, this->Spacing); }
};

void PrintTo(const FileCase& file, std::ostream* os)
{
  *os << file.Name;
}

// Curved hexahedra with hanging nodes, tetrahedra, wedges.
const FileCase Hexahedra = { "mfem_amr_hanging_hex_p3.vtu:u:0", 0.03, 1., { false, true } };
const FileCase Tetrahedra = { "dolfinx_tet_p3.vtu:u:0.5", 0.02, 3., { true } };
const FileCase Wedges = { "mfem_torus_wedge_p4.vtu:f:0.3", 0.03, 2., { false, true } };

// The surface of a file, made once for all tests.
const SurfaceCase& CaseOf(const FileCase& file)
{
  static std::map<std::string, SurfaceCase> cases;
  const auto found = cases.find(file.Name);
  return found != cases.end() ? found->second : cases.emplace(file.Name, file.Make()).first->second;
}

// A camera, and what rays see from it.
struct CastView
{
  PictureCamera Camera;
  SurfacePicture Reference;
};

// The view of a file, cast once for all tests.
const CastView& ViewOf(const FileCase& file, bool parallel)
{
  static std::map<std::pair<std::string, bool>, CastView> views;
  CastView& view = views[{ file.Name, parallel }];
  if (view.Reference.Seen.empty())
  {
    view.Camera = CamerasAround(CaseOf(file), parallel, Size)[2];
    view.Camera.halfHeight /=
      file.Zoom * (parallel ? 1. : 1.25); // nearer, the near plane would cut
    view.Reference = CastSurface(CaseOf(file), view.Camera);
  }
  return view;
}

class CellBordersOf : public testing::TestWithParam<FileCase>
{
};
}

TEST_P(CellBordersOf, AreWhereColorsEnd)
{
  const SurfaceCase& surface = CaseOf(GetParam());
  vtkSmartPointer<vtkPolyData> particles = ColoredByCell(surface);
  for (bool parallel : GetParam().Projections)
  {
    const auto& [camera, reference] = ViewOf(GetParam(), parallel);
    const auto mapper = MapperOf(particles, "Color");
    const auto figures =
      CompareCells(DrawColors(mapper, camera), reference, camera, surface.Spacing);
    EXPECT_GT(figures.NearBorder, 500) << testing::PrintToString(figures);
    EXPECT_LT(figures.Wrong, 0.003 * figures.Pixels) << testing::PrintToString(figures);

    // Particles that know no borders give their colours away.
    mapper->SetInputData(WithoutBorders(particles));
    EXPECT_GT(CompareCells(DrawColors(mapper, camera), reference, camera, surface.Spacing).Wrong,
      5 * figures.Wrong + 100);
  }
}

INSTANTIATE_TEST_SUITE_P(
  CellBorders, CellBordersOf, testing::Values(Hexahedra, Tetrahedra, Wedges));

// A categorical table does not mix colours: the strongest particle of the cell gives its own.
TEST(CellBorders, CategoriesEndThere)
{
  const SurfaceCase& surface = CaseOf(Hexahedra);
  const auto& [camera, reference] = ViewOf(Hexahedra, true);
  vtkNew<vtkLookupTable> table;
  table->IndexedLookupOn();
  table->SetNumberOfTableValues(400);
  for (int cell = 0; cell < 400; ++cell)
  {
    const glm::dvec3 color = ColorOf(cell);
    table->SetAnnotation(cell, "");
    table->SetTableValue(cell, color.x, color.y, color.z);
  }
  const auto mapper = MapperOf(surface.Particles, "Cell_Id");
  mapper->SetLookupTable(table);
  const auto figures = CompareCells(DrawColors(mapper, camera), reference, camera, surface.Spacing);
  EXPECT_GT(figures.NearBorder, 500);
  EXPECT_LT(figures.Wrong, 0.003 * figures.Pixels) << testing::PrintToString(figures);
}

namespace
{
// The picture by a value a particle, with and without borders: the largest difference of a channel.
double LargestDifference(
  const SurfaceCase& surface, const std::function<double(vtkIdType)>& valueOf)
{
  vtkNew<vtkPolyData> particles;
  particles->ShallowCopy(surface.Particles);
  vtkNew<vtkDoubleArray> values;
  values->SetName("Values");
  for (vtkIdType i = 0; i < particles->GetNumberOfPoints(); ++i)
  {
    values->InsertNextValue(valueOf(i));
  }
  particles->GetPointData()->AddArray(values);
  const PictureCamera camera = CamerasAround(surface, false, Size)[2];
  const auto mapper = MapperOf(particles, "Values");
  mapper->SetScalarRange(values->GetRange());
  const std::vector<glm::dvec3> with = DrawColors(mapper, camera);
  mapper->SetInputData(WithoutBorders(particles));
  const std::vector<glm::dvec3> plain = DrawColors(mapper, camera);
  double largest = 0.;
  for (std::size_t i = 0; i < with.size(); ++i)
  {
    const glm::dvec3 difference = glm::abs(with[i] - plain[i]);
    largest = std::max({ largest, difference.x, difference.y, difference.z });
  }
  return largest;
}
}

TEST(CellBorders, ChangeNothingWhereValuesAgree)
{
  const SurfaceCase& surface = CaseOf(Hexahedra);
  const auto differenceBy = [&](const std::function<double(const double*)>& field)
  {
    return LargestDifference(
      surface, [&](vtkIdType i) { return field(surface.Particles->GetPoint(i)); });
  };
  EXPECT_EQ(differenceBy([](const double*) { return 1.; }), 0.);
  EXPECT_EQ(differenceBy([](const double* x) { return x[0] - 2. * x[1]; }), 0.);
  EXPECT_EQ(differenceBy([](const double* x) { return std::sin(5. * x[0]) * x[2]; }), 0.);
  vtkDataArray* cells = surface.Particles->GetPointData()->GetArray("Cell_Id");
  EXPECT_GT(LargestDifference(
              surface, [&](vtkIdType i) { return static_cast<int>(cells->GetTuple1(i)) % 2; }),
    0.1);
}

// Values that jump keep their slope up to the border.
TEST(CellBorders, SlopesGoOnToThem)
{
  const SurfaceCase& surface = CaseOf(Hexahedra);
  vtkSmartPointer<vtkPolyData> particles = ColoredByCell(surface);
  auto* cells = vtkIdTypeArray::SafeDownCast(particles->GetPointData()->GetArray("Cell_Id"));
  const auto valueOf = [](std::int64_t cell, double x) { return 0.3 * x + 0.4 * (cell % 2); };
  vtkNew<vtkDoubleArray> values;
  values->SetName("Values");
  for (vtkIdType i = 0; i < particles->GetNumberOfPoints(); ++i)
  {
    values->InsertNextValue(valueOf(cells->GetValue(i), particles->GetPoint(i)[0]));
  }
  particles->GetPointData()->AddArray(values);
  const auto& [camera, reference] = ViewOf(Hexahedra, true);
  const auto mapper = MapperOf(particles, "Values");
  vtkNew<vtkLookupTable> gray;
  gray->SetNumberOfTableValues(256);
  for (int i = 0; i < 256; ++i)
  {
    gray->SetTableValue(i, i / 255., i / 255., i / 255.);
  }
  mapper->SetLookupTable(gray);
  mapper->SetScalarRange(-0.5, 1.);
  const std::vector<glm::dvec3> drawn = DrawColors(mapper, camera);
  int near = 0;
  int wrong = 0;
  for (int i = 0; i < Size * Size; ++i)
  {
    const auto& seen = reference.Seen[i];
    const auto ray = camera.ray(i % Size + 0.5, i / Size + 0.5);
    const double cosine = seen.covered() ? -glm::dot(ray.direction, seen.normal) : 0.;
    const double pixel = camera.pixel() / std::max(cosine, LeastCosine);
    if (cosine > LeastCosine && seen.toBorder > Tolerance * surface.Spacing + pixel)
    {
      const double x = (ray.origin + seen.depth * ray.direction).x;
      const double wanted = (valueOf(seen.cell, x) + 0.5) / 1.5;
      near += seen.toBorder < surface.Spacing;
      // One step of the table, and half of one by rounding.
      wrong += std::abs(drawn[i].x - wanted) > 1.5 / 255.;
    }
  }
  EXPECT_GT(near, 1000);
  EXPECT_LT(wrong, 0.02 * near);
}

namespace
{
struct EdgeFigures
{
  int Lines = 0; // pixels that a line covers for certain
  int Light = 0; // of them that are not dark
  int Off = 0;   // pixels that no line touches
  int Dark = 0;  // of them that are not light
  double Ink = 0.,
         Wanted = 0.; // sums of darkness over all pixels: drawn, and of lines in the right places
};

void PrintTo(const EdgeFigures& figures, std::ostream* os)
{
  *os << figures.Light << " of " << figures.Lines << " on lines are light, " << figures.Dark
      << " of " << figures.Off << " off lines are dark, ink " << figures.Ink << " of "
      << figures.Wanted;
}

EdgeFigures LinesOf(const SurfaceCase& surface, const CastView& view, double width)
{
  const auto& [camera, reference] = view;
  const auto mapper = MapperOf(surface.Particles, nullptr);
  const std::vector<glm::dvec3> drawn = DrawColors(mapper, camera,
    [&](vtkProperty* property)
    {
      property->EdgeVisibilityOn();
      property->SetEdgeColor(0., 0., 0.);
      property->SetLineWidth(static_cast<float>(width));
    });
  EdgeFigures figures;
  for (int i = 0; i < Size * Size; ++i)
  {
    const auto& seen = reference.Seen[i];
    const auto ray = camera.ray(i % Size + 0.5, i / Size + 0.5);
    const double cosine =
      seen.covered() ? -glm::dot(glm::normalize(ray.direction), seen.normal) : 0.;
    const double pixel = camera.pixel() * (camera.parallel ? 1. : seen.depth / camera.distance);
    const double error = Tolerance * surface.Spacing / pixel;
    const double pixels = seen.toBorder / pixel; // not foreshortened; less by the cosine at most
    if (cosine > 0.7)
    {
      const bool onLine = pixels < 0.5 * width - 0.5 - error;
      const bool offLine = cosine * pixels > 0.5 * width + 0.5 + error;
      figures.Lines += onLine;
      figures.Light += onLine && drawn[i].x > 0.3;
      figures.Off += offLine;
      figures.Dark += offLine && drawn[i].x < 0.7;
    }
    if (cosine > 0.95)
    {
      figures.Ink += 1. - drawn[i].x;
      figures.Wanted += std::clamp(0.5 * width + 0.5 - pixels, 0., 1.);
    }
  }
  return figures;
}
}

// Lines lie on the borders, and have the same width in pixels however near the eye is.
TEST_P(CellBordersOf, AreWhereEdgesAreDrawn)
{
  for (bool parallel : GetParam().Projections)
  {
    const EdgeFigures figures = LinesOf(CaseOf(GetParam()), ViewOf(GetParam(), parallel), 6.);
    EXPECT_GT(figures.Lines, 150) << testing::PrintToString(figures);
    EXPECT_LT(figures.Light, 0.03 * figures.Lines) << testing::PrintToString(figures);
    EXPECT_LT(figures.Dark, 0.005 * figures.Off) << testing::PrintToString(figures);
    EXPECT_NEAR(figures.Ink / figures.Wanted, 1., 0.08) << testing::PrintToString(figures);
  }
}
