#pragma once

#include "Common/Monitor.h"
#include "Edges/BoundaryCurves.h"
#include "Support/Slab.h"
#include "Surface/Anchor.h"
#include "Surface/DistributionParameters.h"
#include "Surface/Particles.h"

#include <memory>
#include <string>

namespace hop
{

/// How far workers beside each other work on the same part of the surface, in units of the spacing on flat surfaces.
/// Derivation: Documentation/algorithm.md, section Ranks.
struct SlabOverlap
{
  /// Half the width of the strip around a plane in which one of the two workers settles how their particles fit
  /// together. Larger: more particles are relaxed twice; smaller: what does not fit cannot spread.
  static constexpr double Strip = 4.0;
  /// How far beyond the strip particles are seen that stay where they are: more than the sqrt(3) over which particles
  /// interact, and the 1.86 over which splats overlap, and a step. Larger: more is sent.
  static constexpr double Sight = 3.0;
  /// How far from where the particles of two slabs meet both workers put them into one order: more than
  /// MinimumSeparation, and less than what both of them see. Larger: more is sorted.
  static constexpr double Meeting = 1.5;
  /// How far beyond a plane a worker distributes particles that it drops later. Gradation reaches 1/0.3 spacings. Larger:
  /// more is done twice; smaller: the strip notices that nothing is beyond.
  static constexpr double Reach = 10.0;
  /// Least distance, in units of the spacing, of particles on boundary curves of two slabs. Where curves run side by side
  /// two workers may keep different ones. As in one slab: larger drops more, smaller leaves pairs.
  static constexpr double OnCurves = 0.6;
  /// Width of the outermost part in which seeds stay where they are, more than the sqrt(3) over which particles
  /// interact: without them particles spread into the void, and were half a percent too few. Larger: their disorder is
  /// noticed in the strip.
  static constexpr double Guard = 2.0;
  /// Largest distance from a plane, world units over spacing, at which a particle on a boundary curve stands for the
  /// place where the curve passes the plane. It belongs to the slab before the plane. More than the error of such places,
  /// and less than half a spacing, so that no other particle is taken for it.
  static constexpr double OnPlane = 0.05;
  /// Least thickness of a slab between two others: strips, and what is seen around them, must not meet. Smaller: more than
  /// half of the particles are relaxed twice, and their number was up to 0.7% off.
  static constexpr double Thickness = 20.0;
};

/// Particles near a plane between two slabs, as one worker tells the other.
struct SlabParticles
{
  /// Of particles that move; as many as anchors.
  Buffer<Anchor> anchors;
  Buffer<Patch> patches;
  /// See BoundaryCurves.
  Buffer<BoundaryParticle> onBoundary;
  Buffer<BoundaryParticle> thinned;
};

/// The Fast distribution in a slab, by a worker who hears of the particles of the slabs before and behind. Workers take
/// these steps together, and pass on what they give each other between them:
///  1. relax(): particles in the slab and some way around it, as if the other workers were not there;
///  2. settleEnd() with firstParticles() of the next slab: in a strip around the plane between the two, the particles of
///     both are thinned out and relaxed, among particles that stay;
///  3. finish() with lastParticles() of the slab before.
/// Each particle is in the result of one worker. Elements of particles that are passed on are numbered as in the mesh of
/// the worker that receives them.
/// Derivation: Documentation/algorithm.md, section Ranks.
class SlabDistribution
{
public:
  /// \param surface whose mesh holds all elements within SlabOverlap::Reach of the slab
  /// \param parameters without a given number and without particles to start from
  /// \param slab thicker than SlabOverlap::Thickness where it has two planes
  /// \pre monitor and threads outlive this
  SlabDistribution(const Isosurface& surface, const DistributionParameters& parameters,
    const Slab& slab, const Monitor& monitor, const ParallelFor& parallelFor);
  ~SlabDistribution();

  /// \throw Interrupted, as other steps do
  /// \return why nothing was done; empty if all is well
  std::string relax();
  SlabParticles firstParticles() const;
  /// To be called where there is a next slab.
  void settleEnd(const SlabParticles& next);
  SlabParticles lastParticles() const;
  /// \param before empty where there is no slab before
  Distribution finish(const SlabParticles& before);

private:
  class System;
  std::unique_ptr<System> Worker;
};

} // namespace hop
