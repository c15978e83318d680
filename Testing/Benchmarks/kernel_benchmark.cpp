// Nanoseconds for one evaluation of value and derivatives of (x, y, z, f) at a point of an element:
// every domain, degrees 1 to 10, every instruction set of this machine, in batches of 64 points, of
// one point, and by the function for single points; beside VTK's own cells, which need two calls
// (EvaluateLocation, Derivatives) for position and gradient alone.
//   kernel_benchmark --benchmark_repetitions=5 --benchmark_out=kernel.json
//   python3 kernel_table.py kernel.json
#include "Elements/BatchEvaluator.h"
#include "Kernel/InstructionSet.h"

#include "ElementCases.h"
#include "VtkCells.h"

#include <benchmark/benchmark.h>

#include <sstream>

namespace hop::testing
{
namespace
{

constexpr int batchSize = 64;

struct Sample
{
  std::vector<Coefficient> coefficients;
  std::vector<ReferencePoint> points;
  BernsteinForm form;

  explicit Sample(const ElementCase& which)
  {
    Random random(1);
    this->coefficients = randomCoefficients(which, random);
    for (int n = 0; n < batchSize; ++n)
    {
      this->points.push_back(randomPoint(which.domain, random));
    }
    this->form = formOf(which, this->coefficients);
  }
};

void setTime(benchmark::State& state, int evaluations)
{
  state.counters["evaluation"] = benchmark::Counter(
    evaluations, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

using BatchFunction = void (*)(const BernsteinForm&, const ReferencePoint*, int, JetBatch&);
using PointFunction = Jet (*)(const BernsteinForm&, const ReferencePoint&);

void batches(benchmark::State& state, const ElementCase& which, InstructionSet set,
  BatchFunction evaluate, int size)
{
  useInstructionSet(set);
  const Sample sample(which);
  JetBatch jets;
  for (auto _ : state)
  {
    evaluate(sample.form, sample.points.data(), size, jets);
    benchmark::DoNotOptimize(jets.row(0, 0));
    benchmark::ClobberMemory();
  }
  setTime(state, size);
}

void singlePoints(
  benchmark::State& state, const ElementCase& which, InstructionSet set, PointFunction evaluate)
{
  useInstructionSet(set);
  const Sample sample(which);
  for (auto _ : state)
  {
    for (const ReferencePoint& u : sample.points)
    {
      benchmark::DoNotOptimize(evaluate(sample.form, u));
    }
  }
  setTime(state, batchSize);
}

void vtkCells(benchmark::State& state, const ElementCase& which)
{
  const Sample sample(which);
  VtkCell cell(which);
  for (auto _ : state)
  {
    for (const ReferencePoint& u : sample.points)
    {
      benchmark::DoNotOptimize(cell.evaluate(u));
    }
  }
  setTime(state, batchSize);
}

void registerCase(const ElementCase& which)
{
  const auto name = [&](const std::string& how, const std::string& order, const char* set)
  {
    std::ostringstream text;
    text << which.domain << '/' << which.degrees[0] << '/' << order << '/' << set << '/' << how;
    return text.str();
  };
  const auto add = [](const std::string& text, auto function, auto... arguments)
  { benchmark::RegisterBenchmark(text.c_str(), function, arguments...); };
  for (const InstructionSet set : availableInstructionSets())
  {
    const char* setName = nameOf(set);
    add(name("batch 64", "gradient", setName), batches, which, set, evaluateGradients, batchSize);
    add(name("batch 64", "Hessian", setName), batches, which, set, evaluateHessians, batchSize);
    add(name("batch 1", "Hessian", setName), batches, which, set, evaluateHessians, 1);
    add(name("point", "gradient", setName), singlePoints, which, set, evaluateGradient);
    add(name("point", "Hessian", setName), singlePoints, which, set, evaluateHessian);
  }
  add(name("cell", "gradient", "VTK"), vtkCells, which);
}

} // namespace
} // namespace hop::testing

int main(int argc, char** argv)
{
  for (const auto domain :
    { hop::Domain::Hexahedron, hop::Domain::Tetrahedron, hop::Domain::Wedge })
  {
    for (int p = 1; p <= hop::maximumInputDegree(hop::Domain::Tetrahedron); ++p)
    {
      hop::testing::registerCase({ domain, { p, p, p } });
    }
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
