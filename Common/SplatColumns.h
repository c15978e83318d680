#pragma once

#include <cstddef>

namespace hop
{

/// What the renderer reads of a particle and nobody else: columns of one point array, so that the colour list, the
/// spreadsheet and the text at the mouse are left to what users look at. It is a point array because all filters that
/// keep points keep it; any of its columns may also be an array of its own, under its own name, and then counts.

/// ParaView's spreadsheet leaves out columns whose names begin so; colour lists leave the array out for its key
/// vtkAbstractArray::GUI_HIDE.
constexpr const char* SplatColumnsArray = "__vtkValidMask__Splats";

/// The same of points of a mesh that lie on creases, where splats are drawn on both sides of the crease; zero elsewhere.
/// Where creases meet it knows two sides.
constexpr const char* CreaseColumnsArray = "__vtkValidMask__Creases";

struct SplatColumn
{
  /// As in the table of Filters/Output/OutputArrays.cxx.
  const char* name;
  int components;
};

/// In the order of the components. New ones belong at the end: files keep the array as it was.
constexpr SplatColumn SplatColumns[] = {
  { "Clip_Normal", 9 },
  { "Clip_Distance", 3 },
  { "Clip_Angle", 3 },
  { "Clip_Curvature", 3 },
  { "Shape_Operator", 6 },
  { "Original_Placement", 6 },
  { "Cell_Borders", 16 },
};

/// The unit normal of the side of which SplatColumns are, and what is known of the other one.
constexpr SplatColumn CreaseColumns[] = {
  { "Side_Normal", 3 },
  { "Other_Normal", 3 },
  { "Clip_Normal", 9 },
  { "Clip_Distance", 3 },
  { "Clip_Angle", 3 },
  { "Clip_Curvature", 3 },
  { "Shape_Operator", 6 },
};

/// Components of an array.
template <std::size_t Count>
constexpr int splatColumnCount(const SplatColumn (&columns)[Count])
{
  int count = 0;
  for (const SplatColumn& column : columns)
  {
    count += column.components;
  }
  return count;
}

} // namespace hop
