#include "FilterSession.h"

#include "RandomGrid.h"

#include <vtkBoundingBox.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPointData.h>
#include <vtkSMPTools.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <ctime>

namespace hop::testing
{
namespace
{

/// Largest processor time between two questions, as a share of the limit of a run: a second of ten.
constexpr double LongestSilence = 0.1;

struct Range
{
  double least = 0.0, most = 0.0;
};

/// Of the values that are finite.
Range rangeOf(vtkDataArray& values)
{
  Range range;
  bool isEmpty = true;
  for (vtkIdType i = 0; i < values.GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < values.GetNumberOfComponents(); ++c)
    {
      const double value = values.GetComponent(i, c);
      if (std::isfinite(value))
      {
        range = isEmpty ? Range{ value, value }
                        : Range{ std::min(range.least, value), std::max(range.most, value) };
        isEmpty = false;
      }
    }
  }
  return range;
}

/// About how large a field made of derivatives is, where values change by a number over the grid's length.
double sizeOfQuantity(int quantity, double change, double length)
{
  const double slope = 2.0 * change / length;
  const bool isSquare = quantity == vtkHighOrderParticleIsosurface::Q_CRITERION ||
    quantity == vtkHighOrderParticleIsosurface::LAMBDA_2;
  return isSquare ? slope * slope : slope;
}

} // namespace

