#pragma once

#include "Support/Exchange.h"

#include <functional>

namespace hop::testing
{

/// Runs work(exchange) once a rank, each in a thread of its own: ranks of one process, whose messages go through memory.
/// As with MPI at its strictest, who sends waits until the other receives. A rank that waits for ten seconds throws
/// std::runtime_error, as do the others then: tests fail instead of hanging.
/// \throw what a rank has thrown first
void runRanks(int count, const std::function<void(Exchange&)>& work);

} // namespace hop::testing
