// To be preloaded: lets an allocation of the filter's own fail, as when memory runs out. Code in other libraries, VTK's
// among them, gets what it asks for.

#include <link.h>

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>

namespace
{

std::atomic<long> Counted{ 0 };
std::atomic<long> Failing{ -1 };

/// Where a library lies in memory.
struct AddressRange
{
  std::uintptr_t begin = UINTPTR_MAX;
  std::uintptr_t end = 0;
};

int findFilter(dl_phdr_info* library, std::size_t, void* data)
{
  if (!std::strstr(library->dlpi_name, "libvtkHighOrderParticleFilters"))
  {
    return 0;
  }
  auto& range = *static_cast<AddressRange*>(data);
  for (int i = 0; i < library->dlpi_phnum; ++i)
  {
    const auto& part = library->dlpi_phdr[i];
    const std::uintptr_t begin = library->dlpi_addr + part.p_vaddr;
    if (part.p_type == PT_LOAD && begin < range.begin)
    {
      range.begin = begin;
    }
    if (part.p_type == PT_LOAD && begin + part.p_memsz > range.end)
    {
      range.end = begin + part.p_memsz;
    }
  }
  return 1;
}

AddressRange Filter;

void* allocate(std::size_t size, void* caller)
{
  const auto address = reinterpret_cast<std::uintptr_t>(caller);
  if (Filter.begin <= address && address < Filter.end && Counted++ == Failing)
  {
    throw std::bad_alloc();
  }
  if (void* memory = std::malloc(size ? size : 1))
  {
    return memory;
  }
  throw std::bad_alloc();
}

} // namespace

/// Lets the allocation with this number fail, counted from now on; none if the number is negative.
extern "C" void failAllocation(long number)
{
  dl_iterate_phdr(findFilter, &Filter);
  Counted = 0;
  Failing = number;
}

/// How many allocations there were since the last call of failAllocation().
extern "C" long countedAllocations()
{
  return Counted;
}

void* operator new(std::size_t size)
{
  return allocate(size, __builtin_return_address(0));
}

void* operator new[](std::size_t size)
{
  return allocate(size, __builtin_return_address(0));
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
