#include "ScarceMemory.h"

#include <cstdlib>
#include <limits>
#include <new>

namespace
{

constexpr std::size_t Plenty = std::numeric_limits<std::size_t>::max();

/// Allocations of this thread from so many bytes on count.
thread_local std::size_t LeastSize = Plenty;
/// How many more succeed before one fails.
thread_local long Remaining = 0;

/// While it lives, memory is there.
class WithMemory
{
public:
  WithMemory() { LeastSize = Plenty; }
  ~WithMemory() { LeastSize = this->Before; }
  WithMemory(const WithMemory&) = delete;
  WithMemory& operator=(const WithMemory&) = delete;

private:
  std::size_t Before = LeastSize;
};

void* allocate(std::size_t size)
{
  const bool fails = size >= LeastSize && Remaining-- == 0;
  void* memory = fails ? nullptr : std::malloc(size ? size : 1);
  if (!memory)
  {
    throw std::bad_alloc();
  }
  return memory;
}

} // namespace

namespace hop::testing
{

ScarceMemory::ScarceMemory(long failing, std::size_t least)
{
  Remaining = failing;
  LeastSize = least;
}

ScarceMemory::~ScarceMemory()
{
  LeastSize = Plenty;
}

bool ScarceMemory::hasFailed() const
{
  return Remaining < 0;
}

std::vector<Bytes> ExchangeWithMemory::allGather(const Bytes& mine)
{
  const WithMemory memory;
  return this->Ranks.allGather(mine);
}

void ExchangeWithMemory::send(const void* bytes, std::size_t size, int to)
{
  const WithMemory memory;
  this->Ranks.send(bytes, size, to);
}

void ExchangeWithMemory::receive(void* bytes, std::size_t size, int from)
{
  const WithMemory memory;
  this->Ranks.receive(bytes, size, from);
}

} // namespace hop::testing

void* operator new(std::size_t size)
{
  return allocate(size);
}

void* operator new[](std::size_t size)
{
  return allocate(size);
}

// Who asks so does without.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept
{
  return std::malloc(size ? size : 1);
}

void* operator new[](std::size_t size, const std::nothrow_t&) noexcept
{
  return std::malloc(size ? size : 1);
}

void operator delete(void* memory) noexcept
{
  std::free(memory);
}

void operator delete[](void* memory) noexcept
{
  std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept
{
  std::free(memory);
}

void operator delete[](void* memory, std::size_t) noexcept
{
  std::free(memory);
}
