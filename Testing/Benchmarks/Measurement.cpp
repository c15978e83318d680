#include "Measurement.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace hop::testing
{
namespace
{

rusage ownUsage()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage;
}

double cpuSeconds()
{
  const rusage usage = ownUsage();
  return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
    1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

} // namespace

Seconds fastest(int threads, int repetitions, const std::function<void()>& work)
{
  setenv("VTK_SMP_MAX_THREADS", std::to_string(threads).c_str(), 1);
  Seconds best;
  for (int i = 0; i < repetitions; ++i)
  {
    const double cpu = cpuSeconds();
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    best.wall = std::min(best.wall, wall.count());
    best.cpu = std::min(best.cpu, cpuSeconds() - cpu);
  }
  return best;
}

double peakMegabytes()
{
  return static_cast<double>(ownUsage().ru_maxrss) / 1024.0;
}

double presentMegabytes()
{
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
  {
    if (word == "VmRSS:")
    {
      double kilobytes = 0.0;
      status >> kilobytes;
      return kilobytes / 1024.0;
    }
  }
  return 0.0;
}

void Record::add(const std::string& key, double value)
{
  char text[32];
  std::snprintf(text, sizeof(text), std::isfinite(value) ? "%.6g" : "null", value);
  this->Text += (this->Text.empty() ? "" : ", ") + ("\"" + key + "\": ") + text;
}

void Record::add(const std::string& key, const Seconds& seconds)
{
  this->add(key + "_wall", seconds.wall);
  this->add(key + "_cpu", seconds.cpu);
}

void Record::print() const
{
  std::printf("{%s}\n", this->Text.c_str());
}

} // namespace hop::testing
