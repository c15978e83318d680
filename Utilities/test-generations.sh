#!/usr/bin/env bash
# Build and test the committed state in clean Debian roots, one ParaView generation after the other.
#   bash Utilities/test-generations.sh [RELEASE ...]
# RELEASE: bookworm (ParaView 5.11), trixie (5.13), sid (6.1); all three unless named. VTK_ALONE=1 in
# the environment tests with VTK alone instead. Needs root, debootstrap and the network; each root
# takes 5 GB below ${TMPDIR:-/tmp} and goes when its tests are done.
set -euo pipefail

project=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
mirror=${DEBIAN_MIRROR:-http://deb.debian.org/debian}
[ $# -gt 0 ] || set -- bookworm trixie sid

[ "$(id -u)" -eq 0 ] || { echo "error: not root; chroot and debootstrap ask for it" >&2; exit 2; }
command -v debootstrap >/dev/null || { echo "error: no debootstrap; apt-get install debootstrap" >&2; exit 2; }

work=$(mktemp -d)
trap 'rm -rf --one-file-system "$work"' EXIT

make_root() { # RELEASE ROOT
  debootstrap --variant=minbase "$1" "$2" "$mirror" >"$work/$1.debootstrap" ||
    { tail -n 5 "$work/$1.debootstrap" >&2; return 1; }
  cp /etc/resolv.conf "$2/etc/resolv.conf"
  # What apt needs to be told here (a proxy, a mirror that lags behind) it needs to be told there.
  cp -n /etc/apt/apt.conf.d/* "$2/etc/apt/apt.conf.d/"
  git clone --quiet --no-hardlinks "$project" "$2/project"
}

test_in() { # ROOT: its mounts are gone with the command
  unshare --mount --propagation private bash -c '
    mount -t proc proc "$1/proc" && mkdir -p "$1/dev/shm" && mount -t tmpfs tmpfs "$1/dev/shm"
    mount -t sysfs -o ro sysfs "$1/sys" # without it MPI complains on standard output
    exec chroot "$1" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 \
      HOP_WITH_PARAVIEW="$2" bash /project/Utilities/test.sh' _ "$1" "$([ -n "${VTK_ALONE:-}" ] && echo OFF || echo ON)"
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
