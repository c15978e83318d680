#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace hop
{

/// Search for the spacing s at which a surface takes a given number of particles. On a flat surface the number is
/// proportional to 1/s^2, so each try multiplies s by sqrt(counted / given). Curvature, creases and boundary curves
/// change the exponent a little, so that some tries are needed.
class SpacingSearch
{
public:
  /// First spacing where none is known, in units of the diagonal of the mesh: a flat surface across the mesh then
  /// takes about a thousand particles. Chosen by experiment. A smaller one costs more in the first try; a larger one
  /// shows less of the surface, so that more tries follow.
  static constexpr double FirstSpacingPerDiagonal = 0.02;
  /// Largest number of counts. Chosen by experiment. The search ends at the last spacing then, which may give a
  /// number farther off than Tolerance.
  static constexpr int MostTries = 8;
  /// Relative error of the number at which the search ends: 1%, of the spacing half of that. Smaller: more tries,
  /// and each isolates the whole surface anew.
  static constexpr double Tolerance = 0.01;
  /// Where the number falls by less than to this share of the one before, although the spacing has grown to Growth
  /// times the one before, curvature or corners set it, and no spacing gives the few that are asked for: the search
  /// ends. A flat surface's number falls to 1/Growth^2 = 0.44. Chosen by experiment; a smaller share may end searches
  /// that get on.
  static constexpr double Stagnant = 0.9;
  static constexpr double Growth = 1.5;

  /// \param given number of particles, > 0
  /// \param firstSpacing of the first try, world units, > 0
  /// \param tolerance relative error of the number at which the search ends
  /// \param largest spacing that is tried, world units
  SpacingSearch(std::int64_t given, double firstSpacing, double tolerance = Tolerance,
    double largest = std::numeric_limits<double>::infinity())
    : Given(static_cast<double>(given))
    , Spacing(std::min(firstSpacing, largest))
    , LargestError(tolerance)
    , Largest(largest)
  {
  }

  /// To be tried next or, once the search is over, its result. World units.
  double spacing() const { return this->Spacing; }

  /// Whether spacing() is the result.
  bool isOver() const { return this->Over; }

  /// Chooses the next spacing. Does nothing once the search is over.
  /// \param counted number of particles that the surface takes at spacing(); zero ends the search
  void update(double counted)
  {
    if (this->Over)
    {
      return;
    }
    ++this->Tries;
    const double ratio = counted / this->Given;
    this->Over = this->Tries == MostTries || !(ratio > 0.0) ||
      std::abs(ratio - 1.0) < this->LargestError ||
      (this->HasGrown && ratio > Stagnant * this->Ratio) ||
      (this->Spacing == this->Largest && ratio > 1.0);
    this->HasGrown = std::sqrt(ratio) >= Growth;
    this->Ratio = ratio;
    this->Spacing =
      this->Over ? this->Spacing : std::min(this->Spacing * std::sqrt(ratio), this->Largest);
  }

private:
  double Given;
  double Spacing;
  double LargestError;
  double Largest;
  int Tries = 0;
  bool Over = false;
  /// Whether spacing() is larger than the one before by Growth or more.
  bool HasGrown = false;
  /// Of counted and given number at the spacing before.
  double Ratio = 0.0;
};

/// The spacing at which a surface takes a given number of particles.
/// \param countAt called as countAt(spacing), at most SpacingSearch::MostTries times, last with the spacing that is
///   returned
template <class Count>
double findSpacing(std::int64_t given, double firstSpacing, const Count& countAt,
  double tolerance = SpacingSearch::Tolerance,
  double largest = std::numeric_limits<double>::infinity())
{
  SpacingSearch search(given, firstSpacing, tolerance, largest);
  while (!search.isOver())
  {
    search.update(countAt(search.spacing()));
  }
  return search.spacing();
}

} // namespace hop
