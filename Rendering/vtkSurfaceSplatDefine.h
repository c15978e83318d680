/**
 * @file  vtkSurfaceSplatDefine.h
 * @brief constants that C++ and shaders share
 */

#ifndef vtkSurfaceSplatDefine_h
#define vtkSurfaceSplatDefine_h

#include <string>

///@{
/** The line of GLSL that defines a name as a number; one with a fraction has a point, whatever the locale is. */
std::string vtkSurfaceSplatDefine(const std::string& name, int value);
std::string vtkSurfaceSplatDefine(const std::string& name, double value);
///@}

#endif
