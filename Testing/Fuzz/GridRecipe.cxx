#include "GridRecipe.h"

#include "Support/Random.h"

#include <vtkCellType.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace hop::testing
{
namespace
{

/// The rare choices, after so many times the plain one: too many odd things at once leave no surface to judge.
std::vector<double> mostly(int count, double plain, const std::vector<double>& rare)
{
  std::vector<double> choices(static_cast<std::size_t>(count), plain);
  choices.insert(choices.end(), rare.begin(), rare.end());
  return choices;
}

std::vector<Ingredient> makeIngredients()
{
  // Powers of ten: units that files of solvers come in, and the ends of what doubles hold.
  const std::vector<double> exponents =
    mostly(30, 0, { -3, 3, -9, 9, -30, 30, -150, 150, -200, 200, -300 });
  return {
    { "cell", VTK_LAGRANGE_HEXAHEDRON,
      { VTK_TETRA, VTK_VOXEL, VTK_HEXAHEDRON, VTK_WEDGE, VTK_PYRAMID, VTK_QUADRATIC_TETRA,
        VTK_QUADRATIC_HEXAHEDRON, VTK_QUADRATIC_WEDGE, VTK_QUADRATIC_PYRAMID,
        VTK_TRIQUADRATIC_HEXAHEDRON, VTK_QUADRATIC_LINEAR_WEDGE, VTK_BIQUADRATIC_QUADRATIC_WEDGE,
        VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON, VTK_TRIQUADRATIC_PYRAMID, VTK_LAGRANGE_TETRAHEDRON,
        VTK_LAGRANGE_HEXAHEDRON, VTK_LAGRANGE_WEDGE, VTK_BEZIER_TETRAHEDRON, VTK_BEZIER_HEXAHEDRON,
        VTK_BEZIER_WEDGE, VTK_LAGRANGE_TETRAHEDRON, VTK_LAGRANGE_HEXAHEDRON, VTK_LAGRANGE_WEDGE,
        VTK_BEZIER_TETRAHEDRON, VTK_BEZIER_HEXAHEDRON, VTK_BEZIER_WEDGE } },
    { "order", 1, { 1, 2, 2, 3, 3, 4, 5, 6, 7, 8, 9, 10 } },
    { "blocks", 1, { 1, 1, 1, 1, 2, 2, 3 } },
    { "length", 0, exponents },
    { "offset", 0, mostly(20, 0, { 1, 1e4, -1e8 }) },
    { "warp", 0, { 0, 0.1, 0.3 } },
    { "scatter", 0, mostly(12, 0, { 0.05, 0.3, 1 }) },
    { "flat", 1, mostly(25, 1, { 0, 1e-12, 1e-3 }) },
    { "field", 0, { 0, 1, 1, 2, 2, 3, 4, 5, 6, 7 } }, // see fieldAt() of RandomGrid.cxx
    { "value", 0, exponents },
    { "shift", 0, mostly(20, 0, { 1, 1e5, -1e12 }) },
    { "number", 0, mostly(4, 0, { 1, 2 }) }, // double, float, int
    { "components", 1, { 1, 1, 1, 3 } },
    // Shares of the range of the values; a second isovalue of -9 stands for none.
    { "isovalue", 0.5, mostly(6, 0.5, { 0.33, 0.33, 0.9, 0.9, 0, 1, 0.999, 1.2 }) },
    { "isovalue2", -9, mostly(12, -9, { 0.5, 0.6, 0.1 }) },
    { "bad", 0, mostly(60, 0, { 1, 2, 3, 4, 5, 6, 7, 8, 9 }) }, // see spoil()
    { "weights", 0, { 0, 0, 1, 1, 2, 3, 4 } },                  // see weightAt()
    { "ghosts", 0, mostly(20, 0, { 0.1, 0.5, 1 }) },            // share of the cells
    { "pieces", 1, mostly(8, 1, { 2, 5 }) },
    // Lengths in units of the longest side.
    { "Spacing", 0.2, mostly(30, 0.2, { 0.5, 0.5, 0.5, 0.5, 0.3, 0.3, 0.3, 0.3, 0.1, 3, 3 }) },
    { "SmallestSpacing", 0, mostly(6, 0, { 0.01, 0.1 }) },
    { "AngularDensity", 0, { 0, 2, 10, 15 } },
    { "Tolerance", 1e-10, mostly(4, 1e-10, { 1e-14, 1e-5, 1e-2 }) },
    { "NumberOfParticles", 0, mostly(20, 0, { 1, 2, 7, 100, 500 }) },
    { "Quality", 1, { 0, 1, 2 } },
    { "Method", 1, mostly(12, 1, { 0 }) },
    { "NodeSpacing", 0, mostly(8, 0, { 1 }) },
    { "Component", 0, mostly(2, 0, { 1, 3 }) },
    { "Quantity", 0, mostly(18, 0, { 1, 2, 3, 4, 5, 6 }) },
    { "Derivatives", 0, mostly(3, 0, { 1 }) },
    { "PassDerivatives", 0, mostly(2, 0, { 1 }) },
    { "OutputType", 0, mostly(2, 0, { 1, 2 }) },
    { "Order", 2, { 2, 3, 4 } },
    { "ParticlesPerWorker", 0, mostly(5, 0, { 20 }) },
    { "WarmStart", 0, { 0, 1 } },
    { "change", 0, mostly(4, 0, { 1, 2, 3, 4, 5 }) }, // see FilterSession::change()
    { "threads", 1, { 1, 2, 3, 4 } },
    // So many at most; 0: all.
    { "cells", 0, { 0 } },
  };
}

bool isOfAnyOrder(int cell)
{
  return cell >= VTK_LAGRANGE_TETRAHEDRON;
}

} // namespace

const std::vector<Ingredient>& ingredients()
{
  static const std::vector<Ingredient> table = makeIngredients();
  return table;
}

GridRecipe::GridRecipe(std::uint64_t seed)
  : Seed(seed)
{
  Random dice(seed);
  dice.uniform(); // streams of seeds next to each other are far apart after one step
  for (const Ingredient& one : ingredients())
  {
    const auto pick = static_cast<std::size_t>(dice.uniform() * one.choices.size());
    this->Values[one.name] = one.choices[pick];
  }
  this->tame();
}

GridRecipe::GridRecipe(const std::string& line)
{
  for (const Ingredient& one : ingredients())
  {
    this->Values[one.name] = one.plain;
  }
  std::istringstream words(line);
  for (std::string word; words >> word;)
  {
    const std::size_t equals = std::min(word.find('='), word.size());
    const std::string name = word.substr(0, equals);
    const std::string value = word.substr(std::min(equals + 1, word.size()));
    if (name == "seed")
    {
      this->Seed = std::stoull(value);
    }
    else if (this->Values.count(name))
    {
      this->Values[name] = std::stod(value);
    }
    else
    {
      throw std::invalid_argument("no ingredient is called " + name);
    }
  }
}

/// Leaves out what takes long by its nature: many cells of a high degree, isolation of noise of a high degree
/// and many cells that are flat, derived or of noise (Documentation/reliability.md), and many particles by Classic.
void GridRecipe::tame()
{
  double& order = this->Values["order"];
  order = isOfAnyOrder(this->count("cell")) ? order : 1;
  const int field = this->count("field");
  const bool isNoise = field == 3 || field == 4 || field == 7 || (*this)["scatter"] > 0.3;
  const int quantity = this->count("Quantity");
  double& components = this->Values["components"];
  components = quantity >= 2 && quantity <= 5 ? 3.0 : components; // they are of vectors
  const bool isProduct = components > 1.0 || quantity > 0;
  order = std::min(order, isNoise ? (isProduct ? 2.0 : 4.0) : isProduct ? 4.0 : 10.0);
  double& blocks = this->Values["blocks"];
  const bool isSlow = quantity > 0 || (*this)["flat"] < 1.0 || (isNoise && order > 2.0);
  blocks = std::min(blocks, isSlow ? 1.0 : order < 3 ? 3.0 : order < 5 ? 2.0 : 1.0);
  if (this->count("Method") == 0)
  {
    this->Values["Spacing"] = std::max((*this)["Spacing"], 0.5);
    this->Values["AngularDensity"] = 0;
    this->Values["NumberOfParticles"] = 0;
  }
}

void GridRecipe::keepSmall()
{
  const auto bound = [this](const char* name, double least, double most)
  { this->Values[name] = std::clamp((*this)[name], least, most); };
  const bool isDerived = this->count("Quantity") > 0;
  bound("order", 1.0, isDerived ? 2.0 : 4.0);
  bound("blocks", 1.0, (*this)["order"] < 2.0 && !isDerived ? 2.0 : 1.0);
  bound("Spacing", 0.5, 3.0);
  bound("AngularDensity", 0.0, 2.0);
  bound("NumberOfParticles", 0.0, 7.0);
}

void GridRecipe::keepTiny()
{
  this->keepSmall();
  this->Values["cells"] = 1.0 + static_cast<double>(this->Seed % 4);
  this->Values["Spacing"] = 3.0;
  this->Values["threads"] = std::min((*this)["threads"], 2.0);
  if (this->count("Method") == 0)
  {
    this->Values["Quality"] = 0.0; // Classic takes a second at a higher one
  }
}

std::string GridRecipe::text() const
{
  std::ostringstream line;
  line << "seed=" << this->Seed;
  for (const Ingredient& one : ingredients())
  {
    if ((*this)[one.name] != one.plain)
    {
      line << " " << one.name << "=" << (*this)[one.name];
    }
  }
  return line.str();
}

std::vector<GridRecipe> GridRecipe::simpler() const
{
  std::vector<GridRecipe> all;
  const auto add = [&](const std::string& name, double value)
  {
    all.push_back(*this);
    all.back().Values[name] = value;
  };
  for (const Ingredient& one : ingredients())
  {
    if ((*this)[one.name] != one.plain)
    {
      add(one.name, one.plain);
    }
  }
  for (const char* number : { "order", "blocks" })
  {
    if ((*this)[number] > 2)
    {
      add(number, (*this)[number] - 1);
    }
  }
  return all;
}

} // namespace hop::testing
