#include "Mesh/EdgeChains.h"

#include "FlatSheet.h"

#include <gtest/gtest.h>

namespace hop::testing
{
namespace
{

using Edges = std::vector<std::array<int, 2>>;

Edges closed(const Buffer<Particle>& particles, Edges edges)
{
  Distribution distribution;
  distribution.particles = particles;
  closeChains(distribution, edges);
  return edges;
}

TEST(EdgeChains, ThatAreClosedStayAsTheyAre)
{
  const Edges ring{ { 0, 1 }, { 1, 2 }, { 2, 0 } };
  EXPECT_EQ(closed(particlesAt({ { 0, 0 }, { 1, 0 }, { 0, 1 } }), ring), ring);
  EXPECT_TRUE(closed({}, {}).empty());
}

TEST(EdgeChains, AreJoinedAcrossALostPlace)
{
  const auto square = particlesAt({ { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } });
  EXPECT_EQ(closed(square, { { 0, 1 }, { 1, 2 }, { 2, 3 } }),
    (Edges{ { 0, 1 }, { 1, 2 }, { 2, 3 }, { 3, 0 } }));
}

TEST(EdgeChains, AreJoinedAtBothTipsOfASlit)
{
  // The lower side of the slit has the surface below it, so that it runs against x.
  const auto slit =
    particlesAt({ { 0, 0 }, { 1, 0 }, { 2, 0 }, { 0, 0.4 }, { 1, 0.4 }, { 2, 0.4 } });
  EXPECT_EQ(closed(slit, { { 3, 4 }, { 4, 5 }, { 2, 1 }, { 1, 0 } }),
    (Edges{ { 0, 3 }, { 1, 0 }, { 2, 1 }, { 3, 4 }, { 4, 5 }, { 5, 2 } }));
}

TEST(EdgeChains, GoBackAlongTheLongerSideOfASlit)
{
  const auto slit =
    particlesAt({ { 0, 0 }, { 1, 0 }, { 0, 0.4 }, { 1, 0.4 }, { 2, 0.4 }, { 3, 0.4 }, { 4, 0.4 } });
  EXPECT_EQ(closed(slit, { { 2, 3 }, { 3, 4 }, { 4, 5 }, { 5, 6 }, { 1, 0 } }),
    (Edges{ { 0, 2 }, { 1, 0 }, { 2, 3 }, { 3, 1 }, { 3, 4 }, { 4, 3 }, { 4, 5 }, { 5, 4 },
      { 5, 6 }, { 6, 5 } }));
}

TEST(EdgeChains, GoBackAlongThemselvesWhereNoOtherIsNear)
{
  auto particles = particlesAt({ { 0, 0 }, { 1, 0 }, { 2, 0 }, { 3, 0 }, { 4, 0 } });
  const Edges chain{ { 0, 1 }, { 1, 2 }, { 2, 3 }, { 3, 4 } };
  const Edges both{ { 0, 1 }, { 1, 0 }, { 1, 2 }, { 2, 1 }, { 2, 3 }, { 3, 2 }, { 3, 4 },
    { 4, 3 } };
  EXPECT_EQ(closed(particles, chain), both);
  // A chain of another sheet, which looks the other way.
  for (int x = 4; x >= 0; --x)
  {
    particles.push_back(particles[x]);
    particles[particles.size() - 1].normal = { { 0.0, 0.0, -1.0 } };
  }
  EXPECT_EQ(closed(particles, chain), both);
}

TEST(EdgeChains, ThatRunIntoARingEndThere)
{
  const auto particles = particlesAt({ { 0, 0 }, { 1, 0 }, { 2, 0 }, { 3, 0 }, { 2.5, 1 } });
  EXPECT_EQ(closed(particles, { { 0, 1 }, { 1, 2 }, { 2, 3 }, { 3, 4 }, { 4, 2 } }),
    (Edges{ { 0, 1 }, { 1, 0 }, { 1, 2 }, { 2, 1 }, { 2, 3 }, { 3, 4 }, { 4, 2 } }));
}

} // namespace
} // namespace hop::testing
