/**
 * @class ParticleInputs
 * @brief hides particles in ParaView's window when a filter has cut them
 *
 * On the first *Apply* of *Clip*, *Threshold* and others ParaView hides an opaque input of the representation *Surface*,
 * which would hide the result, and leaves all others visible. An opaque *Surface Splats* hides the result as well.
 */
#pragma once

#include <QObject>

class ParticleInputs
{
public:
  /** ParaView calls both: when it has loaded the plugin, and at its end. */
  void startup();
  void shutdown();

private:
  QObject Listener; ///< the end of all connections
};
