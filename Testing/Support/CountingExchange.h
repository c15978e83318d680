#pragma once

#include "Support/Exchange.h"

#include <algorithm>

namespace hop::testing
{

/// Counts the bytes that a rank sends.
class CountingExchange final : public Exchange
{
public:
  explicit CountingExchange(Exchange& ranks)
    : Ranks(ranks)
  {
  }

  int rank() const override { return this->Ranks.rank(); }
  int size() const override { return this->Ranks.size(); }
  std::vector<Bytes> allGather(const Bytes& mine) override
  {
    this->count(mine.size(), this->size() - 1);
    return this->Ranks.allGather(mine);
  }
  void send(const void* bytes, std::size_t size, int to) override
  {
    this->count(size, 1);
    this->Ranks.send(bytes, size, to);
  }
  void receive(void* bytes, std::size_t size, int from) override
  {
    this->Ranks.receive(bytes, size, from);
  }

  std::size_t sent() const { return this->Sent; }
  /// Bytes of the largest message since the last call.
  std::size_t takeLargest()
  {
    const std::size_t largest = this->Largest;
    this->Largest = 0;
    return largest;
  }

private:
  void count(std::size_t size, int times)
  {
    this->Sent += size * static_cast<std::size_t>(times);
    this->Largest = std::max(this->Largest, size);
  }

  Exchange& Ranks;
  std::size_t Sent = 0;
  std::size_t Largest = 0;
};

} // namespace hop::testing
