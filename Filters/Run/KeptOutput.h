#pragma once

#include "vtkSmartPointer.h"

#include <cstdint>

class vtkDataObject;

namespace hop
{

/// The output of the last run, for runs in which nothing has changed. ParaView's pipeline asks for some of them: when a
/// file with one time step is first updated and then shown at another time, the reader reads the same data again.
class KeptOutput
{
public:
  /// Whether the last run answered the same request.
  /// \param request the hash of the input and all properties
  bool answers(std::uint64_t request) const { return this->Data && this->Request == request; }

  /// Gives the kept particles to an output of the same kind, without copies of arrays.
  void copyTo(vtkDataObject* output) const;

  void keep(std::uint64_t request, vtkDataObject* output);
  void forget() { this->Data = nullptr; }

private:
  std::uint64_t Request = 0;
  vtkSmartPointer<vtkDataObject> Data;
};

} // namespace hop
