#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <vector>

namespace hop
{

/// An array whose entries are yet to be written. A vector would write zeros first, on one thread, and for
/// large arrays fetching their memory from the system is what takes the time.
template <class T>
class Buffer
{
public:
  static_assert(std::is_trivially_copyable_v<T>);

  Buffer() = default;
  explicit Buffer(std::size_t size)
    : Values(static_cast<T*>(::operator new(size * sizeof(T), Alignment)))
    , Size(size)
  {
  }

  std::size_t size() const { return this->Size; }
  bool empty() const { return this->Size == 0; }
  T* data() { return this->Values.get(); }
  const T* data() const { return this->Values.get(); }
  T& operator[](std::size_t i) { return this->Values[i]; }
  const T& operator[](std::size_t i) const { return this->Values[i]; }
  T* begin() { return this->data(); }
  T* end() { return this->data() + this->Size; }
  const T* begin() const { return this->data(); }
  const T* end() const { return this->data() + this->Size; }

private:
  static constexpr std::align_val_t Alignment{ alignof(T) };

  struct Free
  {
    void operator()(T* values) const { ::operator delete(values, Alignment); }
  };

  std::unique_ptr<T[], Free> Values;
  std::size_t Size = 0;
};

/// The entries of a vector or a buffer, which outlives it.
template <class T>
class Span
{
public:
  Span(const std::vector<T>& values)
    : First(values.data())
    , Count(values.size())
  {
  }
  Span(const Buffer<T>& values)
    : First(values.data())
    , Count(values.size())
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
