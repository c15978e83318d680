#include "Topology/TopologyComparison.h"
