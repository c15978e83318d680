#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace hop
{

/// Writes nothing where a vector makes entries without a value.
template <class T>
struct UnwrittenAllocator : std::allocator<T>
{
  static_assert(std::is_trivially_copyable_v<T>);

  template <class U>
  struct rebind
  {
    using other = UnwrittenAllocator<U>;
  };

  template <class U>
  void construct(U*) noexcept
  {
  }
  template <class U, class... Arguments>
  void construct(U* place, Arguments&&... arguments)
  {
    ::new (static_cast<void*>(place)) U(std::forward<Arguments>(arguments)...);
  }
};

/// A vector whose new entries have no value until they are written. A std::vector writes zeros first, in one thread;
/// for large arrays that takes the time, as the system gives memory when it is first written.
template <class T>
using Buffer = std::vector<T, UnwrittenAllocator<T>>;

/// The entries of a vector, to be read while the vector lives and keeps its size.
template <class T>
class Span
{
public:
  template <class Allocator>
  Span(const std::vector<T, Allocator>& values)
    : First(values.data())
    , Count(values.size())
  {
  }
  Span(const T* first, std::size_t count)
    : First(first)
    , Count(count)
  {
  }

  std::size_t size() const { return this->Count; }
  bool empty() const { return this->Count == 0; }
  const T& operator[](std::size_t i) const { return this->First[i]; }
  const T* begin() const { return this->First; }
  const T* end() const { return this->First + this->Count; }

private:
  const T* First;
  std::size_t Count;
};

} // namespace hop
