// The OpenGL functions, from the loader that this VTK was built with.
#ifndef vtkSurfaceSplatGL_h
#define vtkSurfaceSplatGL_h

#if __has_include("vtk_glad.h")
#include "vtk_glad.h"
#else
#include "vtk_glew.h"
#endif

#endif
