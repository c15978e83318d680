#!/usr/bin/env bash
# Is the C++ formatted as .clang-format says? With --fix: make it so.
# Exit code 77: no clang-format 14 here (Debian 12's; other versions format differently).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

tool=$(command -v clang-format-14 || command -v clang-format || true)
if [ -z "$tool" ] || ! "$tool" --version | grep -q 'version 14\.'; then
  echo "clang-format 14 is not installed: nothing checked"
  exit 77
fi
mode=(--dry-run --Werror)
[ "${1:-}" != --fix ] || mode=(-i)
find Common Filters Rendering Plugin Testing \( -name '*.h' -o -name '*.cxx' -o -name '*.cpp' \) -print0 |
  xargs -0 --no-run-if-empty "$tool" "${mode[@]}"
