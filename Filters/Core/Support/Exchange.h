#pragma once

#include <cstddef>
#include <cstring>
#include <exception>
#include <type_traits>
#include <vector>

namespace hop
{

using Bytes = std::vector<unsigned char>;

/// Processes that work on one mesh and send each other bytes: the seam to MPI. All ranks call the same functions in the
/// same order, and a rank that has failed goes on calling them: none waits for one that has left.
class Exchange
{
public:
  virtual ~Exchange() = default;

  virtual int rank() const = 0;
  virtual int size() const = 0;

  /// What every rank gives, in the order of ranks; may differ in size. For small things: all of it reaches every rank.
  virtual std::vector<Bytes> allGather(const Bytes& mine) = 0;

  /// Returns when the bytes may be overwritten; may wait until the other rank receives.
  virtual void send(const void* bytes, std::size_t size, int to) = 0;

  /// \param bytes nullptr: what arrives is thrown away, for ranks without memory for it
  /// \param size as sent
  virtual void receive(void* bytes, std::size_t size, int from) = 0;

  /// Whether this rank is alone.
  bool isAlone() const { return this->size() == 1; }
};

/// The only rank.
class NoExchange final : public Exchange
{
public:
  int rank() const override { return 0; }
  int size() const override { return 1; }
  std::vector<Bytes> allGather(const Bytes& mine) override { return std::vector<Bytes>(1, mine); }
  void send(const void*, std::size_t, int) override {}
  void receive(void*, std::size_t, int) override {}
};

/// One value of every rank, in the order of ranks.
template <class T>
std::vector<T> gatherFromAll(Exchange& exchange, const T& mine)
{
  static_assert(std::is_trivially_copyable_v<T>);
  Bytes bytes(sizeof(T));
  std::memcpy(bytes.data(), &mine, sizeof(T));
  std::vector<T> all;
  for (const Bytes& some : exchange.allGather(bytes))
  {
    std::memcpy(&all.emplace_back(), some.data(), sizeof(T));
  }
  return all;
}

/// Whether all ranks say yes.
inline bool allAgree(Exchange& exchange, bool mine)
{
  for (const char yes : gatherFromAll(exchange, static_cast<char>(mine)))
  {
    if (!yes)
    {
      return false;
    }
  }
  return true;
}

/// Does some work, unless something has failed before.
/// \param isSound whether nothing has failed on this rank
/// \param failure of the work on this rank, if it fails
/// \return whether it has been done on all ranks
template <class Use>
bool attemptOnAll(Exchange& exchange, bool& isSound, std::exception_ptr& failure, const Use& use)
{
  try
  {
    if (isSound)
    {
      use();
    }
  }
  catch (...)
  {
    isSound = false;
    failure = std::current_exception();
  }
  return allAgree(exchange, isSound);
}

template <class T>
void sendArray(Exchange& exchange, const T* values, std::size_t count, int to)
{
  static_assert(std::is_trivially_copyable_v<T>);
  exchange.send(values, count * sizeof(T), to);
}

/// \param values nullptr: they are thrown away
template <class T>
void receiveArray(Exchange& exchange, T* values, std::size_t count, int from)
{
  static_assert(std::is_trivially_copyable_v<T>);
  exchange.receive(values, count * sizeof(T), from);
}

} // namespace hop
