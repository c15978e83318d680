#pragma once

#include "Edges/BoundaryTrace.h"

#include <array>
#include <unordered_map>
#include <vector>

namespace hop
{

/// Distance of a place from the line between two others.
double distanceToSegment(const glm::dvec3& x, const glm::dvec3& a, const glm::dvec3& b);

/// Chords of the boundary curves traced so far, by the face on which they run.
class BoundaryChords
{
public:
  /// A chord passes a point that is nearer to it than this, in units of its own length. More takes another boundary
  /// curve close by for the same one; less than what the curve bends away from its chords traces it twice.
  static constexpr double PassShare = 0.2;
  /// The same beyond the end of a chord at which the curve leaves the face. More takes the tips of two curves for one; less
  /// than what is left of an edge's distance from the surface traces a curve twice.
  static constexpr double PassShareBeyond = 1e-3;

  struct Chord
  {
    /// \param tangent the curve's, of unit length, at `from`, as the surface's end is seen from it (BoundaryTracer::tangent())
    Chord(const BoundaryPoint& from, const BoundaryPoint& to, const WorldVector& tangent);

    std::size_t face = 0; ///< slot
    /// Of the ends, in the world and in the element's reference space.
    std::array<glm::dvec3, 2> positions;
    std::array<glm::dvec3, 2> places;
    /// On two sheets close to each other, and on the two sides of a lens or a strip, curves run in opposite directions.
    WorldVector along;
    /// Of its ends along the trace, world units: from the start, negative against the curve's direction.
    std::array<double, 2> way{};
    /// Number of the trace.
    int trace = -1;
    /// Whether the curve leaves the face at an end: nothing beyond that end is on the chord.
    std::array<bool, 2> isLast{};
  };

  /// A place on a curve, and where its trace is there.
  struct Tip
  {
    const BoundaryPoint& point;
    /// See Chord.
    WorldVector along;
    double way = 0.0;
    int trace = -1;
  };

  void add(const Chord& chord) { this->Chords[chord.face].push_back(chord); }

  /// Whether a chord of the same curve on the same face passes a place, to a fifth of the chord's length; beyond an end at
  /// which the curve leaves the face, to a thousandth.
  bool pass(const Tip& tip) const;

  /// Whether a trace meets a chord of the same curve on the same face. It does not meet what it has just left: where chords
  /// become much shorter at a tip of the curve, they are all near the last long one.
  bool meet(const Tip& tip) const;

  /// Whether a chord on a face crosses the line between two places on that face.
  bool cross(int element, int face, const std::array<glm::dvec3, 2>& ends) const;

private:
  /// How far a trace leaves a chord behind before it may meet it, in units of PassShare of its length: up to a quarter of
  /// a circle away the straight distance is nine tenths of the way.
  static constexpr double LeftBehind = 1.2;

  template <class Test>
  bool anyPasses(const Tip& tip, const Test& test) const;

  /// By the slots of the faces.
  std::unordered_map<std::size_t, std::vector<Chord>> Chords;
};

} // namespace hop
