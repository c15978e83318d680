#include "OpenGL/Functions.h" // before everything that may include an OpenGL header

#include "Drawing/SplatView.h"

#include "vtkOpenGLActor.h"
#include "vtkOpenGLCamera.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hop
{
//------------------------------------------------------------------------------
void SplatView::Update(vtkRenderer* renderer, vtkActor* actor, const std::array<double, 3>& origin,
  const double bounds[6])
{
  auto* camera = static_cast<vtkOpenGLCamera*>(renderer->GetActiveCamera());
  vtkMatrix4x4 *wcvc, *vcdc, *wcdc, *mcwc;
  vtkMatrix3x3 *normalWCVC, *normalMCWC;
  camera->GetKeyMatrices(renderer, wcvc, normalWCVC, vcdc, wcdc);
  static_cast<vtkOpenGLActor*>(actor)->GetKeyMatrices(mcwc, normalMCWC);

  vtkNew<vtkMatrix4x4> shift;
  for (int axis = 0; axis < 3; ++axis)
  {
    shift->SetElement(3, axis, origin[axis]);
  }
  vtkNew<vtkMatrix4x4> toWorld;
  vtkMatrix4x4::Multiply4x4(shift, mcwc, toWorld);
  vtkMatrix4x4::Multiply4x4(toWorld, wcvc, this->MCVC);
  vtkMatrix4x4::Multiply4x4(toWorld, wcdc, this->MCDC);
  this->VCDC->DeepCopy(vcdc);
  this->Parallel = camera->GetParallelProjection() != 0;

  // Normals are transformed by the inverse transpose; MCVC is transposed already.
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      this->NormalMatrix->SetElement(column, row, this->MCVC->GetElement(row, column));
    }
  }
  this->NormalMatrix->Invert();

  glGetIntegerv(GL_VIEWPORT, this->Viewport.data());
  this->FindEye();
  this->FindRectangle(origin, bounds);
}

//------------------------------------------------------------------------------
void SplatView::FindEye()
{
  vtkNew<vtkMatrix4x4> fromView;
  vtkMatrix4x4::Transpose(this->MCVC, fromView);
  fromView->Invert();
  const double inView[4] = { 0., 0., this->Parallel ? 1. : 0., this->Parallel ? 0. : 1. };
  double found[4];
  fromView->MultiplyPoint(inView, found);
  const double scale = this->Parallel ? 1. : 1. / found[3];
  for (int i = 0; i < 4; ++i)
  {
    this->Eye[i] = static_cast<float>(scale * found[i]);
  }
}

//------------------------------------------------------------------------------
void SplatView::FindRectangle(const std::array<double, 3>& origin, const double bounds[6])
{
  vtkNew<vtkMatrix4x4> toDevice;
  vtkMatrix4x4::Transpose(this->MCDC, toDevice);
  this->NearestDepth = std::numeric_limits<double>::infinity();
  double low[2] = { 1., 1. };
  double high[2] = { -1., -1. };
  for (int corner = 0; corner < 8; ++corner)
  {
    double place[4] = { 0., 0., 0., 1. };
    for (int axis = 0; axis < 3; ++axis)
    {
      place[axis] = bounds[2 * axis + ((corner >> axis) & 1)] - origin[axis];
    }
    toDevice->MultiplyPoint(place, place);
    const bool beforeTheEye = place[3] > 0.;
    this->NearestDepth = std::min(this->NearestDepth, place[3]); // 1 for parallel projections
    for (int axis = 0; axis < 2; ++axis)
    {
      low[axis] = beforeTheEye ? std::min(low[axis], place[axis] / place[3]) : -1.;
      high[axis] = beforeTheEye ? std::max(high[axis], place[axis] / place[3]) : 1.;
    }
    if (!beforeTheEye)
    {
      break; // the box reaches behind the eye: its picture may be anywhere
    }
  }
  // Pixels around the box. Splats are enlarged to LeastPixels of the primitives and rounded to whole pixels, together
  // less than this; a larger margin looks at more empty pixels.
  constexpr double margin = 2.;
  for (int axis = 0; axis < 2; ++axis)
  {
    const double size = this->Viewport[2 + axis];
    const double first = std::floor(0.5 * size * (1. + std::max(low[axis], -1.)) - margin);
    const double last = std::ceil(0.5 * size * (1. + std::min(high[axis], 1.)) + margin);
    const double begin = std::clamp(first, 0., size);
    this->Rectangle[axis] = static_cast<int>(begin);
    this->Rectangle[2 + axis] = static_cast<int>(std::clamp(last, begin, size) - begin);
  }
}

double SplatView::GetScale() const
{
  return std::cbrt(std::abs(1. / this->NormalMatrix->Determinant()));
}

//------------------------------------------------------------------------------
double SplatView::GetPixelSize() const
{
  // VCDC[1][1] takes half the viewport's height, at distance 1, to 1.
  return 2. / (std::abs(this->VCDC->GetElement(1, 1)) * this->Viewport[3]);
}

double SplatView::GetLargestPixels(double length) const
{
  double largest = 0.; // length (VC) of a unit vector along an axis
  for (int axis = 0; axis < 3; ++axis)
  {
    const double* row = this->MCVC->GetData() + 4 * axis;
    largest = std::max(largest, std::hypot(row[0], row[1], row[2]));
  }
  return this->NearestDepth > 0. ? largest * length / (this->GetPixelSize() * this->NearestDepth)
                                 : std::numeric_limits<double>::infinity();
}

namespace
{
template <typename Matrix>
void SetMatrix(vtkShaderProgram* program, const char* name, Matrix* matrix)
{
  if (program->IsUniformUsed(name))
  {
    program->SetUniformMatrix(name, matrix);
  }
}
}

//------------------------------------------------------------------------------
void SplatView::SetUniforms(vtkShaderProgram* program) const
{
  SetMatrix(program, "splatMCVC", this->MCVC.Get());
  SetMatrix(program, "splatVCDC", this->VCDC.Get());
  SetMatrix(program, "splatNormalMatrix", this->NormalMatrix.Get());
  const float viewport[4] = { static_cast<float>(this->Viewport[0]),
    static_cast<float>(this->Viewport[1]), static_cast<float>(this->Viewport[2]),
    static_cast<float>(this->Viewport[3]) };
  // Uniforms that a program lacks are ignored.
  program->SetUniform4f("splatEyeMC", this->Eye.data());
  program->SetUniformi("splatParallel", this->Parallel ? 1 : 0);
  program->SetUniformf("splatPixel", static_cast<float>(this->GetPixelSize()));
  program->SetUniform4f("splatViewport", viewport);
}

//------------------------------------------------------------------------------
Culling::Camera SplatView::GetCamera() const
{
  return { glm::mat4(glm::make_mat4(this->MCVC->GetData())),
    glm::mat4(glm::make_mat4(this->VCDC->GetData())), this->Parallel, this->GetWidth(),
    this->GetHeight() };
}

//------------------------------------------------------------------------------
void SplatView::AppendTo(std::vector<double>& key) const
{
  key.insert(key.end(), this->MCVC->GetData(), this->MCVC->GetData() + 16);
  key.insert(key.end(), this->VCDC->GetData(), this->VCDC->GetData() + 16);
  key.insert(key.end(), this->Viewport.begin(), this->Viewport.end());
  key.insert(key.end(), this->Rectangle.begin(), this->Rectangle.end());
}
}
