#pragma once

#include <functional>
#include <limits>
#include <string>

namespace hop::testing
{

/// What a piece of work took: elapsed, and of all processors together.
struct Seconds
{
  double wall = std::numeric_limits<double>::infinity();
  double cpu = std::numeric_limits<double>::infinity();
};

/// The least of several runs, wherever vtkSMPTools is asked to take as many threads as it may: so
/// many.
Seconds fastest(int threads, int repetitions, const std::function<void()>& work);

/// Memory of this process: the most it ever had, and what it has now.
double peakMegabytes();
double presentMegabytes();

/// A JSON object of numbers, in the order they are added; those that are not finite become null.
class Record
{
public:
  void add(const std::string& key, double value);
  /// As KEY_wall and KEY_cpu.
  void add(const std::string& key, const Seconds& seconds);
  /// On standard output.
  void print() const;

private:
  std::string Text;
};

} // namespace hop::testing
