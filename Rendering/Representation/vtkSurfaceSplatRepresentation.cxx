#include "vtkSurfaceSplatRepresentation.h"

#include "GhostParticles.h"
#include "SplatInput.h"
#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkPVRenderView.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkScalarsToColors.h"
#include "vtkSurfaceSplatActor.h"
#include "vtkSurfaceSplatMapper.h"
#include "vtkTransform.h"

#include <algorithm>

vtkStandardNewMacro(vtkSurfaceSplatRepresentation);

namespace
{
// Number of particles that are drawn, about, while the camera moves and the view asks for a level of detail. Chosen by
// experiment: more make the picture slower, fewer make it coarser.
constexpr vtkIdType InteractiveParticles = 50000;
}

//------------------------------------------------------------------------------
vtkSurfaceSplatRepresentation::vtkSurfaceSplatRepresentation()
  : OwnParticles(vtkSmartPointer<vtkPolyData>::New())
  , Particles(OwnParticles)
  , ArraysToColorBy(OwnParticles)
{
  this->Actor->SetMapper(this->Mapper);
  vtkMath::UninitializeBounds(this->DiskBounds);
  // Inputs need not have these arrays.
  this->Mapper->SetPointIdArrayName(hop::SplatInput::BlockPointIdName);
  this->Mapper->SetCellIdArrayName(hop::SplatInput::BlockCellIdName);
  this->Mapper->SetCompositeIdArrayName(hop::SplatInput::BlockIndexName);
  this->Mapper->SetCellColorArrayName(hop::SplatInput::BlockColorName);
  this->Mapper->SetProcessIdArrayName(hop::GhostParticles::RankName);
  this->SetMapScalars(1);
  // As ParaView's other representations have them; vtkProperty has other defaults.
  this->SetEdgeColor(0., 0., 0.5);
  this->SetPointSize(2.);
  this->SetSpecularPower(100.);
  this->SetRoughness(0.3);
}

vtkSurfaceSplatRepresentation::~vtkSurfaceSplatRepresentation() = default;

//------------------------------------------------------------------------------
int vtkSurfaceSplatRepresentation::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  // Clients and render servers have the representation, but not its input.
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

//------------------------------------------------------------------------------
int vtkSurfaceSplatRepresentation::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const bool hasInput = inputs[0]->GetNumberOfInformationObjects() == 1;
  this->OwnParticles = hop::SplatInput::AsParticles(
    hasInput ? vtkDataObject::GetData(inputs[0], 0) : nullptr, this->Blocks);
  this->ArraysToColorBy = hop::SplatInput::WithoutBlockIds(this->OwnParticles);
  this->Particles = this->OwnParticles;
  this->AllParticles = nullptr;
  if (hasInput)
  {
    vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
    this->Mapper->SetLargestRadiusElsewhere(hop::GhostParticles::LargestOfRanks(
      this->Mapper->GetLargestRadius(this->OwnParticles), controller));
    this->Particles = hop::GhostParticles::Add(
      this->OwnParticles, this->Mapper->GetDisks(this->OwnParticles), controller);
  }
  this->Mapper->GetDiskBounds(this->OwnParticles, this->DiskBounds);
  return this->Superclass::RequestData(request, inputs, outputs);
}

