#include "Run/SpacingAdvice.h"

#include <algorithm>
#include <cmath>

namespace hop
{

namespace
{

/// Fractions of particles that cannot follow the surface. Chosen by experiment.
struct UndersampledShare
{
  /// Above it there is a warning. Smaller values warn of a few particles at a tip, larger ones hide visible flaws.
  static constexpr double Warned = 0.02;
  /// What an advised spacing leaves, by its estimate: half of that, as estimates are rough.
  static constexpr double Advised = 0.01;
};

/// Which spacings are tried.
struct Trial
{
  /// Ratio of one spacing to the next: each takes twice the particles of a flat surface. Closer ones would find a
  /// spacing that takes a little less. Chosen by experiment.
  static constexpr double Ratio = 0.7071;
  /// Largest number of trials. At the default angular density a spacing 16 times smaller may take less than ten times
  /// the particles; smaller ones hardly ever do.
  static constexpr int Times = 8;
};

/// The same to two significant digits, without unit: what a user types.
double rounded(double spacing)
{
  const double unit = std::pow(10.0, std::floor(std::log10(spacing)) - 1.0);
  return std::round(spacing / unit) * unit;
}

std::size_t worstOf(const Buffer<Particle>& particles)
{
  const auto severity = [](const Particle& p) { return p.curvature.magnitude * p.spacing; };
  const auto worst = std::max_element(particles.begin(), particles.end(),
    [&](const Particle& a, const Particle& b) { return severity(a) < severity(b); });
  return static_cast<std::size_t>(worst - particles.begin());
}

/// Whether the gradient seems to vanish at a particle: the surface bends on a thousandth of the spacing.
bool isSingularAt(const Particle& particle)
{
  constexpr double largest =
    1000.0; // larger: thin tubes pass for singular; smaller: crossings for thin tubes
  return !(particle.curvature.magnitude * particle.spacing < largest);
}

/// The spacing with which the particles were made, where it is not known: that of the flattest place.
double largestSpacing(const Buffer<Particle>& particles)
{
  double largest = 0.0;
  for (const Particle& particle : particles)
  {
    largest = std::max(largest, particle.spacing);
  }
  return largest;
}

/// The share of particles that could not follow the surface with another sizing function.
double undersampledShare(const Buffer<Particle>& particles, const SizingFunction& sizing)
{
  double all = 0.0;
  double undersampled = 0.0;
  for (const Particle& particle : particles)
  {
    const double spacing = sizing.at(particle.curvature.magnitude);
    const double count = (particle.spacing / spacing) * (particle.spacing / spacing);
    all += count;
    undersampled += particle.wouldBeUndersampled(spacing) ? count : 0.0;
  }
  return undersampled / all;
}

} // namespace

bool hasTooManyUndersampled(const Distribution& distribution)
{
  return static_cast<double>(distribution.report.particlesUndersampled) >
    UndersampledShare::Warned * static_cast<double>(distribution.particles.size());
}

SpacingAdvice adviseSpacing(const Distribution& distribution, SizingFunction sizing, double unit,
  const std::function<double(double spacing)>& countAt)
{
  const Buffer<Particle>& particles = distribution.particles;
  SpacingAdvice advice;
  advice.unit = unit;
  advice.worst = worstOf(particles);
  advice.isSingular =
    distribution.report.singularPoints > 0 || isSingularAt(particles[advice.worst]);
  double exact = sizing.spacing > 0.0 ? sizing.spacing : largestSpacing(particles);
  for (int n = 0; n < Trial::Times; ++n)
  {
    exact *= Trial::Ratio;
    sizing.spacing = rounded(exact * unit) / unit;
    if (undersampledShare(particles, sizing) <= UndersampledShare::Advised)
    {
      const double count = countAt(sizing.spacing);
      const bool isAffordable =
        count <= SpacingAdvice::MostTimes * static_cast<double>(particles.size());
      advice.spacing = isAffordable ? sizing.spacing * unit : 0.0;
      advice.count = isAffordable ? std::llround(count) : 0;
      break;
    }
  }
  advice.isBounded = sizing.smallestSpacing > 0.0 && advice.spacing == 0.0;
  return advice;
}

} // namespace hop
