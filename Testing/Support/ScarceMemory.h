#pragma once

#include "Support/Exchange.h"

#include <cstddef>
#include <limits>

namespace hop::testing
{

constexpr long NeverFails = std::numeric_limits<long>::max();

/// Lets one allocation of this thread throw std::bad_alloc, as when memory runs out, as long as it lives. Only one at a
/// time in a thread; other threads get what they ask for.
class ScarceMemory
{
public:
  /// \param failing number of the allocation, from 0; or NeverFails
  /// \param least bytes of allocations that count; a few bytes are there even if memory has run out
  ScarceMemory(long failing, std::size_t least);
  ~ScarceMemory();
  ScarceMemory(const ScarceMemory&) = delete;
  ScarceMemory& operator=(const ScarceMemory&) = delete;

  /// Whether there were so many allocations.
  bool hasFailed() const;
};

/// An exchange whose own allocations never fail and do not count.
class ExchangeWithMemory final : public Exchange
{
public:
  explicit ExchangeWithMemory(Exchange& ranks)
    : Ranks(ranks)
  {
  }

  int rank() const override { return this->Ranks.rank(); }
  int size() const override { return this->Ranks.size(); }
  std::vector<Bytes> allGather(const Bytes& mine) override;
  void send(const void* bytes, std::size_t size, int to) override;
  void receive(void* bytes, std::size_t size, int from) override;

private:
  Exchange& Ranks;
};

} // namespace hop::testing
