#pragma once

#include "Run/ParticleRun.h"

#include <memory>

namespace hop
{

/// The early end of a run on several ranks. The rank that is asked to stop tells the others at once, by messages for
/// which nobody waits; they look for them where they ask their own callers, in the middle of their steps. Where VTK's
/// controller does not speak MPI, ranks hear of it at the next step that all take together.
class EarlyEnd
{
public:
  /// \pre the caller outlives this
  explicit EarlyEnd(const RunCaller& caller);
  ~EarlyEnd();

  /// A caller that also asks for an early end where the one of another rank did. Only for the thread of the run.
  const RunCaller& ofAllRanks() const { return this->Caller; }

  /// To be called by all ranks when the run is over: no message is left, which would end the next run.
  void settle(Exchange& exchange);

private:
  class Notes;

  std::unique_ptr<Notes> ToOthers;
  RunCaller Caller;
};

} // namespace hop
