#pragma once

#include "GridRecipe.h"
#include "vtkHighOrderParticleIsosurface.h"

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

class vtkDataObject;
class vtkObject;
class vtkUnstructuredGrid;

namespace hop::testing
{

/// Processor time of this process, seconds.
double processorTime();

/// Seconds of processor time that a run may take.
struct RunTimes
{
  /// More is a complaint.
  double limit = 10.0;
  /// After these a run is aborted, without a complaint.
  double patience = std::numeric_limits<double>::infinity();
};

/// A filter object and a recipe's grid.
class FilterSession
{
public:
  /// \param threads that the filter takes, at least 1
  FilterSession(const GridRecipe& recipe, int threads, RunTimes times);

  /// Runs the filter.
  void run();
  /// What the recipe changes after the first run: the isovalue, the values, the points, the type of the output; or it
  /// aborts a run after some questions.
  void change();

  /// What went wrong in the last run as such: too long, too long without a question, an error of the filter's own.
  const std::vector<std::string>& complaints() const { return this->Complaints; }
  /// Whether the last run took longer than there was patience, and was aborted.
  bool isGivenUp() const { return this->IsGivenUp; }
  vtkDataObject& output() const;
  /// The parts of the input, one where it is no composite, and of the output.
  const std::vector<vtkSmartPointer<vtkUnstructuredGrid>>& inputs() const { return this->Pieces; }
  std::vector<vtkSmartPointer<vtkDataObject>> outputs() const;
  const GridRecipe& recipe() const { return this->Recipe; }
  vtkHighOrderParticleIsosurface& filter() const { return *this->Filter; }

private:
  void setProperties();
  void setIsovalues(double shift);
  void giveGrid(int change);
  void noteTime();
  void asked(vtkObject* caller, unsigned long event, void* data);
  void told(vtkObject* caller, unsigned long event, void* data);
  void abortAfter(int questions);

  GridRecipe Recipe;
  vtkSmartPointer<vtkUnstructuredGrid> Grid;
  std::vector<vtkSmartPointer<vtkUnstructuredGrid>> Pieces;
  vtkNew<vtkHighOrderParticleIsosurface> Filter;
  std::vector<std::string> Complaints;
  RunTimes Times;
  bool IsGivenUp = false;
  double Begin = 0.0, LastQuestion = 0.0, Silence = 0.0;
  /// The filter's progress at the last question, and before the longest silence.
  double Progress = 0.0, ProgressOfSilence = 0.0;
  /// Questions after which the run is aborted; negative: never.
  int QuestionsLeft = -1;
};

} // namespace hop::testing
