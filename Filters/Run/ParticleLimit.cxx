#include "Run/ParticleLimit.h"

#include "Surface/DistributionParameters.h"

#include <vtksys/SystemInformation.hxx>

#include <algorithm>

namespace hop
{

namespace
{

/// Memory of the whole filter at its peak, bytes a particle: measured at 1.1 to 1.5 kB with one point array. Smaller
/// values admit runs that exhaust the memory, larger ones refuse runs that would fit.
constexpr std::int64_t bytesPerParticle = 1536;

/// Particles are numbered by int, and so are places in tables with room for half as many more: 1.5 times this number
/// has to be below 2^31.
constexpr std::int64_t mostParticles = 1'000'000'000;

} // namespace

std::int64_t particlesThatFit()
{
  constexpr std::int64_t megabyte = 1024 * 1024;
  vtksys::SystemInformation system;
  system.RunMemoryCheck();
  const auto available = static_cast<std::int64_t>(system.GetAvailablePhysicalMemory());
  // 0: the system does not say.
  return available > 0 ? std::min(mostParticles, available * megabyte / bytesPerParticle)
                       : DistributionParameters().particleLimit;
}

} // namespace hop
