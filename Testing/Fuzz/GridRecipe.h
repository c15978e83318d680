#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace hop::testing
{

/// One choice that a recipe makes: what it may be, each of the same chance, and what is simplest.
struct Ingredient
{
  const char* name;
  double plain;
  std::vector<double> choices;
};

/// All choices, in the order in which dice are thrown. New ones go to the end, so that seeds stay what they are.
const std::vector<Ingredient>& ingredients();

/// A random grid and what is asked of the filter, as numbers that have names; the same recipe makes the same grid.
class GridRecipe
{
public:
  /// All choices follow from the seed.
  explicit GridRecipe(std::uint64_t seed);
  /// A line "seed=7 order=3 ...", as text() writes it; choices that are not in it are plain.
  /// \throw std::invalid_argument for a name that no ingredient has
  explicit GridRecipe(const std::string& line);

  double operator[](const std::string& name) const { return this->Values.at(name); }
  int count(const std::string& name) const { return static_cast<int>((*this)[name]); }
  std::uint64_t seed() const { return this->Seed; }

  /// Bounds the degree, the cells and the particles, so that hundreds of recipes run in a second.
  void keepSmall();
  /// Bounds them further: one to four cells, and as few particles as there can be, so that a sanitizer sees ten thousands of
  /// recipes in an hour.
  void keepTiny();

  /// The seed and what is not plain.
  std::string text() const;
  /// Recipes with one choice made plain, or with a lower degree or fewer blocks.
  std::vector<GridRecipe> simpler() const;

private:
  void tame();

  /// Of points and values.
  std::uint64_t Seed = 0;
  std::map<std::string, double> Values;
};

} // namespace hop::testing
