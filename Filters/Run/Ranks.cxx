#include "Run/Ranks.h"

#include "vtkBoundingBox.h"
#include "vtkMultiProcessController.h"
#include "vtkMultiProcessStream.h"
#include "vtkType.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace hop
{

namespace
{

/// The ranks of a controller.
class ControllerExchange final : public Exchange
{
public:
  explicit ControllerExchange(vtkMultiProcessController* controller)
    : Controller(controller)
  {
  }

  int rank() const override { return this->Controller->GetLocalProcessId(); }
  int size() const override { return this->Controller->GetNumberOfProcesses(); }

  std::vector<Bytes> allGather(const Bytes& mine) override
  {
    const auto length = static_cast<vtkIdType>(mine.size());
    std::vector<vtkIdType> lengths(this->size());
    this->Controller->AllGather(&length, lengths.data(), 1);
    std::vector<vtkIdType> offsets(this->size(), 0);
    std::partial_sum(lengths.begin(), lengths.end() - 1, offsets.begin() + 1);
    Bytes received(offsets.back() + lengths.back());
    this->Controller->AllGatherV(
      mine.data(), received.data(), length, lengths.data(), offsets.data());
    std::vector<Bytes> all;
    for (int r = 0; r < this->size(); ++r)
    {
      const auto first = received.begin() + offsets[r];
      all.emplace_back(first, first + lengths[r]);
    }
    return all;
  }

  void send(const void* bytes, std::size_t size, int to) override
  {
    const auto* at = static_cast<const unsigned char*>(bytes);
    for (std::size_t sent = 0; sent < size; sent += LargestMessage)
    {
      const std::size_t length = std::min(LargestMessage, size - sent);
      this->Controller->Send(at + sent, static_cast<vtkIdType>(length), to, Tag);
    }
  }

  void receive(void* bytes, std::size_t size, int from) override
  {
    Bytes unwanted(bytes ? 0 : std::min(LargestMessage, size));
    for (std::size_t received = 0; received < size; received += LargestMessage)
    {
      const std::size_t length = std::min(LargestMessage, size - received);
      unsigned char* to = bytes ? static_cast<unsigned char*>(bytes) + received : unwanted.data();
      this->Controller->Receive(to, static_cast<vtkIdType>(length), from, Tag);
    }
  }

private:
  /// Bytes of a message; longer ones are cut. Far below the 2 GB that MPI counts to, so that a rank without memory for
  /// all of it can throw it away piece by piece; so large that the number of messages costs nothing.
  static constexpr std::size_t LargestMessage = std::size_t(1) << 24;
  /// Of messages of this filter; ParaView's own tags are larger.
  static constexpr int Tag = 7251;

  vtkMultiProcessController* Controller;
};

std::vector<double> gather(double local)
{
  return gatherFromAll(*makeExchange(), local);
}

} // namespace

std::unique_ptr<Exchange> makeExchange()
{
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  if (controller && controller->GetNumberOfProcesses() > 1)
  {
    return std::make_unique<ControllerExchange>(controller);
  }
  return std::make_unique<NoExchange>();
}

vtkBoundingBox overAllRanks(const vtkBoundingBox& local)
{
  std::array<double, 6> mine;
  local.GetBounds(mine.data());
  vtkBoundingBox box;
  for (const std::array<double, 6>& bounds : gatherFromAll(*makeExchange(), mine))
  {
    if (bounds[0] <= bounds[1])
    {
      box.AddBounds(bounds.data());
    }
  }
  return box;
}

bool isFirstOfRanks()
{
  return makeExchange()->rank() == 0;
}

std::size_t largestOfRanks(std::size_t local)
{
  const std::vector<double> all = gather(static_cast<double>(local));
  return static_cast<std::size_t>(*std::max_element(all.begin(), all.end()));
}

double sumOfRanks(double local)
{
  const std::vector<double> all = gather(local);
  return std::accumulate(all.begin(), all.end(), 0.0);
}

std::map<int, std::int64_t> sumOfRanks(
  Exchange& exchange, const std::map<int, std::int64_t>& counts)
{
  vtkMultiProcessStream stream;
  for (const auto& [key, count] : counts)
  {
    stream << key << static_cast<vtkTypeInt64>(count);
  }
  Bytes bytes;
  stream.GetRawData(bytes);
  std::map<int, std::int64_t> sums;
  for (const Bytes& some : exchange.allGather(bytes))
  {
    stream.SetRawData(some);
    while (!stream.Empty())
    {
      int key = 0;
      vtkTypeInt64 count = 0;
      stream >> key >> count;
      sums[key] += count;
    }
  }
  return sums;
}

} // namespace hop
