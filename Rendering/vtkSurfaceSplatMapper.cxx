#include "vtkSurfaceSplatMapper.h"
#include "vtkObjectFactory.h"
vtkStandardNewMacro(vtkSurfaceSplatMapper);
