#include "RanksInMemory.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <map>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>

namespace hop::testing
{
namespace
{

/// What all ranks share.
class Mailbox
{
public:
  Mailbox(int count, std::chrono::seconds longest)
    : Count(count)
    , Longest(longest)
  {
  }

  int count() const { return this->Count; }

  void send(int from, int to, const void* bytes, std::size_t size)
  {
    std::unique_lock lock(this->Mutex);
    this->wait(lock, [&]() { return this->Messages.count({ from, to }) == 0; });
    const auto* first = static_cast<const unsigned char*>(bytes);
    this->Messages[{ from, to }] = Bytes(first, first + size);
    this->Change.notify_all();
    this->wait(lock, [&]() { return this->Messages.count({ from, to }) == 0; });
  }

  Bytes receive(int from, int to)
  {
    std::unique_lock lock(this->Mutex);
    this->wait(lock, [&]() { return this->Messages.count({ from, to }) > 0; });
    Bytes message = std::move(this->Messages[{ from, to }]);
    this->Messages.erase({ from, to });
    this->Change.notify_all();
    return message;
  }

  void fail(std::exception_ptr failure)
  {
    const std::lock_guard lock(this->Mutex);
    this->Failure = this->Failure ? this->Failure : std::move(failure);
    this->Change.notify_all();
  }

  const std::exception_ptr& failure() const { return this->Failure; }

private:
  template <class Condition>
  void wait(std::unique_lock<std::mutex>& lock, const Condition& isMet)
  {
    if (!this->Change.wait_for(lock, this->Longest, [&]() { return isMet() || this->Failure; }))
    {
      throw std::runtime_error("a rank waits for one that has left");
    }
    if (!isMet())
    {
      throw std::runtime_error("another rank has failed");
    }
  }

  int Count;
  std::chrono::seconds Longest;
  std::mutex Mutex;
  std::condition_variable Change;
  std::map<std::pair<int, int>, Bytes> Messages;
  std::exception_ptr Failure;
};

class RankInMemory final : public Exchange
{
public:
  RankInMemory(Mailbox& mailbox, int rank)
    : All(mailbox)
    , Rank(rank)
  {
  }

  int rank() const override { return this->Rank; }
  int size() const override { return this->All.count(); }

  std::vector<Bytes> allGather(const Bytes& mine) override
  {
    std::vector<Bytes> all(this->size());
    for (int from = 0; from < this->size(); ++from)
    {
      for (int to = 0; to < this->size(); ++to)
      {
        if (from == to)
        {
          all[this->Rank] = mine;
        }
        else if (from == this->Rank)
        {
          this->All.send(from, to, mine.data(), mine.size());
        }
        else if (to == this->Rank)
        {
          all[from] = this->All.receive(from, to);
        }
      }
    }
    return all;
  }

  void send(const void* bytes, std::size_t size, int to) override
  {
    this->All.send(this->Rank, to, bytes, size);
  }

  void receive(void* bytes, std::size_t size, int from) override
  {
    const Bytes message = this->All.receive(from, this->Rank);
    if (message.size() != size)
    {
      throw std::runtime_error("a message of another size than expected");
    }
    if (bytes)
    {
      std::copy(message.begin(), message.end(), static_cast<unsigned char*>(bytes));
    }
  }

private:
  Mailbox& All;
  int Rank;
};

} // namespace

void runRanks(int count, const std::function<void(Exchange&)>& work, std::chrono::seconds longest)
{
  Mailbox mailbox(count, longest);
  std::vector<std::thread> threads;
  for (int rank = 0; rank < count; ++rank)
  {
    threads.emplace_back(
      [&, rank]()
      {
        try
        {
          RankInMemory exchange(mailbox, rank);
          work(exchange);
        }
        catch (...)
        {
          mailbox.fail(std::current_exception());
        }
      });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  if (mailbox.failure())
  {
    std::rethrow_exception(mailbox.failure());
  }
}

} // namespace hop::testing
