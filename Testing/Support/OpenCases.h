#pragma once

#include "AnalyticFields.h"
#include "ElementCases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>
#include <string>
#include <tuple>

namespace hop::testing
{

/// A surface that leaves the cube [-1,1]^3, with its area inside and the length of its boundary curves.
struct OpenCase
{
  const char* name;
  KnownSurface surface;
  double area = 0.0;
  double boundary = 0.0;
};

inline std::ostream& operator<<(std::ostream& out, const OpenCase& which)
{
  return out << which.name;
}

inline std::array<OpenCase, 3> openCases()
{
  return { OpenCase{ "Plane", plane({ 0, 0, 1 }, 0.05), 4.0, 8.0 },
    // Six caps of height 0.2 are cut off, in circles of radius sqrt(1.2^2 - 1).
    OpenCase{ "Sphere", sphere({ 0, 0, 0 }, 1.2), 2.0 * Pi * 1.2 * (2.4 - 6.0 * 0.2),
      6.0 * 2.0 * Pi * std::sqrt(0.44) },
    OpenCase{ "Cylinder", cylinder(0.7), 2.0 * 2.0 * Pi * 0.7, 2.0 * 2.0 * Pi * 0.7 } };
}

/// Every open case in a mesh of every domain.
inline auto openCasesInAllDomains()
{
  return ::testing::Combine(::testing::ValuesIn(openCases()), ::testing::ValuesIn(allDomains));
}

inline std::string nameOfOpenCase(
  const ::testing::TestParamInfo<std::tuple<OpenCase, Domain>>& which)
{
  return std::get<0>(which.param).name +
    ("In" + ::testing::PrintToString(std::get<1>(which.param)));
}

/// On a face of the cube [-1,1]^3, where open surfaces end.
inline bool onCube(const glm::dvec3& x)
{
  return std::max({ std::abs(x.x), std::abs(x.y), std::abs(x.z) }) > 1.0 - 1e-11;
}

} // namespace hop::testing
