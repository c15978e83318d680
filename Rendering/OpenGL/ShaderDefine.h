/**
 * @file  ShaderDefine.h
 * @brief constants that C++ and shaders share
 */

#pragma once

#include <string>

namespace hop
{
///@{
/** The line of GLSL that defines a name as a number. A number with a fraction has a point, whatever the locale is. */
std::string ShaderDefine(const std::string& name, int value);
std::string ShaderDefine(const std::string& name, double value);
///@}
}
