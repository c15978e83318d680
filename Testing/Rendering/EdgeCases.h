// Surfaces on which boundary curves and creases lie near to each other: strips, slivers, caps, corners, tips.
#pragma once

#include "SurfaceCases.h"

// Names are KIND:SIZE, the size in spacings of the filter (0.02 world units):
//   strip     flat, straight, that wide
//   wave      the same, but bent across and along
//   tetstrip, tetwave  the same in tetrahedra, whose corners lie on the bent strip
//   taper     a strip whose width falls from three sizes to a tenth of one
//   shaving   what a slanted plane cuts from an edge of a cube, that wide
//   cap       what a face of the cube leaves of a sphere: a disc of that radius
//   corner    a triangle with sides of that length, in a corner of a cube
//   notch     a plane, with a slope of 0.28 SIZE, around an edge of the domain that is turned inwards
//   cone      a double cone; the size moves its tip from a corner of the mesh
//   step      a plane that jumps by that height
//   ledge     a roof whose ridge is cut off by a facet that wide
//   bevel     the same, but almost smooth on one side of the facet: 27 and 6 degrees
//   sliver    a ledge, whose facet tapers from that width to a twentieth of it
//   fan       the tip of a pyramid with SIZE sides, each an element: as many creases meet
//   pleats    the same with every second edge folded in
//   facets    a sphere in linear tetrahedra with edges of that length: creases everywhere
// Throws std::invalid_argument for other names.
SurfaceCase MakeEdgeCase(const std::string& name);

// Cases of all kinds, with sizes of 0.3 to 3 spacings.
const std::vector<std::string>& EdgeCaseNames();
