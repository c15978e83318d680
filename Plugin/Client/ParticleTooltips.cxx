#include "ParticleTooltips.h"

#include "Common/SplatColumns.h"

#include <QApplication>
#include <QCursor>
#include <QEvent>
#include <QLabel>
#include <QRegularExpression>
#include <QScreen>

#include <algorithm>

namespace
{
/** Beside the mouse, inside the screen. */
void Place(QLabel* tip)
{
  const QPoint fromMouse(2, 16); // pixels to the right and below, as Qt has them on most systems
  const QRect screen = tip->screen()->availableGeometry();
  const QPoint mouse = QCursor::pos();
  const bool hasRoomBelow = mouse.y() + fromMouse.y() + tip->height() <= screen.bottom();
  const int y = mouse.y() + (hasRoomBelow ? fromMouse.y() : -fromMouse.y() - tip->height());
  tip->move(std::min(mouse.x() + fromMouse.x(), screen.right() - tip->width()), y);
}

void Shorten(QLabel* tip)
{
  static const QRegularExpression line(QString("(\\n|<br\\s*/?>)\\s*(%1|%2):[^\\n<]*")
                                         .arg(hop::SplatColumnsArray, hop::CreaseColumnsArray));
  const QString text = tip->text();
  const QString shorter = QString(text).remove(line);
  if (shorter != text)
  {
    tip->setText(shorter);
    tip->resize(tip->sizeHint());
    Place(tip);
  }
}
}

void ParticleTooltips::startup()
{
  qApp->installEventFilter(this);
}

void ParticleTooltips::shutdown()
{
  qApp->removeEventFilter(this);
}

bool ParticleTooltips::eventFilter(QObject* object, QEvent* event)
{
  // A tooltip is shown, or, while it is shown, has got another text.
  if ((event->type() == QEvent::Show || event->type() == QEvent::Resize) &&
    object->inherits("QTipLabel"))
  {
    Shorten(static_cast<QLabel*>(object));
  }
  return QObject::eventFilter(object, event);
}