double processorTime()
{
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

FilterSession::FilterSession(const GridRecipe& recipe, int threads, RunTimes times)
  : Recipe(recipe)
  , Times(times)
{
  vtkSMPTools::SetBackend("STDThread");
  vtkSMPTools::Initialize(threads);
  this->Filter->AddObserver(vtkCommand::ProgressEvent, this, &FilterSession::asked);
  this->Filter->AddObserver(vtkCommand::ErrorEvent, this, &FilterSession::told);
  this->Filter->AddObserver(vtkCommand::WarningEvent, this, &FilterSession::told);
  this->giveGrid(0);
  this->setProperties();
  this->setIsovalues(0.0);
}

void FilterSession::setProperties()
{
  const GridRecipe& recipe = this->Recipe;
  const double length = std::pow(10.0, recipe["length"]) * recipe["blocks"];
  this->Filter->SetInputArrayToProcess(0, 0, 0, 0, "f");
  this->Filter->SetPassDiagnostics(true);
  this->Filter->SetSpacing(recipe["Spacing"] * length);
  this->Filter->SetSmallestSpacing(recipe["SmallestSpacing"] * length);
  this->Filter->SetAngularDensity(recipe["AngularDensity"]);
  this->Filter->SetTolerance(recipe["Tolerance"]);
  this->Filter->SetNumberOfParticles(recipe.count("NumberOfParticles"));
  this->Filter->SetQuality(recipe.count("Quality"));
  this->Filter->SetMethod(recipe.count("Method"));
  this->Filter->SetNodeSpacing(recipe.count("NodeSpacing"));
  this->Filter->SetComponent(recipe.count("Component"));
  this->Filter->SetQuantity(recipe.count("Quantity"));
  this->Filter->SetExpression("f_X * f_X + coordsX");
  if (recipe.count("components") == 1)
  {
    this->Filter->SetExpression("f * abs(f) + coordsX");
  }
  this->Filter->SetDerivatives(recipe.count("Derivatives"));
  this->Filter->SetPassDerivatives(recipe.count("PassDerivatives") != 0);
  this->Filter->SetOutputType(recipe.count("OutputType"));
  this->Filter->SetOrder(recipe.count("Order"));
  this->Filter->SetParticlesPerWorker(recipe.count("ParticlesPerWorker"));
  this->Filter->SetWarmStart(recipe.count("WarmStart") != 0);
}

/// \param shift is added to the shares of the range
void FilterSession::setIsovalues(double shift)
{
  const GridRecipe& recipe = this->Recipe;
  Range range = rangeOf(*this->Grid->GetPointData()->GetArray("f"));
  if (const int quantity = recipe.count("Quantity"))
  {
    const double length = std::pow(10.0, recipe["length"]);
    range = { 0.0, sizeOfQuantity(quantity, range.most - range.least, length) };
  }
  int count = 0;
  for (const double share : { recipe["isovalue"] + shift, recipe["isovalue2"] })
  {
    if (share > -9.0)
    {
      this->Filter->SetValue(count++, (1.0 - share) * range.least + share * range.most);
    }
  }
}

void FilterSession::giveGrid(int change)
{
  this->Grid = makeGrid(this->Recipe, change);
  const int count = this->Recipe.count("pieces");
  if (count == 1)
  {
    this->Pieces = { this->Grid };
    this->Filter->SetInputDataObject(this->Grid);
    return;
  }
  this->Pieces = cutIntoPieces(*this->Grid, count);
  const vtkNew<vtkMultiBlockDataSet> blocks;
  for (const vtkSmartPointer<vtkUnstructuredGrid>& piece : this->Pieces)
  {
    blocks->SetBlock(blocks->GetNumberOfBlocks(), piece);
  }
  this->Filter->SetInputDataObject(blocks);
}

/// Notes how long the filter was silent.
void FilterSession::noteTime()
{
  const double now = processorTime();
  if (now - this->LastQuestion > this->Silence)
  {
    this->Silence = now - this->LastQuestion;
    this->ProgressOfSilence = this->Progress;
  }
  this->LastQuestion = now;
  this->Progress = this->Filter->GetProgress();
}

void FilterSession::asked(vtkObject*, unsigned long, void*)
{
  this->noteTime();
  if (this->Filter->GetProgress() >= 1.0)
  {
    return; // the output is there
  }
  this->IsGivenUp =
    this->LastQuestion - this->Begin > std::min(this->Times.limit, this->Times.patience);
  if (this->IsGivenUp || this->QuestionsLeft == 0)
  {
    this->Filter->SetAbortExecute(1);
  }
  this->QuestionsLeft = std::max(-1, this->QuestionsLeft - 1);
}

void FilterSession::told(vtkObject*, unsigned long, void* text)
{
  if (std::string(static_cast<const char*>(text)).find("the run failed") != std::string::npos)
  {
    this->Complaints.emplace_back("a run failed");
  }
}

void FilterSession::run()
{
  this->Complaints.clear();
  this->IsGivenUp = false;
  this->Silence = this->Progress = 0.0;
  this->Begin = this->LastQuestion = processorTime();
  this->Filter->Update();
  this->noteTime();
  if (this->LastQuestion - this->Begin > this->Times.limit)
  {
    this->Complaints.push_back(
      "a run takes longer than " + std::to_string(this->Times.limit) + " s");
  }
  if (this->Silence > LongestSilence * this->Times.limit)
  {
    this->Complaints.push_back("no question for " + std::to_string(this->Silence) +
      " s after progress " + std::to_string(this->ProgressOfSilence));
  }
}

/// An aborted run leaves nothing. One that has ended before is as good as any.
void FilterSession::abortAfter(int questions)
{
  this->Filter->SetSeed(2); // else the output of the run before would be kept
  this->QuestionsLeft = questions;
  this->run();
  const bool isAborted = this->QuestionsLeft < 0 && this->Filter->GetAbortExecute() != 0;
  this->QuestionsLeft = -1;
  if (isAborted)
  {
    for (const vtkSmartPointer<vtkDataObject>& part : this->outputs())
    {
      if (part && part->GetNumberOfElements(vtkDataObject::POINT) > 0)
      {
        this->Complaints.emplace_back("an aborted run has left points");
      }
    }
  }
  this->Filter->SetAbortExecute(0);
  this->Filter->SetSeed(3);
}

void FilterSession::change()
{
  const int kind = this->Recipe.count("change");
  if (kind == 1)
  {
    this->setIsovalues(0.05);
  }
  else if (kind == 2 || kind == 3)
  {
    this->giveGrid(kind);
  }
  else if (kind == 4)
  {
    this->Filter->SetOutputType((this->Filter->GetOutputType() + 1) % 3);
  }
  else
  {
    this->abortAfter(static_cast<int>(this->Recipe.seed() % 20));
  }
}

vtkDataObject& FilterSession::output() const
{
  return *this->Filter->GetOutputDataObject(0);
}

std::vector<vtkSmartPointer<vtkDataObject>> FilterSession::outputs() const
{
  auto* blocks = vtkMultiBlockDataSet::SafeDownCast(&this->output());
  if (!blocks)
  {
    return { &this->output() };
  }
  std::vector<vtkSmartPointer<vtkDataObject>> all;
  for (unsigned int n = 0; n < blocks->GetNumberOfBlocks(); ++n)
  {
    all.emplace_back(blocks->GetBlock(n));
  }
  return all;
}

} // namespace hop::testing
