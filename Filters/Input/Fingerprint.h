#pragma once

#include "Support/ByteHash.h"

class vtkDataObject;

namespace hop
{

/// Adds all of a data object that particles can depend on: of grids the points, cells and arrays, of composites also
/// the structure. Equal data have equal hashes, whichever objects hold them.
/// \param data may be nullptr
void addData(vtkDataObject* data, ByteHash& hash);

} // namespace hop
