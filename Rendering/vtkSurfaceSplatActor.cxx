#include "vtkSurfaceSplatActor.h"

#include "vtkMapper.h"
#include "vtkObjectFactory.h"
#include "vtkProperty.h"

vtkStandardNewMacro(vtkSurfaceSplatActor);

//------------------------------------------------------------------------------
vtkTypeBool vtkSurfaceSplatActor::HasOpaqueGeometry()
{
  const bool backface = this->BackfaceProperty && this->BackfaceProperty->GetOpacity() >= 1. &&
    !this->ForceTranslucent && this->Mapper && this->Mapper->HasOpaqueGeometry();
  return backface || this->Superclass::HasOpaqueGeometry();
}

//------------------------------------------------------------------------------
vtkTypeBool vtkSurfaceSplatActor::HasTranslucentPolygonalGeometry()
{
  const bool backface =
    this->BackfaceProperty && this->BackfaceProperty->GetOpacity() < 1. && !this->ForceOpaque;
  return backface || this->Superclass::HasTranslucentPolygonalGeometry();
}
