#pragma once

#include "Isolation/PieceTests.h"
#include "Isolation/SurfaceBox.h"

namespace hop
{

/// The box of a piece, certified if the piece is.
SurfaceBox boxOf(const Piece& piece, const PieceTests& tests);

/// The box of a piece for each of two sheets that is in it, with its values.
void appendSheetPair(const Piece& piece, const SheetPair& pair, std::vector<SurfaceBox>& boxes);

/// All of a part of an element, in place of what in it was left undecided: nothing is known of what the
/// surface does there.
SurfaceBox boxOfUnknown(const Piece& part, const PieceTests& tests);

} // namespace hop
