#pragma once

#include "Classic/ClassicParticles.h"
#include "Support/Random.h"
#include "Surface/DistributionParameters.h"

namespace hop
{

/// Splits particles with little energy and deletes particles with much by the paper's biased coin; deletes overlapping
/// particles always.
/// Derivation: Documentation/algorithm.md, section Classic distribution.
/// \return whether so many changed that the system has to settle again; if not, none did
bool splitAndDelete(
  ClassicParticles& particles, Random& random, const ClassicParameters& parameters = {});

/// Share by which the spacing has to fall so that the mean energy becomes the ideal one, to first order; negative where
/// it has to rise. In hexagonal packing dE/ds = -6 E'(beta) beta / s.
double excessEnergy(const std::vector<ClassicParticle>& movers);

/// Splits or deletes so many particles that the mean energy becomes ideal, to first order. The biased coin splits no
/// particle whose energy is above 0.65 of the ideal one: an even packing with up to an eighth too few particles stays
/// as it is.
void reachIdealEnergy(ClassicParticles& particles, Random& random);

/// Splits the particles with the least energy, or deletes the particles with the most, until there are `count`.
void setCount(ClassicParticles& particles, std::size_t count, Random& random);

/// Splits particles after the spacing was lowered: into four each on a flat surface where it was halved, into fewer
/// where the spacing follows the curvature.
/// \param oldSpacing of the sizing function, before
void splitByFour(ClassicParticles& particles, double oldSpacing, Random& random);

/// Deletes particles that overlap one before them.
/// \return whether there were such particles
bool dropOverlapping(ClassicParticles& particles);

} // namespace hop
