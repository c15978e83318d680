#include "Edges/BoundaryChords.h"

#include <gtest/gtest.h>

namespace hop::testing
{
namespace
{

/// On a face of an element whose map is the identity.
BoundaryPoint pointAt(const glm::dvec3& u)
{
  BoundaryPoint point;
  point.face = 4;
  point.at.location = { 7, { u } };
  point.at.point.map.position = { u };
  return point;
}

const WorldVector alongX{ glm::dvec3(1.0, 0.0, 0.0) };
const WorldVector backAlongX{ glm::dvec3(-1.0, 0.0, 0.0) };

/// A chord along the first axis.
BoundaryChords::Chord unitChord()
{
  return { pointAt({ 0.0, 0.0, 0.0 }), pointAt({ 1.0, 0.0, 0.0 }), alongX };
}

TEST(BoundaryChords, CrossLinesOnTheirFaceOnly)
{
  BoundaryChords chords;
  chords.add({ pointAt({ 0.2, 0.2, 0.0 }), pointAt({ 0.6, 0.6, 0.0 }), alongX });
  const auto crosses = [&](const glm::dvec3& a, const glm::dvec3& b) {
    return chords.cross(7, 4, { a, b });
  };
  EXPECT_TRUE(crosses({ 0.0, 0.5, 0.0 }, { 1.0, 0.5, 0.0 }));
  EXPECT_TRUE(crosses({ 0.2, 0.0, 0.0 }, { 0.2, 0.4, 0.0 })) << "through its end";
  EXPECT_FALSE(crosses({ 0.0, 0.7, 0.0 }, { 1.0, 0.7, 0.0 })) << "beyond its end";
  EXPECT_FALSE(crosses({ 0.0, 0.5, 0.0 }, { 0.4, 0.5, 0.0 })) << "too short";
  EXPECT_FALSE(crosses({ 0.3, 0.2, 0.0 }, { 0.7, 0.6, 0.0 })) << "parallel";
  EXPECT_FALSE(chords.cross(7, 3, { glm::dvec3(0.0, 0.5, 0.0), glm::dvec3(1.0, 0.5, 0.0) }));
  EXPECT_FALSE(chords.cross(6, 4, { glm::dvec3(0.0, 0.5, 0.0), glm::dvec3(1.0, 0.5, 0.0) }));
}

TEST(BoundaryChords, MeetTracesThatComeBackAndNotThoseThatLeave)
{
  // A long chord whose trace goes on by short ones, as around a tip.
  BoundaryChords::Chord chord = unitChord();
  chord.way = { 0.0, 1.0 };
  chord.trace = 3;
  BoundaryChords chords;
  chords.add(chord);
  const BoundaryPoint near = pointAt({ 1.1, 0.05, 0.0 });
  EXPECT_TRUE(chords.pass({ near, alongX }));
  EXPECT_FALSE(chords.meet({ near, alongX, 1.12, 3 })) << "it has just left the chord";
  EXPECT_TRUE(chords.meet({ near, alongX, 5.0, 3 })) << "it has come back";
  EXPECT_TRUE(chords.meet({ near, alongX, 1.12, 4 })) << "another trace";
  EXPECT_FALSE(chords.meet({ pointAt({ 1.3, 0.0, 0.0 }), alongX, 5.0, 3 })) << "too far off";
  const BoundaryPoint behind = pointAt({ -0.1, 0.0, 0.0 });
  EXPECT_FALSE(chords.meet({ behind, alongX, -0.1, 3 })) << "the other way from the start";
  EXPECT_TRUE(chords.meet({ behind, alongX, 4.0, 3 })) << "a closed curve";
}

TEST(BoundaryChords, DoNotMeetTheOtherSideOfALens)
{
  BoundaryChords chords;
  chords.add(unitChord());
  const BoundaryPoint beside = pointAt({ 0.5, 0.1, 0.0 });
  EXPECT_TRUE(chords.pass({ beside, alongX }));
  EXPECT_TRUE(chords.meet({ beside, alongX, 5.0, 3 }));
  EXPECT_FALSE(chords.pass({ beside, backAlongX }));
  EXPECT_FALSE(chords.meet({ beside, backAlongX, 5.0, 3 }));
  // Where the surface lies in the face its curve has no direction.
  EXPECT_TRUE(chords.pass({ beside, {} }));
}

TEST(BoundaryChords, DoNotMeetWhatIsBeyondTheEdgeAtWhichTheyEnd)
{
  BoundaryChords::Chord chord = unitChord();
  chord.isLast = { false, true };
  BoundaryChords chords;
  chords.add(chord);
  EXPECT_TRUE(chords.pass({ pointAt({ -0.1, 0.0, 0.0 }), alongX }));
  EXPECT_TRUE(chords.pass({ pointAt({ 0.99, 0.05, 0.0 }), alongX }));
  EXPECT_TRUE(chords.pass({ pointAt({ 1.0, 0.0, 0.0 }), alongX }));
  EXPECT_FALSE(chords.pass({ pointAt({ 1.01, 0.0, 0.0 }), alongX })) << "the tip of another curve";
}

} // namespace
} // namespace hop::testing
