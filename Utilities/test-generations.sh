#!/usr/bin/env bash
# Build and test the committed state in clean Debian roots, one ParaView generation after the other.
#   bash Utilities/test-generations.sh [RELEASE ...]
# RELEASE: bookworm (ParaView 5.11), trixie (5.13), sid (6.1); all three unless named. VTK_ALONE=1 in
# the environment tests with VTK alone instead. clean-root.sh says what is needed; each root goes when its tests are done.
set -euo pipefail
project=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
. "$project/Utilities/clean-root.sh"
[ $# -gt 0 ] || set -- bookworm trixie sid

work=$(mktemp -d)
trap 'rm -rf --one-file-system "$work"' EXIT

test_in() { # ROOT
  git clone --quiet --no-hardlinks "$project" "$1/project"
  in_root "$1" HOP_WITH_PARAVIEW="$([ -n "${VTK_ALONE:-}" ] && echo OFF || echo ON)" bash /project/Utilities/test.sh
}

status=0
for release in "$@"; do
  echo "== $release"
  log=$work/$release.log
  if make_root "$release" "$work/$release" && test_in "$work/$release" </dev/null >"$log" 2>&1; then
    verdict=passed
  else
    verdict=FAILED status=1
    tail -n 60 "$log" 2>/dev/null || true
  fi
  summary+=("$release: $verdict, $(grep -a 'tests passed' "$log" || echo 'no tests ran')")
  rm -rf --one-file-system "${work:?}/$release"
done
printf '%s\n' "" "${summary[@]}"
exit "$status"
