#!/usr/bin/env bash
# Install what is missing, build, and draw the isosurface of a solver's file.
#   bash Utilities/demo.sh [FILE.vtu] [OUT.png] [--array NAME] [--isovalue C ...] [--help]
# Without FILE: one hexahedron of order 8 from Testing/Data; without OUT: isosurface.png in the current folder.
set -euo pipefail

project=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
bash "$project/Utilities/setup.sh" -DBUILD_TESTING=OFF

name=HighOrderParticleIsosurface
echo "== drawing"
exec bash "$project/Utilities/with-display.sh" \
  /usr/bin/pvbatch --force-offscreen-rendering "$project/Utilities/demo.py" "$project/build/lib/$name/$name.so" "$@"
