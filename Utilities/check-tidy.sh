#!/usr/bin/env bash
# What clang-tidy finds in the sources (.clang-tidy says what it looks for); they have to be built before.
#   bash Utilities/check-tidy.sh [--all] [BUILD_FOLDER]
# Without --all the checks of the static analyzer, which take three times as long, and the tests' sources are left out.
# Exit code 77: no clang-tidy 14 here (Debian 12's; other versions find other things), or nothing was built.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

folders=(Common Filters Rendering Plugin)
options=(--quiet --warnings-as-errors='*' --extra-arg=-Wno-unknown-warning-option
  --extra-arg=-Wno-ignored-optimization-argument)
if [ "${1:-}" = --all ]; then
  folders+=(Testing)
  shift
else
  options+=(--checks=-clang-analyzer-*)
fi
build=${1:-build}

tool=$(command -v clang-tidy-14 || command -v clang-tidy || true)
if [ -z "$tool" ] || ! "$tool" --version | grep -q 'version 14\.'; then
  echo "clang-tidy 14 is not installed: nothing checked"
  exit 77
fi
[ -e "$build/compile_commands.json" ] || { echo "$build/compile_commands.json is missing: nothing checked"; exit 77; }

# Only what is built: the kernels of instruction sets of other processors, for example, are not.
find "${folders[@]}" \( -name '*.cpp' -o -name '*.cxx' \) | sort | while read -r file; do
  if grep -qF "\"$PWD/$file\"" "$build/compile_commands.json"; then printf '%s\0' "$file"; fi
done | xargs -0 --no-run-if-empty -n 1 -P "$(nproc)" "$tool" -p "$build" "${options[@]}" 2> >(grep -v 'warnings\? generated' >&2)
