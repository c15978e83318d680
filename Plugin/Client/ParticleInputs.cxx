#include "ParticleInputs.h"

#include "pqApplicationCore.h"
#include "pqDataRepresentation.h"
#include "pqOutputPort.h"
#include "pqPipelineFilter.h"
#include "pqServerManagerModel.h"
#include "pqView.h"
#include "vtkNew.h"
#include "vtkSMParaViewPipelineControllerWithRendering.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMViewProxy.h"

#include <memory>
#include <string>

namespace
{
/** The value of a filter's XML hint `Visibility replace_input`: hide inputs that hide the result. */
constexpr int HideIfOpaque = 2;

bool IsOpaqueSplats(pqDataRepresentation* shown)
{
  const vtkSMPropertyHelper kind(shown->getProxy(), "Representation", /*quiet=*/true);
  const vtkSMPropertyHelper opacity(shown->getProxy(), "Opacity", /*quiet=*/true);
  const char* name = kind.GetNumberOfElements() > 0 ? kind.GetAsString() : nullptr;
  const bool isSplats =
    name && std::string(name).rfind("Surface Splats", 0) == 0; // with or without edges
  return isSplats && opacity.GetAsDouble() >= 1.;
}

void HideInputs(pqPipelineFilter* filter, pqView* view)
{
  if (filter->replaceInput() != HideIfOpaque)
  {
    return;
  }
  const vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
  for (pqOutputPort* input : filter->getAllInputs())
  {
    pqDataRepresentation* shown = input->getRepresentation(view);
    if (shown && shown->isVisible() && IsOpaqueSplats(shown))
    {
      controller->Hide(input->getSourceProxy(), input->getPortNumber(), view->getViewProxy());
    }
  }
}

// A filter that is shown before its first Apply ends is shown by it; states and scripts make filters that are applied
// already. The inputs are hidden at the end of Apply, so that ParaView's trace says so.
void OnShown(pqRepresentation* representation, pqView* view)
{
  auto* shown = qobject_cast<pqDataRepresentation*>(representation);
  auto* filter = shown ? qobject_cast<pqPipelineFilter*>(shown->getInput()) : nullptr;
  if (!filter || filter->modifiedState() != pqProxy::UNINITIALIZED)
  {
    return;
  }
  const auto once = std::make_shared<QMetaObject::Connection>();
  *once = QObject::connect(filter, &pqProxy::modifiedStateChanged, view,
    [once, filter, view]
    {
      QObject::disconnect(*once);
      HideInputs(filter, view);
    });
}
}

void ParticleInputs::startup()
{
  const auto watch = [this](pqView* view)
  {
    QObject::connect(view, &pqView::representationAdded, &this->Listener,
      [view](pqRepresentation* representation) { OnShown(representation, view); });
  };
  auto* model = pqApplicationCore::instance()->getServerManagerModel();
  QObject::connect(model, &pqServerManagerModel::viewAdded, &this->Listener, watch);
  for (pqView* view : model->findItems<pqView*>())
  {
    watch(view);
  }
}

void ParticleInputs::shutdown()
{
  auto* model = pqApplicationCore::instance()->getServerManagerModel();
  model->disconnect(&this->Listener);
  for (pqView* view : model->findItems<pqView*>())
  {
    view->disconnect(&this->Listener);
  }
}
