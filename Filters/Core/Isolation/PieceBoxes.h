#pragma once

#include "Isolation/PieceTests.h"
#include "Isolation/SurfaceBox.h"

namespace hop
{

/// The box of a piece. It is certified if the piece is.
SurfaceBox boxOf(const Piece& piece, const PieceTests& tests);

/// Appends a box of the piece for each sheet of a pair that passes between the corners of the piece. Each box has the
/// values of its own sheet (SheetPair::Sheet::values).
/// \param pair in the reference coordinates of the piece
void appendBoxesOfPair(const Piece& piece, const SheetPair& pair, std::vector<SurfaceBox>& boxes);

/// The box of a part of an element that replaces the undecided pieces in it. Nothing is known of the surface there: the
/// box does not straddle, and has no proxy polygons.
SurfaceBox boxOfUndecidedPart(const Piece& part, const PieceTests& tests);

} // namespace hop
