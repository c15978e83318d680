#pragma once

#include <string>
#include <vector>

namespace hop::testing
{

class FilterSession;

/// What is wrong with the output of a session's last run; nothing if all is right: numbers are finite, normals of unit
/// length, ids and parametric coordinates in range, radii positive; meshes are oriented manifolds with boundary; some
/// particles are compared with VTK's own cells, whether they stand where their parametric coordinates are, and on the
/// surface to the tolerance.
std::vector<std::string> judge(const FilterSession& session);

/// Points, arrays and cells of the output as bytes, for comparisons bit for bit.
std::string contents(const FilterSession& session);

} // namespace hop::testing
