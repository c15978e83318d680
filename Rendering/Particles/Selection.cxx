#include "Particles/Selection.h"

#include "vtkDataObject.h"
#include "vtkHardwareSelector.h"
#include "vtkIdTypeArray.h"
#include "vtkPolyData.h"
#include "vtkStaticCellLinksTemplate.h"
#include "vtkUnsignedIntArray.h"

#include <algorithm>

namespace hop
{
namespace
{
// The number in a pixel of two passes.
vtkIdType ReadNumber(const unsigned char* low, const unsigned char* high, unsigned int pixel)
{
  return low[pixel] | low[pixel + 1] << 8 | low[pixel + 2] << 16 |
    static_cast<vtkIdType>(high ? high[pixel] : 0) << 24;
}

void WriteNumber(vtkIdType number, unsigned char* pixel)
{
  for (int byte = 0; byte < 3; ++byte)
  {
    pixel[byte] = static_cast<unsigned char>((number >> (8 * byte)) & 0xff);
  }
}
}

//------------------------------------------------------------------------------
std::string SelectionCode(int pass)
{
  switch (pass)
  {
    case vtkHardwareSelector::POINT_ID_LOW24:
      return "  gl_FragData[0] = vec4(texelFetch(splatPointIds, splatParticle).rgb, 1.0);\n";
    case vtkHardwareSelector::POINT_ID_HIGH24:
      return "  gl_FragData[0] = vec4(texelFetch(splatPointIds, splatParticle).a, 0.0, 0.0, "
             "1.0);\n";
    case vtkHardwareSelector::CELL_ID_LOW24:
      return "  gl_FragData[0] = vec4(vec3((ivec3(splatParticle) >> ivec3(0, 8, 16)) & 255) / "
             "255.0, "
             "1.0);\n";
    case vtkHardwareSelector::CELL_ID_HIGH24:
      return "  gl_FragData[0] = vec4(float(splatParticle >> 24) / 255.0, 0.0, 0.0, 1.0);\n";
    default:
      return "";
  }
}

//------------------------------------------------------------------------------
void SelectCells(vtkPolyData* input, vtkIdTypeArray* ids, vtkHardwareSelector* selector,
  const std::vector<unsigned int>& pixels)
{
  const unsigned char* low = selector->GetRawPixelBuffer(vtkHardwareSelector::CELL_ID_LOW24);
  const unsigned char* high = selector->GetRawPixelBuffer(vtkHardwareSelector::CELL_ID_HIGH24);
  const int pass = selector->GetCurrentPass();
  const int shift = pass == vtkHardwareSelector::CELL_ID_LOW24 ? 0 : 24;
  const bool byCells = selector->GetFieldAssociation() == vtkDataObject::FIELD_ASSOCIATION_CELLS;
  vtkStaticCellLinksTemplate<vtkIdType> links;
  links.BuildLinks(input);
  for (unsigned int pixel : pixels)
  {
    const vtkIdType point = ReadNumber(low, high, pixel);
    const bool used = point < input->GetNumberOfPoints() && links.GetNcells(point) > 0;
    const vtkIdType cell = used ? links.GetCells(point)[0] : 0;
    const vtkIdType id = used && ids ? ids->GetValue(cell) : cell;
    WriteNumber(id >> shift, selector->GetPixelBuffer(pass) + pixel);
    if (!used && byCells)
    {
      std::fill_n(selector->GetPixelBuffer(vtkHardwareSelector::ACTOR_PASS) + pixel, 3, 0);
    }
  }
}

//------------------------------------------------------------------------------
void SelectRanks(vtkUnsignedIntArray* ranks, vtkHardwareSelector* selector,
  const std::vector<unsigned int>& pixels)
{
  const unsigned char* low = selector->GetRawPixelBuffer(vtkHardwareSelector::POINT_ID_LOW24);
  const unsigned char* high = selector->GetRawPixelBuffer(vtkHardwareSelector::POINT_ID_HIGH24);
  unsigned char* written = selector->GetPixelBuffer(vtkHardwareSelector::PROCESS_PASS);
  for (unsigned int pixel : pixels)
  {
    const vtkIdType point = low ? ReadNumber(low, high, pixel) : ranks->GetNumberOfValues();
    if (point < ranks->GetNumberOfValues())
    {
      WriteNumber(ranks->GetValue(point) + 1, written + pixel); // 0 is no rank
    }
  }
}
}
