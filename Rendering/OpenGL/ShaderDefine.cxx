#include "OpenGL/ShaderDefine.h"

#include <locale>
#include <sstream>

namespace hop
{
//------------------------------------------------------------------------------
std::string ShaderDefine(const std::string& name, int value)
{
  return "#define " + name + " " + std::to_string(value) + "\n";
}

std::string ShaderDefine(const std::string& name, double value)
{
  std::ostringstream line;
  line.imbue(std::locale::classic());
  line << "#define " << name << " " << std::fixed << value << "\n";
  return line.str();
}
}
