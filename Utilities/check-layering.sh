#!/usr/bin/env bash
# The numerics stand alone: nothing in Filters/Core may include VTK or ParaView, or the modules above it; only
# headers of its own, of the standard library and of GLM.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../Filters/Core"

if grep -rnE '^[[:space:]]*#[[:space:]]*include' . |
  grep -vE '<(glm/.*|[a-z_0-9]+)>' |
  grep -vFf <(find . -type f -printf '"%f"\n"%P"\n'); then
  echo "error: Filters/Core must include headers of its own, the standard library's and GLM's only" >&2
  exit 1
fi
