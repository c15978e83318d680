#!/usr/bin/env bash
# Is the C++ formatted as .clang-format says? With --fix: make it so. Exit code 77: no clang-format here.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

command -v clang-format >/dev/null || { echo "clang-format is not installed: nothing checked"; exit 77; }
mode=(--dry-run --Werror)
[ "${1:-}" != --fix ] || mode=(-i)
find Filters Rendering Plugin Testing \( -name '*.h' -o -name '*.cxx' -o -name '*.cpp' -o -name '*.hpp' \) -print0 |
  xargs -0 --no-run-if-empty clang-format "${mode[@]}"
