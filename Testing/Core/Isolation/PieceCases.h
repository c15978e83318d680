#pragma once

#include "ElementCases.h"
#include "Isolation/ElementPieces.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <string>
#include <tuple>

namespace hop::testing
{

/// One element over its reference domain, and the kind of its pieces.
struct WholeElement
{
  WholeElement(Domain domain, int degree, const Field& field)
    : mesh(referenceMesh(domain, degree, field))
    , kind(domain, { degree, degree, degree })
  {
  }

  Piece piece(double isovalue = 0.0) const
  {
    return wholeElement(this->mesh, 0, isovalue, this->kind);
  }

  ElementMesh mesh;
  PieceKind kind;
};

/// All pieces of an element after a number of bisections.
inline std::vector<Piece> allPieces(const Piece& whole, int bisections)
{
  std::vector<Piece> pieces{ whole };
  for (int n = 0; n < bisections; ++n)
  {
    std::vector<Piece> halves;
    for (Piece& piece : pieces)
    {
      Piece second = halve(piece);
      halves.push_back(std::move(piece));
      halves.push_back(std::move(second));
    }
    pieces = std::move(halves);
  }
  return pieces;
}

/// One half of a piece.
inline Piece halfOf(Piece piece, bool isSecond)
{
  Piece second = halve(piece);
  return isSecond ? second : piece;
}

/// Every domain with degrees 1 to 4.
class PiecesOf : public ::testing::TestWithParam<std::tuple<Domain, int>>
{
protected:
  Domain domain() const { return std::get<0>(this->GetParam()); }
  int degree() const { return std::get<1>(this->GetParam()); }
  /// Random coefficients, without any symmetry.
  WholeElement randomElement(std::uint64_t seed) const
  {
    Random random(seed);
    WholeElement element(this->domain(), this->degree(), [](const glm::dvec3&) { return 0.0; });
    for (Coefficient& c : element.mesh.coefficients)
    {
      c.w = randomNumber(random);
    }
    return element;
  }
};

inline std::string nameOfCase(const ::testing::TestParamInfo<std::tuple<Domain, int>>& which)
{
  return ::testing::PrintToString(std::get<0>(which.param)) + "OfDegree" +
    std::to_string(std::get<1>(which.param));
}

inline auto allPieceCases()
{
  return ::testing::Combine(::testing::ValuesIn(allDomains), ::testing::Range(1, 5));
}

} // namespace hop::testing
