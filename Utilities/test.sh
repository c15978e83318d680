#!/usr/bin/env bash
# Install what is missing, build with warnings as errors, run all tests.
#   bash Utilities/test.sh [CTEST_OPTION ...]
# With HOP_WITH_PARAVIEW=OFF in the environment: filter and mapper with VTK alone.
set -euo pipefail
case "${1:-}" in -h | --help) sed -n 2,4p "${BASH_SOURCE[0]}" && exit ;; esac

project=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$project/build
[ "${HOP_WITH_PARAVIEW:-ON}" = ON ] || build=$project/build-vtk
bash "$project/Utilities/setup.sh" -DBUILD_TESTING=ON -DBUILD_BENCHMARKS=ON -DWARNINGS_AS_ERRORS=ON

status=0
ctest --test-dir "$build" --output-on-failure --no-tests=error --parallel "$(nproc)" "$@" || status=$?

# ctest shows the output of failed tests only; what pytest counted and skipped is worth a line each.
echo
grep -aE '^SKIPPED|^=+ .*(passed|failed|skipped|error).* =+$' "$build/Testing/Temporary/LastTest.log" || true
exit "$status"