//------------------------------------------------------------------------------
int vtkSurfaceSplatRepresentation::ProcessViewRequest(
  vtkInformationRequestKey* request, vtkInformation* inInfo, vtkInformation* outInfo)
{
  if (request == vtkPVView::REQUEST_UPDATE() && this->WasTranslucent != this->IsTranslucent())
  {
    // Other particles are drawn then, which nobody asks for unless the input seems to be a new one.
    this->WasTranslucent = !this->WasTranslucent;
    this->MarkModified();
  }
  if (!this->Superclass::ProcessViewRequest(request, inInfo, outInfo))
  {
    return 0; // not visible
  }
  if (request == vtkPVView::REQUEST_UPDATE())
  {
    this->ProvideParticles(inInfo, outInfo);
  }
  else if (request == vtkPVView::REQUEST_UPDATE_LOD())
  {
    // The mapper thins them out.
    vtkPVView::SetPieceLOD(inInfo, this, this->GetParticlesToDraw());
  }
  else if (request == vtkPVView::REQUEST_RENDER())
  {
    this->PrepareMapper(inInfo);
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatRepresentation::PrepareMapper(vtkInformation* inInfo)
{
  const bool lod = inInfo->Has(vtkPVRenderView::USE_LOD()) != 0;
  auto* particles = vtkPolyData::SafeDownCast(vtkPVView::GetDeliveredPiece(inInfo, this));
  if (lod && !particles)
  {
    particles = vtkPolyData::SafeDownCast(vtkPVView::GetDeliveredPieceLOD(inInfo, this));
  }
  const vtkIdType count = particles ? particles->GetNumberOfPoints() : 0;
  this->Mapper->SetStride(lod ? static_cast<int>(1 + count / InteractiveParticles) : 1);
  this->Mapper->SetInputDataObject(particles);
  this->Mapper->SetBlendGhosts(!particles || !hop::GhostParticles::AreMerged(particles));
  this->UpdateColoring();
  this->UpdateBackface();
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatRepresentation::ProvideParticles(
  vtkInformation* inInfo, vtkInformation* outInfo)
{
  vtkPVView::SetPiece(inInfo, this, this->GetParticlesToDraw());

  vtkNew<vtkMatrix4x4> matrix;
  this->Actor->GetMatrix(matrix);
  vtkPVRenderView::SetGeometryBounds(inInfo, this, this->DiskBounds, matrix);

  // Particles stay on their ranks, and the other data follows their partition: redistribution cuts
  // by cells and fails on ranks without particles and on coincident ones.
  outInfo->Set(vtkPVRenderView::NEED_ORDERED_COMPOSITING(), this->IsTranslucent() ? 1 : 0);
  vtkPVRenderView::SetOrderedCompositingConfiguration(
    inInfo, this, vtkPVRenderView::USE_BOUNDS_FOR_REDISTRIBUTION);
}

//------------------------------------------------------------------------------
// Which layers of a translucent surface are nearest and farthest, and which is behind which, follows from all of it: one
// rank draws them. All ranks agree on what is translucent, and get here together.
vtkPolyData* vtkSurfaceSplatRepresentation::GetParticlesToDraw()
{
  if (!this->IsTranslucent())
  {
    return this->Particles;
  }
  if (!this->AllParticles)
  {
    this->AllParticles = hop::GhostParticles::Gather(
      this->OwnParticles, vtkMultiProcessController::GetGlobalController());
  }
  return this->AllParticles;
}

//------------------------------------------------------------------------------
bool vtkSurfaceSplatRepresentation::IsTranslucent()
{
  vtkScalarsToColors* table = this->Mapper->GetLookupTable();
  const bool blocks = std::any_of(this->Blocks.Opacities.begin(), this->Blocks.Opacities.end(),
    [](const auto& block) { return block.second < 1.; });
  vtkProperty* backface = this->Actor->GetBackfaceProperty();
  return blocks || this->Actor->GetProperty()->GetOpacity() < 1. ||
    (backface && backface->GetOpacity() < 1.) ||
    (this->Mapper->GetScalarVisibility() && table && !table->IsOpaque());
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatRepresentation::UpdateColoring()
{
  vtkInformation* info = this->GetInputArrayInformation(0);
  const char* name = info && info->Has(vtkDataObject::FIELD_NAME())
    ? info->Get(vtkDataObject::FIELD_NAME())
    : nullptr;
  if (!name || !name[0] || !info->Has(vtkDataObject::FIELD_ASSOCIATION()))
  {
    this->Mapper->SetScalarVisibility(false);
    this->Mapper->SelectColorArray(static_cast<const char*>(nullptr));
    return;
  }
  this->Mapper->SetScalarVisibility(true);
  this->Mapper->SelectColorArray(name);
  this->Mapper->SetUseLookupTableScalarRange(true);
  switch (info->Get(vtkDataObject::FIELD_ASSOCIATION()))
  {
    case vtkDataObject::FIELD_ASSOCIATION_CELLS:
      this->Mapper->SetScalarMode(VTK_SCALAR_MODE_USE_CELL_FIELD_DATA);
      break;
    case vtkDataObject::FIELD_ASSOCIATION_NONE:
      // Merged blocks have one number a cell.
      this->Mapper->SetScalarMode(name == std::string(hop::SplatInput::BlockNumberName)
          ? VTK_SCALAR_MODE_USE_CELL_FIELD_DATA
          : VTK_SCALAR_MODE_USE_FIELD_DATA);
      this->Mapper->SetFieldDataTupleId(0);
      break;
    case vtkDataObject::FIELD_ASSOCIATION_POINTS:
    default: // particles have no other arrays
      this->Mapper->SetScalarMode(VTK_SCALAR_MODE_USE_POINT_FIELD_DATA);
  }
}

//------------------------------------------------------------------------------
// Gives the backface property all that both sides have in common.
void vtkSurfaceSplatRepresentation::UpdateBackface()
{
  vtkProperty* property = this->Actor->GetProperty();
  this->Backface->SetAmbient(property->GetAmbient());
  this->Backface->SetDiffuse(property->GetDiffuse());
  this->Backface->SetSpecular(property->GetSpecular());
  this->Backface->SetSpecularColor(property->GetSpecularColor());
  this->Backface->SetSpecularPower(property->GetSpecularPower());
}

//------------------------------------------------------------------------------
bool vtkSurfaceSplatRepresentation::AddToView(vtkView* view)
{
  auto* renderView = vtkPVRenderView::SafeDownCast(view);
  if (!renderView)
  {
    return false;
  }
  renderView->GetRenderer()->AddActor(this->Actor);
  renderView->RegisterPropForHardwareSelection(this, this->Actor);
  return this->Superclass::AddToView(view);
}

bool vtkSurfaceSplatRepresentation::RemoveFromView(vtkView* view)
{
  auto* renderView = vtkPVRenderView::SafeDownCast(view);
  if (!renderView)
  {
    return false;
  }
  renderView->GetRenderer()->RemoveActor(this->Actor);
  renderView->UnRegisterPropForHardwareSelection(this, this->Actor);
  return this->Superclass::RemoveFromView(view);
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatRepresentation::SetVisibility(bool visible)
{
  this->Actor->SetVisibility(visible);
  this->Superclass::SetVisibility(visible);
}

vtkDataObject* vtkSurfaceSplatRepresentation::GetRenderedDataObject(int)
{
  return this->ArraysToColorBy;
}

vtkActor* vtkSurfaceSplatRepresentation::GetActor()
{
  return this->Actor;
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatRepresentation::AddBlockSelector(const char* selector)
{
  if (selector && this->Blocks.Drawn.insert(selector).second)
  {
    this->MarkModified();
  }
}

void vtkSurfaceSplatRepresentation::RemoveAllBlockSelectors()
{
  if (!this->Blocks.Drawn.empty())
  {
    this->Blocks.Drawn.clear();
    this->MarkModified();
  }
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatRepresentation::SetBlockColor(
  const char* selector, double r, double g, double b)
{
  if (selector)
  {
    this->Blocks.Colors.push_back({ selector, { r, g, b } });
    this->MarkModified();
  }
}

void vtkSurfaceSplatRepresentation::RemoveAllBlockColors()
{
  if (!this->Blocks.Colors.empty())
  {
    this->Blocks.Colors.clear();
    this->MarkModified();
  }
}

void vtkSurfaceSplatRepresentation::SetBlockOpacity(const char* selector, double opacity)
{
  if (selector)
  {
    this->Blocks.Opacities.push_back({ selector, opacity });
    this->MarkModified();
  }
}

void vtkSurfaceSplatRepresentation::RemoveAllBlockOpacities()
{
  if (!this->Blocks.Opacities.empty())
  {
    this->Blocks.Opacities.clear();
    this->MarkModified();
  }
}

void vtkSurfaceSplatRepresentation::SetBlockColorsDistinctValues(int count)
{
  const unsigned int numbers = std::max(count, 1);
  if (numbers != this->Blocks.DistinctNumbers)
  {
    this->Blocks.DistinctNumbers = numbers;
    this->MarkModified();
  }
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatRepresentation::SetMode(int mode)
{
  this->Mapper->SetMode(mode);
}

void vtkSurfaceSplatRepresentation::SetSharpness(double sharpness)
{
  this->Mapper->SetSharpness(sharpness);
}

void vtkSurfaceSplatRepresentation::SetInterpolateScalarsBeforeMapping(int interpolate)
{
  this->Mapper->SetInterpolateScalarsBeforeMapping(interpolate);
}

void vtkSurfaceSplatRepresentation::SetRadiusArrayName(const char* name)
{
  this->Mapper->SetRadiusArrayName(name);
  this->MarkModified(); // another radius reaches other ghosts
}

void vtkSurfaceSplatRepresentation::SetRadiusScale(double scale)
{
  this->Mapper->SetRadiusScale(scale);
  this->MarkModified(); // another radius reaches other ghosts
}

void vtkSurfaceSplatRepresentation::SetRadius(double radius)
{
  this->Mapper->SetRadius(radius);
  this->MarkModified(); // another radius reaches other ghosts
}

void vtkSurfaceSplatRepresentation::SetColorByNormalDirection(bool on)
{
  this->Mapper->SetColorByNormalDirection(on);
}

void vtkSurfaceSplatRepresentation::SetOutwardColor(double r, double g, double b)
{
  this->Mapper->SetOutwardColor(r, g, b);
}

void vtkSurfaceSplatRepresentation::SetInwardColor(double r, double g, double b)
{
  this->Mapper->SetInwardColor(r, g, b);
}

void vtkSurfaceSplatRepresentation::SetLookupTable(vtkScalarsToColors* table)
{
  this->Mapper->SetLookupTable(table);
}

void vtkSurfaceSplatRepresentation::SetRepresentation(const char* name)
{
  this->Actor->GetProperty()->SetEdgeVisibility(name && name == std::string("Surface With Edges"));
}

void vtkSurfaceSplatRepresentation::SetEdgeColor(double r, double g, double b)
{
  this->Actor->GetProperty()->SetEdgeColor(r, g, b);
}

void vtkSurfaceSplatRepresentation::SetLineWidth(double value)
{
  this->Actor->GetProperty()->SetLineWidth(static_cast<float>(value));
}

void vtkSurfaceSplatRepresentation::SetMapScalars(int map)
{
  this->Mapper->SetColorMode(map ? VTK_COLOR_MODE_MAP_SCALARS : VTK_COLOR_MODE_DIRECT_SCALARS);
}

void vtkSurfaceSplatRepresentation::SetBackfaceRepresentation(int sides)
{
  constexpr int followFrontface = 400; // the values of ParaView's surface representation
  constexpr int onlyOutward = 401;
  constexpr int onlyInward = 402;
  this->Actor->GetProperty()->SetBackfaceCulling(sides == onlyOutward);
  this->Actor->GetProperty()->SetFrontfaceCulling(sides == onlyInward);
  this->Actor->SetBackfaceProperty(sides < followFrontface ? this->Backface.Get() : nullptr);
}

void vtkSurfaceSplatRepresentation::SetBackfaceAmbientColor(double r, double g, double b)
{
  this->Backface->SetAmbientColor(r, g, b);
}

void vtkSurfaceSplatRepresentation::SetBackfaceDiffuseColor(double r, double g, double b)
{
  this->Backface->SetDiffuseColor(r, g, b);
}

void vtkSurfaceSplatRepresentation::SetBackfaceOpacity(double value)
{
  this->Backface->SetOpacity(value);
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatRepresentation::SetAmbient(double value)
{
  this->Actor->GetProperty()->SetAmbient(value);
}

void vtkSurfaceSplatRepresentation::SetAmbientColor(double r, double g, double b)
{
  this->Actor->GetProperty()->SetAmbientColor(r, g, b);
}

void vtkSurfaceSplatRepresentation::SetDiffuse(double value)
{
  this->Actor->GetProperty()->SetDiffuse(value);
}

void vtkSurfaceSplatRepresentation::SetDiffuseColor(double r, double g, double b)
{
  this->Actor->GetProperty()->SetDiffuseColor(r, g, b);
}

void vtkSurfaceSplatRepresentation::SetSpecular(double value)
{
  this->Actor->GetProperty()->SetSpecular(value);
}

void vtkSurfaceSplatRepresentation::SetSpecularColor(double r, double g, double b)
{
  this->Actor->GetProperty()->SetSpecularColor(r, g, b);
}

void vtkSurfaceSplatRepresentation::SetSpecularPower(double value)
{
  this->Actor->GetProperty()->SetSpecularPower(value);
}

void vtkSurfaceSplatRepresentation::SetPointSize(double value)
{
  this->Actor->GetProperty()->SetPointSize(static_cast<float>(value));
}

void vtkSurfaceSplatRepresentation::SetOpacity(double value)
{
  this->Actor->GetProperty()->SetOpacity(value);
}

void vtkSurfaceSplatRepresentation::SetInterpolation(int value)
{
  this->Actor->GetProperty()->SetInterpolation(value);
}

void vtkSurfaceSplatRepresentation::SetRoughness(double value)
{
  this->Actor->GetProperty()->SetRoughness(value);
}

void vtkSurfaceSplatRepresentation::SetMetallic(double value)
{
  this->Actor->GetProperty()->SetMetallic(value);
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatRepresentation::SetPosition(double x, double y, double z)
{
  this->Actor->SetPosition(x, y, z);
}

void vtkSurfaceSplatRepresentation::SetScale(double x, double y, double z)
{
  this->Actor->SetScale(x, y, z);
}

void vtkSurfaceSplatRepresentation::SetOrientation(double x, double y, double z)
{
  this->Actor->SetOrientation(x, y, z);
}

void vtkSurfaceSplatRepresentation::SetOrigin(double x, double y, double z)
{
  this->Actor->SetOrigin(x, y, z);
}

void vtkSurfaceSplatRepresentation::SetUserTransform(const double matrix[16])
{
  vtkNew<vtkTransform> transform;
  transform->SetMatrix(matrix);
  this->Actor->SetUserTransform(transform);
}

void vtkSurfaceSplatRepresentation::SetPickable(int pickable)
{
  this->Actor->SetPickable(pickable);
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto print = [&os, indent](const char* name, const double* v, int size)
  {
    os << indent << name << ":";
    for (int c = 0; c < size; ++c)
    {
      os << " " << v[c];
    }
    os << "\n";
  };
  vtkProperty* property = this->Actor->GetProperty();
  const char* radiusName = this->Mapper->GetRadiusArrayName();
  os << indent << "BlockSelectors:";
  for (const std::string& selector : this->Blocks.Drawn)
  {
    os << " " << selector;
  }
  os << "\n";
  for (const auto& [selector, color] : this->Blocks.Colors)
  {
    print(("BlockColor " + selector).c_str(), color.data(), 3);
  }
  for (const auto& [selector, opacity] : this->Blocks.Opacities)
  {
    os << indent << "BlockOpacity " << selector << ": " << opacity << "\n";
  }
  os << indent << "BlockColorsDistinctValues: " << this->Blocks.DistinctNumbers << "\n";
  os << indent << "Mode: " << this->Mapper->GetMode() << "\n";
  os << indent << "Sharpness: " << this->Mapper->GetSharpness() << "\n";
  os << indent
     << "InterpolateScalarsBeforeMapping: " << this->Mapper->GetInterpolateScalarsBeforeMapping()
     << "\n";
  os << indent << "RadiusArrayName: " << (radiusName ? radiusName : "(none)") << "\n";
  os << indent << "RadiusScale: " << this->Mapper->GetRadiusScale() << "\n";
  os << indent << "Radius: " << this->Mapper->GetRadius() << "\n";
  os << indent << "ColorByNormalDirection: " << this->Mapper->GetColorByNormalDirection() << "\n";
  print("OutwardColor", this->Mapper->GetOutwardColor(), 3);
  print("InwardColor", this->Mapper->GetInwardColor(), 3);
  os << indent << "ColorMode: " << this->Mapper->GetColorModeAsString() << "\n";
  os << indent << "BackfaceCulling: " << property->GetBackfaceCulling() << "\n";
  os << indent << "FrontfaceCulling: " << property->GetFrontfaceCulling() << "\n";
  os << indent << "BackfaceProperty: " << (this->Actor->GetBackfaceProperty() ? "On" : "Off")
     << "\n";
  print("BackfaceAmbientColor", this->Backface->GetAmbientColor(), 3);
  print("BackfaceDiffuseColor", this->Backface->GetDiffuseColor(), 3);
  os << indent << "BackfaceOpacity: " << this->Backface->GetOpacity() << "\n";
  os << indent << "Ambient: " << property->GetAmbient() << "\n";
  print("AmbientColor", property->GetAmbientColor(), 3);
  os << indent << "Diffuse: " << property->GetDiffuse() << "\n";
  print("DiffuseColor", property->GetDiffuseColor(), 3);
  os << indent << "Specular: " << property->GetSpecular() << "\n";
  print("SpecularColor", property->GetSpecularColor(), 3);
  os << indent << "SpecularPower: " << property->GetSpecularPower() << "\n";
  os << indent << "PointSize: " << property->GetPointSize() << "\n";
  os << indent
     << "Representation: " << (property->GetEdgeVisibility() ? "Surface With Edges" : "Surface")
     << "\n";
  print("EdgeColor", property->GetEdgeColor(), 3);
  os << indent << "LineWidth: " << property->GetLineWidth() << "\n";
  os << indent << "Opacity: " << property->GetOpacity() << "\n";
  os << indent << "Interpolation: " << property->GetInterpolationAsString() << "\n";
  os << indent << "Roughness: " << property->GetRoughness() << "\n";
  os << indent << "Metallic: " << property->GetMetallic() << "\n";
  print("Position", this->Actor->GetPosition(), 3);
  print("Scale", this->Actor->GetScale(), 3);
  print("Orientation", this->Actor->GetOrientation(), 3);
  print("Origin", this->Actor->GetOrigin(), 3);
  vtkNew<vtkMatrix4x4> userTransform; // the identity where there is none
  if (vtkMatrix4x4* matrix = this->Actor->GetUserMatrix())
  {
    userTransform->DeepCopy(matrix);
  }
  print("UserTransform", userTransform->GetData(), 16);
  os << indent << "Pickable: " << this->Actor->GetPickable() << "\n";
}
