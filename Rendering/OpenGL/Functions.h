// What differs between versions of VTK: the loader that declares OpenGL's functions, and the name of an actor's matrix.
#pragma once

#if __has_include("vtk_glad.h")
#include "vtk_glad.h"
#else
#include "vtk_glew.h"
#endif

#include "vtkActor.h"
#include "vtkVersionMacros.h"

namespace hop
{
/** The matrix from an actor's own coordinates to the world's. */
inline void GetModelToWorld(vtkActor* actor, vtkMatrix4x4* matrix)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20220801)
  actor->GetModelToWorldMatrix(matrix);
#else
  actor->GetMatrix(matrix);
#endif
}
}
