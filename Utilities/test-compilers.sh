#!/usr/bin/env bash
# Build and test the numerics, without VTK and ParaView, as compilers other than GCC see them: Clang with vector types
# and without them (plain C++, as MSVC would take it). Warnings are errors.
#   bash Utilities/test-compilers.sh [CTEST_OPTION ...]
# Installs what is missing, as setup.sh does. Where Clang cannot be had, GCC without vector types. Builds into
# build-clang/, build-clang-portable/ or build-gcc-portable/.
set -euo pipefail
case "${1:-}" in -h | --help) sed -n 2,5p "${BASH_SOURCE[0]}" && exit ;; esac

project=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
say() { printf '== %s\n' "$*"; }
fail() { printf 'error: %s\n' "$*" >&2; exit 1; }

missing_packages() { # PACKAGE ...
  local package
  for package in "$@"; do
    [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || echo "$package"
  done
}

install_missing() { # PACKAGE ...: fails where they are not there afterwards
  local missing as_root=(env)
  mapfile -t missing < <(missing_packages "$@")
  [ "${#missing[@]}" -gt 0 ] || return 0
  command -v apt-get >/dev/null || return 1
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || return 1
    as_root=(sudo env)
  fi
  say "installing ${missing[*]}"
  as_root+=(DEBIAN_FRONTEND=noninteractive apt-get -q -o Acquire::Retries=3 -o Dpkg::Use-Pty=0)
  "${as_root[@]}" update && "${as_root[@]}" install -y --no-install-recommends "${missing[@]}"
}

install_missing g++ cmake ninja-build libglm-dev libgtest-dev ||
  { command -v g++ && command -v cmake && command -v ninja; } >/dev/null ||
  fail "g++, cmake and ninja are needed, GLM and GoogleTest as well"
install_missing clang || true

options=(-G Ninja -DCMAKE_BUILD_TYPE=Release -DHOP_CORE_ONLY=ON -DBUILD_TESTING=ON -DWARNINGS_AS_ERRORS=ON)
if command -v ccache >/dev/null; then options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi

# test_with NAME COMPILER VECTORS [CTEST_OPTION ...]: says how long building and testing took.
test_with() {
  local name=$1 compiler=$2 vectors=$3 build=$project/build-$1 start=$SECONDS built
  shift 3
  say "$name: $("$compiler" --version | head -n 1)"
  cmake -S "$project" -B "$build" "${options[@]}" -DCMAKE_CXX_COMPILER="$compiler" -DHOP_GNU_VECTORS="$vectors"
  cmake --build "$build" --target CoreTests --parallel "$(nproc)"
  built=$SECONDS
  ctest --test-dir "$build" --tests-regex '^CoreTests\.' --output-on-failure --no-tests=error --parallel "$(nproc)" "$@"
  say "$name: built in $((built - start)) s, tested in $((SECONDS - built)) s"
}

# A call in a list that ends with || would not stop at its first error: each runs in a shell of its own.
failed=()
run() { # NAME COMPILER VECTORS [CTEST_OPTION ...]
  local status=0
  set +e
  (set -e; test_with "$@")
  status=$?
  set -e
  [ "$status" -eq 0 ] || failed+=("$1")
}

if command -v clang++ >/dev/null; then
  run clang clang++ ON "$@"
  run clang-portable clang++ OFF "$@"
else
  say "no Clang here: GCC"
  run gcc-portable g++ OFF "$@"
fi
[ "${#failed[@]}" -eq 0 ] || fail "failed: ${failed[*]}"
