#include "Surface/Patch.h"

namespace hop
{

float Patch::curvatureMagnitude() const
{
  const auto& [xx, xy, yy] = this->shape;
  return std::sqrt(xx * xx + 2.0f * xy * xy + yy * yy);
}

glm::dvec3 Patch::step(const glm::vec2& t) const
{
  const auto tangents = tangentsOf(this->normal);
  return glm::dvec3(t.x * tangents[0] + t.y * tangents[1] - this->sink(t) * this->normal);
}

glm::dvec2 Patch::inPlane(const glm::dvec3& place) const
{
  const auto tangents = tangentsOf(this->normal);
  const glm::dvec3 d = place - this->position;
  return { glm::dot(d, glm::dvec3(tangents[0])), glm::dot(d, glm::dvec3(tangents[1])) };
}

double Patch::heightOf(const glm::dvec3& place) const
{
  return glm::dot(place - this->position, glm::dvec3(this->normal)) +
    this->sink(this->inPlane(place));
}

SpacedPoints spacedPoints(const Buffer<Patch>& patches, const ParallelFor& parallelFor)
{
  return { patches.size(), [&](std::size_t i) { return patches[i].position; },
    [&](std::size_t i) { return patches[i].spacing; }, parallelFor };
}

} // namespace hop
