#!/usr/bin/env bash
# Make a Debian package of the committed state in a clean root of each release, install it in another one, use it,
# remove it.
#   bash Utilities/test-packages.sh [RELEASE ...]
# RELEASE: bookworm, trixie, sid; all three unless named. The packages stay in build-packages/. clean-root.sh says what
# is needed.
set -euo pipefail
project=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
. "$project/Utilities/clean-root.sh"
[ $# -gt 0 ] || set -- bookworm trixie sid

work=$(mktemp -d)
trap 'rm -rf --one-file-system "$work"' EXIT

build_package() { # ROOT FOLDER
  git clone --quiet --no-hardlinks "$project" "$1/project"
  in_root "$1" bash -c 'cd /project && bash Utilities/setup.sh -DBUILD_TESTING=OFF && cd build && cpack -G DEB'
  mkdir -p "$2" && cp "$1"/project/build/*.deb "$2"
}

use_package() { # ROOT FOLDER
  mkdir "$1/package"
  cp "$2"/*.deb "$project/Utilities/use-package.sh" "$project/Testing/Data/mfem_hex1_p8.vtu" "$1/package"
  in_root "$1" DEBIAN_FRONTEND=noninteractive bash /package/use-package.sh
}

status=0
for release in "$@"; do
  echo "== $release"
  log=$work/$release.log
  packages=$project/build-packages/$release
  rm -rf "$packages"
  if make_root "$release" "$work/$release" && cp -a "$work/$release" "$work/$release-user" &&
    { build_package "$work/$release" "$packages" && use_package "$work/$release-user" "$packages"; } </dev/null >"$log" 2>&1; then
    summary+=("$release: passed, $(ls "$packages")")
  else
    summary+=("$release: FAILED") status=1
    tail -n 60 "$log" 2>/dev/null || true
  fi
  rm -rf --one-file-system "${work:?}/$release" "${work:?}/$release-user"
done
printf '%s\n' "" "${summary[@]}"
exit "$status"
