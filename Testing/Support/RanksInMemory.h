#pragma once

#include "Support/Exchange.h"

#include <chrono>
#include <functional>

namespace hop::testing
{

/// Runs work(exchange) once a rank, each in a thread of its own: ranks of one process, whose messages go through memory.
/// As with MPI at its strictest, who sends waits until the other receives. A rank that waits longer than it may throws
/// std::runtime_error, as do the others then: tests fail instead of hanging.
/// \throw what a rank has thrown first
void runRanks(int count, const std::function<void(Exchange&)>& work,
  std::chrono::seconds longest = std::chrono::seconds(10));

} // namespace hop::testing
