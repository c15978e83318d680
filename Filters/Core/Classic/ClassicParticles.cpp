#include "Classic/ClassicParticles.h"

#include "Support/KeepMarked.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace hop
{
namespace
{

/// Factor by which the neighbour lists reach beyond the range of interaction, as particles move while lists last.
/// Chosen by experiment. Larger: longer lists; smaller: neighbours that come near are overlooked for some sweeps.
constexpr double listSlack = 1.25;

/// Factor of a box's diagonal within which Newton's method has to find the surface from the box's middle. Chosen by
/// experiment. Larger: seeds of other components; smaller: the line between two corners is searched more often.
constexpr double seedTravelPerBox = 2.0;

/// Energy of the neighbours that hexagonal packing can have around a particle on a number of boundary faces: 6 inside,
/// 4 on a face, 2 on an edge, 1 in a corner.
double idealEnergyOnBoundary(int boundaryFaces)
{
  constexpr double neighbors[] = { 6.0, 4.0, 2.0, 1.0 };
  return neighbors[std::min(boundaryFaces, 3)] * pairEnergy(HexagonalDistance);
}

} // namespace

glm::dvec3 orthogonalTo(const glm::dvec3& n)
{
  const glm::dvec3 other = std::abs(n.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  return glm::normalize(glm::cross(n, other));
}

ClassicParticles::ClassicParticles(
  const Isosurface& surface, const SizingFunction& sizingFunction, ParallelFor parallelFor)
  : sizing(sizingFunction)
  , Parallel(std::move(parallelFor))
  , Surface(surface)
  , Walker(this->Surface)
{
}

/// Projects a place onto the surface, and evaluates there what the distribution needs.
bool ClassicParticles::place(
  const Location& start, double maximumTravel, SurfaceWalker& walker, ClassicParticle& mover) const
{
  if (!walker.project(start, maximumTravel, mover.at))
  {
    return false;
  }
  mover.normal = surfaceNormal(mover.at.point.gradient);
  mover.ideal = idealEnergyOnBoundary(walker.endFaceCount(mover.at.location));
  mover.curvature = 0.0;
  if (this->sizing.angularDensity > 0.0)
  {
    const Evaluated curved = walker.evaluateCurved(mover.at.location);
    mover.curvature = curvature(curved.point.gradient, curved.hessian).magnitude;
  }
  return true;
}

bool ClassicParticles::displace(
  const ClassicParticle& from, const WorldVector& step, double farthest, ClassicParticle& to)
{
  const Location reached = this->Walker.move(from.at, step);
  return this->place(reached, farthest, this->Walker, to) &&
    length(to.position() - from.position()) <= farthest && dot(to.normal, from.normal) > 0.0;
}

/// Finds a point of the surface by Newton's method from the middle of the box or, if that leads away from the box, on
/// the line between two of its corners.
bool ClassicParticles::seed(
  const SurfaceBox& box, SurfaceWalker& walker, ClassicParticle& mover, std::int64_t& cost) const
{
  const bool found = this->place(box.middle, seedTravelPerBox * box.size, walker, mover);
  if ((found && isAtBox(box, mover.at.location)) || !box.straddles)
  {
    return found;
  }
  return this->place(findBetweenEnds(*this->Surface.mesh, this->Surface.isovalue, box, cost),
    box.size, walker, mover);
}

std::vector<ClassicParticle> ClassicParticles::randomSeeds(
  int count, double farthest, Random& random)
{
  const ElementMesh& mesh = *this->Surface.mesh;
  SurfaceWalker walker(this->Surface);
  std::vector<ClassicParticle> seeds;
  for (int n = 0; n < count; ++n)
  {
    Location place;
    place.element = static_cast<int>(random.uniform() * static_cast<double>(mesh.elements.size()));
    do
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        place.u.xyz[axis] = random.uniform();
      }
    } while (insideMargin(mesh.elements[place.element].domain, place.u) < 0.0);
    ClassicParticle seed;
    if (this->place(place, farthest, walker, seed))
    {
      seeds.push_back(seed);
    }
  }
  this->SeedCost += walker.evaluations();
  return seeds;
}

std::vector<ClassicParticle> ClassicParticles::seedsOf(const std::vector<SurfaceBox>& boxes)
{
  std::vector<ClassicParticle> seeds(boxes.size());
  std::vector<char> found(boxes.size(), 0);
  std::vector<std::int64_t> cost(boxes.size(), 0);
  runParallel(this->Parallel, static_cast<std::ptrdiff_t>(boxes.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      for (std::ptrdiff_t b = begin; b < end; ++b)
      {
        SurfaceWalker walker(this->Surface);
        found[b] = this->seed(boxes[b], walker, seeds[b], cost[b]);
        cost[b] += walker.evaluations();
      }
    });
  this->SeedCost = std::accumulate(cost.begin(), cost.end(), this->SeedCost);
  keepMarked(seeds, found);
  return seeds;
}

void ClassicParticles::addUncovered(const std::vector<ClassicParticle>& seeds)
{
  GrowingBins bins(this->sizing.spacing);
  for (std::size_t i = 0; i < this->movers.size(); ++i)
  {
    bins.insert(static_cast<int>(i), this->movers[i].position().xyz);
  }
  for (const ClassicParticle& seed : seeds)
  {
    const double h = this->sizing.at(seed.curvature);
    bool covered = false;
    bins.visit(seed.position().xyz,
      [&](int j)
      {
        const ClassicParticle& other = this->movers[j];
        covered = covered ||
          (length(seed.position() - other.position()) < h && dot(seed.normal, other.normal) > 0.0);
      });
    if (!covered)
    {
      bins.insert(static_cast<int>(this->movers.size()), seed.position().xyz);
      this->movers.push_back(seed);
    }
  }
}

bool ClassicParticles::addBeside(const ClassicParticle& parent, double distance, double angle)
{
  const glm::dvec3 e1 = orthogonalTo(parent.normal.xyz);
  const glm::dvec3 e2 = glm::cross(parent.normal.xyz, e1);
  const WorldVector step{ distance * (std::cos(angle) * e1 + std::sin(angle) * e2) };
  ClassicParticle child = parent;
  if (!this->displace(parent, step, 2.0 * distance, child))
  {
    ++this->Rejected;
    return false;
  }
  child.lambda = ClassicParticle::InitialLambda;
  this->movers.push_back(child);
  return true;
}

void ClassicParticles::renewNeighbors()
{
  std::vector<glm::dvec3> points;
  std::vector<double> radii;
  points.reserve(this->movers.size());
  radii.reserve(this->movers.size());
  for (const ClassicParticle& m : this->movers)
  {
    points.push_back(m.position().xyz);
    // The neighbour's curvature may be as low as zero.
    radii.push_back(listSlack * this->sizing.range(0.5 * m.curvature));
  }
  this->neighbors = findNeighbors(points, radii, this->Parallel);
}

double ClassicParticles::scaledDistance(const ClassicParticle& a, const ClassicParticle& b) const
{
  return length(a.position() - b.position()) /
    this->sizing.range(0.5 * (a.curvature + b.curvature));
}

} // namespace hop
