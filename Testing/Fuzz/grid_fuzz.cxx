// Feeds the filter with random grids, judges what comes out, and shrinks what fails. Without Python, so that sanitizers
// see many grids in little time.
//
//   grid_fuzz [from=SEED] [to=SEED] [limit=SECONDS] [patience=SECONDS]
//                                                        the recipes of these seeds: default 0 to 300, 10 s, no patience
//   grid_fuzz [limit=SECONDS] FILE                       the recipes of a file, one a line; '#' begins a comment
//   grid_fuzz from=SEED to=SEED list                     writes such a file
//
// With `small`, recipes are of few cells of low degrees and of few particles: many more of them fit into an hour. With
// `tiny`, they are of one to four such cells and as few particles as there can be.
//
// A recipe fails if its process ends, if a run of the filter takes more than `limit` seconds of processor time or is
// silent for a tenth of that, or if OutputJudge.h complains; of every fourth seed, if another number of threads gives
// another bit. A run that takes more than `patience` seconds is aborted, which is no failure: its output is judged, and
// there are no further runs of the recipe. Recipes that fail are printed at once as lines for such a file; at the end the first one of each kind of
// complaint is shrunk, for a minute at most. The exit status is 1 if one fails.

#include "FilterSession.h"
#include "GridRecipe.h"
#include "GuardedRuns.h"
#include "OutputJudge.h"

#include <vtkDataObject.h>
#include <vtkLogger.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace
{

using hop::testing::Failure;
using hop::testing::FilterSession;
using hop::testing::GridRecipe;
using hop::testing::RunTimes;
using hop::testing::Tally;

/// What recipes are bounded by.
enum class Size
{
  Any,
  Small,
  Tiny
};

struct Options
{
  std::uint64_t from = 0, to = 300;
  RunTimes times;
  bool isList = false;
  Size size = Size::Any;
  std::string file;
};

/// A recipe that has failed.
struct Report
{
  GridRecipe recipe;
  std::string complaint;
};

/// The first of each kind of complaint; see kindOf().
using Reports = std::map<std::string, Report>;

/// Recipes that one child process runs before it looks for leaks, which takes as long as some tiny ones.
std::size_t batchOf(Size size)
{
  return size == Size::Tiny ? 200 : 20;
}

void append(const std::vector<std::string>& complaints, std::string& text)
{
  for (const std::string& complaint : complaints)
  {
    text += (text.empty() ? "" : "; ") + complaint;
  }
}

/// Runs the filter and judges its output.
void runAndJudge(FilterSession& session, Tally& tally, std::string& found, std::string& outputs)
{
  session.run();
  append(judge(session), found);
  outputs += contents(session);
  const vtkIdType points = session.output().GetNumberOfElements(vtkDataObject::POINT);
  ++tally.runs;
  tally.runsWithPoints += points > 0 ? 1 : 0;
  tally.points += points;
  tally.givenUp += session.isGivenUp() ? 1 : 0;
}

/// What the runs of a recipe have given.
struct Outcome
{
  std::string complaint;
  /// The bytes of all outputs.
  std::string outputs;
  bool isGivenUp = false;
};

/// All runs of a recipe on one number of threads.
Outcome runAll(const GridRecipe& recipe, int threads, RunTimes times, Tally& tally)
{
  Outcome outcome;
  FilterSession session(recipe, threads, times);
  runAndJudge(session, tally, outcome.complaint, outcome.outputs);
  if (recipe.count("change") > 0 && !session.isGivenUp())
  {
    session.change();
    append(session.complaints(), outcome.complaint);
    runAndJudge(session, tally, outcome.complaint, outcome.outputs);
  }
  outcome.isGivenUp = session.isGivenUp();
  return outcome;
}

std::string complaintOf(const GridRecipe& recipe, RunTimes times, Tally& tally)
{
  const int threads = recipe.count("threads");
  const Outcome first = runAll(recipe, threads, times, tally);
  if (!first.complaint.empty() || first.isGivenUp || recipe.seed() % 4 != 0)
  {
    return first.complaint;
  }
  const Outcome second = runAll(recipe, threads % 4 + 1, times, tally);
  if (!second.complaint.empty() || second.isGivenUp || first.outputs == second.outputs)
  {
    return second.complaint;
  }
  return "another number of threads gives another output";
}

/// A recipe's runs are two, or four with other threads: an item may take the limits of all.
std::vector<Failure> tryAll(const std::vector<GridRecipe>& recipes, RunTimes times, Tally& tally)
{
  return hop::testing::runGuarded(
    recipes.size(), 5.0 * times.limit,
    [&](std::size_t i, Tally& ofChild) { return complaintOf(recipes[i], times, ofChild); }, tally);
}

/// Letters up to the first number, by which complaints of one kind are known.
std::string kindOf(const std::string& complaint)
{
  return complaint.substr(0, complaint.find_first_of("0123456789;"));
}

/// The simplest recipe found within a minute that gives a complaint of the same kind.
GridRecipe shrunk(GridRecipe recipe, const std::string& complaint, RunTimes times)
{
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  Tally tally;
  for (bool found = true; found;)
  {
    found = false;
    for (const GridRecipe& smaller : recipe.simpler())
    {
      const std::vector<Failure> failures = tryAll({ smaller }, times, tally);
      found = !failures.empty() && kindOf(failures.front().complaint) == kindOf(complaint);
      if (found)
      {
        recipe = smaller;
      }
      if (found || std::chrono::steady_clock::now() > end)
      {
        break;
      }
    }
  }
  return recipe;
}

/// Prints failures, and keeps those of a new kind.
void report(
  const std::vector<GridRecipe>& recipes, const std::vector<Failure>& failures, Reports& kept)
{
  for (const auto& [item, complaint] : failures)
  {
    if (item == recipes.size())
    {
      std::printf("# seeds %llu to %llu: %s\n",
        static_cast<unsigned long long>(recipes.front().seed()),
        static_cast<unsigned long long>(recipes.back().seed()), complaint.c_str());
      continue;
    }
    std::printf("# %s\n%s\n", complaint.c_str(), recipes[item].text().c_str());
    kept.try_emplace(kindOf(complaint), Report{ recipes[item], complaint });
  }
  std::fflush(stdout);
}

void shrinkAll(const Reports& kept, RunTimes times)
{
  for (const auto& [kind, first] : kept)
  {
    const GridRecipe simplest = shrunk(first.recipe, first.complaint, times);
    std::printf("# shrunk from seed %llu: %s\n%s\n",
      static_cast<unsigned long long>(first.recipe.seed()), first.complaint.c_str(),
      simplest.text().c_str());
    std::fflush(stdout);
  }
}

std::vector<GridRecipe> recipesOf(const std::string& file)
{
  std::vector<GridRecipe> recipes;
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);)
  {
    line = line.substr(0, line.find('#'));
    if (!line.empty())
    {
      recipes.emplace_back(line);
    }
  }
  return recipes;
}

