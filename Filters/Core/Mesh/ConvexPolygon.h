#pragma once

#include "Mesh/TangentPlane.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace hop
{

/// A convex polygon around the origin, cut by one line after the other. To be reused: its memory only grows.
class ConvexPolygon
{
public:
  /// A square around the origin.
  /// \param r half of its side
  /// \param cuts largest number of cuts that follow
  void start(double r, std::size_t cuts)
  {
    this->Corners.resize(std::max(this->Corners.size(), 4 + cuts));
    this->Rest.resize(this->Corners.size());
    this->Heights.resize(this->Corners.size());
    this->Count = 4;
    this->Corners[0] = { -r, -r };
    this->Corners[1] = { r, -r };
    this->Corners[2] = { r, r };
    this->Corners[3] = { -r, r };
  }

  /// Keeps what lies below a line: normal . t <= offset.
  void cut(const glm::dvec2& normal, double offset)
  {
    std::size_t above = 0;
    for (std::size_t c = 0; c < this->Count; ++c)
    {
      this->Heights[c] = glm::dot(normal, this->Corners[c]) - offset;
      above += this->Heights[c] > 0.0;
    }
    if (above > 0)
    {
      this->Count = above < this->Count ? this->cutOff() : 0;
    }
  }

  /// Largest square of the distance of a corner.
  double reachSquared() const
  {
    double most = 0.0;
    for (std::size_t c = 0; c < this->Count; ++c)
    {
      most = std::max(most, glm::dot(this->Corners[c], this->Corners[c]));
    }
    return most;
  }

  /// The integral of 1 + stretch(t), where stretch is about a quadratic form: in each triangle with the origin it is
  /// integrated by its values in the middles of the edges.
  /// \param stretch homogeneous of degree two
  template <class Stretch>
  double integral(const Stretch& stretch) const
  {
    double sum = 0.0;
    const auto atHalf = [&](const glm::dvec2& t) { return std::max(-1.0, 0.25 * stretch(t)); };
    double last = this->Count > 0 ? atHalf(this->Corners[this->Count - 1]) : 0.0;
    for (std::size_t c = 0; c < this->Count; ++c)
    {
      const glm::dvec2& a = this->Corners[c > 0 ? c - 1 : this->Count - 1];
      const glm::dvec2& b = this->Corners[c];
      const double next = atHalf(b);
      const double mean = (last + next + atHalf(a + b)) / 3.0;
      sum += 0.5 * crossOf(a, b) * (1.0 + mean);
      last = next;
    }
    return sum;
  }

private:
  std::size_t after(std::size_t c) const { return c + 1 < this->Count ? c + 1 : 0; }

  /// Where the side from a corner to the next one passes the line.
  glm::dvec2 crossing(std::size_t c) const
  {
    const std::size_t next = this->after(c);
    const double share = this->Heights[c] / (this->Heights[c] - this->Heights[next]);
    return this->Corners[c] + share * (this->Corners[next] - this->Corners[c]);
  }

  /// Replaces the corners above the line, which follow each other, by two on it.
  /// \pre there are corners above the line, and others
  /// \return number of corners
  std::size_t cutOff()
  {
    std::size_t c = 0;
    while (this->Heights[c] <= 0.0 || this->Heights[this->after(c)] > 0.0)
    {
      c = this->after(c);
    }
    std::size_t count = 0;
    this->Rest[count++] = this->crossing(c);
    for (c = this->after(c); this->Heights[c] <= 0.0; c = this->after(c))
    {
      this->Rest[count++] = this->Corners[c];
    }
    this->Rest[count] = this->crossing(c > 0 ? c - 1 : this->Count - 1);
    this->Corners.swap(this->Rest);
    return count + 1;
  }

  std::vector<glm::dvec2> Corners, Rest;
  /// Of the corners above the line that cuts.
  std::vector<double> Heights;
  std::size_t Count = 0;
};

} // namespace hop
