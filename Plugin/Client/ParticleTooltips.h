/**
 * @class ParticleTooltips
 * @brief leaves what only the renderer reads out of the tooltips of particles
 *
 * *Hover Points On* and *Interactive Select Points* list all point arrays of the particle under the mouse, hidden ones too:
 * the renderer's many numbers made a line longer than the screen.
 */
#pragma once

#include <QObject>

class ParticleTooltips : public QObject
{
public:
  /** ParaView calls both: when it has loaded the plugin, and at its end. */
  void startup();
  void shutdown();

  bool eventFilter(QObject* object, QEvent* event) override;
};
