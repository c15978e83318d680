#include "vtkHighOrderParticleIsosurface.h"
#include "vtkObjectFactory.h"
vtkStandardNewMacro(vtkHighOrderParticleIsosurface);
