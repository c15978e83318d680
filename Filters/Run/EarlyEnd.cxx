#include "Run/EarlyEnd.h"

#ifdef HOP_VTK_HAS_MPI
#include "vtkMPIController.h"
#endif

#include <cstddef>
#include <vector>

namespace hop
{

#ifdef HOP_VTK_HAS_MPI

/// Messages of one byte, which say that the run is called off.
class EarlyEnd::Notes
{
public:
  void send()
  {
    if (!this->AreSent)
    {
      this->AreSent = true;
      this->forOthers([this](int rank)
        { this->Controller->NoBlockSend(&this->Note, 1, rank, Tag, this->Requests[rank]); });
    }
  }

  /// Whether one has been sent by any rank, as far as is known here.
  bool areThere()
  {
    if (this->Controller && !this->AreSent && !this->HasArrived)
    {
      int isThere = 0;
      int sender = 0;
      this->Controller->Iprobe(vtkMultiProcessController::ANY_SOURCE, Tag, &isThere, &sender);
      this->HasArrived = isThere != 0;
    }
    return this->AreSent || this->HasArrived;
  }

  /// Receives those of other ranks, and waits until they have received this rank's.
  void settle(Exchange& exchange)
  {
    const std::vector<char> senders = gatherFromAll(exchange, static_cast<char>(this->AreSent));
    this->forOthers(
      [&](int rank)
      {
        if (senders[rank])
        {
          unsigned char note = 0;
          this->Controller->Receive(&note, 1, rank, Tag);
        }
      });
    this->forOthers(
      [this](int rank)
      {
        if (this->AreSent)
        {
          this->Requests[rank].Wait();
        }
      });
  }

private:
  /// Tells these messages from those of Ranks.cxx; ParaView's own tags are larger.
  static constexpr int Tag = 7252;

  template <class Use>
  void forOthers(const Use& use)
  {
    for (int rank = 0; this->Controller && rank < this->Controller->GetNumberOfProcesses(); ++rank)
    {
      if (rank != this->Controller->GetLocalProcessId())
      {
        use(rank);
      }
    }
  }

  /// None where there is one rank without MPI.
  vtkMPIController* Controller =
    vtkMPIController::SafeDownCast(vtkMultiProcessController::GetGlobalController());
  const unsigned char Note = 1;
  bool AreSent = false;
  bool HasArrived = false;
  /// One a rank, made before any is needed: nothing may fail between two of the messages for which others wait.
  std::vector<vtkMPICommunicator::Request> Requests = std::vector<vtkMPICommunicator::Request>(
    this->Controller ? this->Controller->GetNumberOfProcesses() : 0);
};

#else

class EarlyEnd::Notes
{
public:
  void send() { this->AreSent = true; }
  bool areThere() const { return this->AreSent; }
  void settle(Exchange&) {}

private:
  bool AreSent = false;
};

#endif

EarlyEnd::EarlyEnd(const RunCaller& caller)
  : ToOthers(std::make_unique<Notes>())
{
  const auto goesOn = [this](bool isAsked)
  {
    if (isAsked)
    {
      this->ToOthers->send();
    }
    return !this->ToOthers->areThere();
  };
  this->Caller.report = [goesOn, &caller](double fraction)
  { return goesOn(!caller.report(fraction)); };
  this->Caller.isAborted = [goesOn, &caller]() { return !goesOn(caller.isAborted()); };
  this->Caller.tell = caller.tell;
  this->Caller.expect = caller.expect;
}

EarlyEnd::~EarlyEnd() = default;

void EarlyEnd::settle(Exchange& exchange)
{
  this->ToOthers->settle(exchange);
}

} // namespace hop
