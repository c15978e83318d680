#!/usr/bin/env bash
# Make the plugin ready to use from this checkout: install what is missing (Debian 12 to sid), build into build/.
#   bash Utilities/setup.sh [CMAKE_OPTION ...]
# With -DBUILD_TESTING=OFF what only tests need is not installed.
# With HOP_WITH_PARAVIEW=OFF in the environment: filter and mapper for VTK alone, into build-vtk/.
# Asks for nothing but bash and apt-get, and for root or sudo only where a package is missing.
set -euo pipefail
case "${1:-}" in -h | --help) sed -n 2,6p "${BASH_SOURCE[0]}" && exit ;; esac

project=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
with_paraview=${HOP_WITH_PARAVIEW:-ON}
build=$project/build
[ "$with_paraview" = ON ] || build=$project/build-vtk

packages=(
  g++ cmake ninja-build libglm-dev
  xvfb # pictures where there is no display
)
testing=(libgtest-dev libbenchmark-dev doxygen)
paraview=(
  paraview paraview-dev python3-paraview python3-dev
  # paraview-dev's CMake files look these up, but its package does not depend on them.
  libglew-dev liblz4-dev liblzma-dev libdouble-conversion-dev libutfcpp-dev libopenmpi-dev
  libboost-dev libpugixml-dev libjpeg-dev libpng-dev libtiff-dev libfreetype-dev libgl2ps-dev
)
qt5=(qtbase5-dev qttools5-dev qttools5-dev-tools qtxmlpatterns5-dev-tools)
release=$(. /etc/os-release 2>/dev/null && echo "${VERSION_CODENAME:-}")
# The GUI's buttons are blank without Qt's plugin for SVG.
case "$release" in
  bookworm) paraview+=("${qt5[@]}" libqt5svg5) ;;
  forky | sid) paraview+=(libvtk9-dev qt6-base-dev qt6-tools-dev qt6-tools-dev-tools xsltproc qt6-svg-plugins) ;;
  *) paraview+=("${qt5[@]}" qt6-base-dev qt6-svg-plugins) ;; # trixie: its CMake files want 5, its GUI is 6
esac
[ "$release" != bookworm ] || testing+=(clang-format-14 clang-tidy-14)
if [ "$with_paraview" = ON ]; then
  packages+=("${paraview[@]}")
  testing+=(python3-pytest xdotool) # xdotool: mouse and keyboard of tests
else
  packages+=(libvtk9-dev libglew-dev)
fi
[[ " $* " = *" -DBUILD_TESTING=OFF "* ]] || packages+=("${testing[@]}")

say() { printf '== %s\n' "$*"; }
fail() { printf 'error: %s\n' "$*" >&2; exit 1; }

missing_packages() {
  local package
  for package in "${packages[@]}"; do
    [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || echo "$package"
  done
}

install_packages() { # PACKAGE ...
  command -v apt-get >/dev/null ||
    fail "this script installs Debian packages; elsewhere see 'Building' in README.md"
  local as_root=(env)
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null ||
      fail "not root and no sudo; have an administrator run: apt-get install --no-install-recommends $*"
    as_root=(sudo env)
  fi
  say "installing $# packages: $*"
  as_root+=(DEBIAN_FRONTEND=noninteractive apt-get -q -o Acquire::Retries=3 -o Dpkg::Use-Pty=0)
  "${as_root[@]}" update
  "${as_root[@]}" install -y --no-install-recommends "$@"
}

configure_and_build() { # CMAKE_OPTION ...
  local generator=()
  # A build folder keeps the generator it was made with.
  [ -e "$build/CMakeCache.txt" ] || generator=(-G Ninja)
  say "configuring"
  cmake -S "$project" -B "$build" "${generator[@]}" -DCMAKE_BUILD_TYPE=Release -DHOP_WITH_PARAVIEW="$with_paraview" "$@"
  say "building"
  cmake --build "$build" --parallel "$(nproc)"
}

mapfile -t missing < <(missing_packages)
[ "${#missing[@]}" -eq 0 ] || install_packages "${missing[@]}"
configure_and_build "$@"
