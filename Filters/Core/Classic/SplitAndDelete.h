#pragma once

#include "Classic/ClassicParticles.h"
#include "Support/Random.h"

namespace hop
{

/// Splits lonely particles and deletes crowded ones by a biased coin, and overlapping ones always.
/// \return whether enough wanted to that the system has to settle again
bool splitAndDelete(ClassicParticles& particles, Random& dice);

/// By how much the mean energy exceeds the ideal one, as a relative change of spacing: in hexagonal
/// packing dE/ds = -6 E'(beta) beta / s.
double excessEnergy(const std::vector<ClassicParticle>& movers);

/// The biased coin is content while every energy is above 0.65 of the ideal one: evenly so with an
/// eighth too few particles. This takes the population to where the mean energy is ideal.
void insertAndDelete(ClassicParticles& particles, Random& dice);

/// Splits the loneliest or deletes the most crowded until there are exactly `count`.
void forceCount(ClassicParticles& particles, std::size_t count, Random& dice);

/// After the spacing was halved: each particle becomes four on a flat surface, fewer where
/// curvature keeps the spacing.
void splitByFour(ClassicParticles& particles, double oldSpacing, Random& dice);

/// Of particles that lie all but in the same place, deletes all but the first.
/// \return whether there were any
bool dropOverlapping(ClassicParticles& particles);

} // namespace hop
