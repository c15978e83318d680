#!/usr/bin/env bash
# The numerics stand alone: nothing in Filters/Core may include VTK or ParaView, or the modules above it.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

if grep -rnE '^[[:space:]]*#[[:space:]]*include[[:space:]]*[<"](vtk|pq)' Filters/Core; then
  echo "error: Filters/Core must not include VTK or ParaView headers" >&2
  exit 1
fi