Options parse(int count, char** words)
{
  Options options;
  for (int i = 1; i < count; ++i)
  {
    const std::string word = words[i];
    const std::string value = word.substr(std::min(word.find('=') + 1, word.size()));
    if (word.rfind("from=", 0) == 0)
    {
      options.from = std::stoull(value);
    }
    else if (word.rfind("to=", 0) == 0)
    {
      options.to = std::stoull(value);
    }
    else if (word.rfind("limit=", 0) == 0)
    {
      options.times.limit = std::stod(value);
    }
    else if (word.rfind("patience=", 0) == 0)
    {
      options.times.patience = std::stod(value);
    }
    else if (word == "small")
    {
      options.size = Size::Small;
    }
    else if (word == "tiny")
    {
      options.size = Size::Tiny;
    }
    else if (word == "list")
    {
      options.isList = true;
    }
    else
    {
      options.file = word;
    }
  }
  return options;
}

void list(const std::vector<GridRecipe>& recipes)
{
  for (const GridRecipe& recipe : recipes)
  {
    std::printf("%s\n", recipe.text().c_str());
  }
}

std::vector<GridRecipe> recipesOf(std::uint64_t begin, std::uint64_t end, Size size)
{
  std::vector<GridRecipe> recipes;
  for (std::uint64_t seed = begin; seed < end; ++seed)
  {
    recipes.emplace_back(seed);
    if (size == Size::Small)
    {
      recipes.back().keepSmall();
    }
    else if (size == Size::Tiny)
    {
      recipes.back().keepTiny();
    }
  }
  return recipes;
}

} // namespace

int main(int count, char** words)
{
  const Options options = parse(count, words);
  vtkLogger::SetStderrVerbosity(
    vtkLogger::VERBOSITY_OFF); // VTK's own cells have much to say of odd ones
  if (options.isList)
  {
    list(recipesOf(options.from, options.to, options.size));
    return 0;
  }
  std::size_t grids = 0, failed = 0;
  Tally tally;
  Reports kept;
  const auto run = [&](const std::vector<GridRecipe>& recipes)
  {
    const std::vector<Failure> failures = tryAll(recipes, options.times, tally);
    report(recipes, failures, kept);
    failed += failures.size();
    grids += recipes.size();
  };
  if (!options.file.empty())
  {
    run(recipesOf(options.file));
  }
  const std::size_t batch = batchOf(options.size);
  for (std::uint64_t seed = options.from; options.file.empty() && seed < options.to; seed += batch)
  {
    run(recipesOf(seed, std::min<std::uint64_t>(options.to, seed + batch), options.size));
    std::fprintf(stderr, "up to seed %llu\n", static_cast<unsigned long long>(seed + batch));
  }
  shrinkAll(kept, options.times);
  std::printf(
    "# %zu recipes, %lld runs, %lld of them with %lld points, %lld given up, %zu recipes failed\n",
    grids, static_cast<long long>(tally.runs), static_cast<long long>(tally.runsWithPoints),
    static_cast<long long>(tally.points), static_cast<long long>(tally.givenUp), failed);
  return failed > 0 || grids == 0 ? 1 : 0;
}
