#!/usr/bin/env bash
# Install what a build folder holds, build the example against it, run it: does an application get by?
#   run.sh CMAKE BUILD_FOLDER FILE.vtu ARRAY ISOVALUE
set -euo pipefail
cmake=$1 build=$2 && shift 2

work=$build/Testing/example
rm -rf "$work"
"$cmake" --install "$build" --prefix "$work/prefix" >/dev/null
generator=$(sed -n 's/^CMAKE_GENERATOR:INTERNAL=//p' "$build/CMakeCache.txt")
"$cmake" -G "$generator" -S "$(dirname "${BASH_SOURCE[0]}")" -B "$work/build" -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_PREFIX_PATH="$work/prefix"
"$cmake" --build "$work/build"
"$work/build/isosurface_picture" "$@" "$work/isosurface.png"

# An empty picture of that size compresses to 2 kB, a shaded surface does not.
size=$(stat -c %s "$work/isosurface.png")
[ "$size" -gt 20000 ] || { echo "error: the picture, of $size bytes, shows no surface" >&2; exit 1; }
