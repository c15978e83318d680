#!/usr/bin/env bash
# Install what is missing, build with warnings as errors, run all tests.
#   bash Utilities/test.sh [CTEST_OPTION ...]
set -euo pipefail

project=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
bash "$project/Utilities/setup.sh" -DBUILD_TESTING=ON -DWARNINGS_AS_ERRORS=ON

status=0
ctest --test-dir "$project/build" --output-on-failure --no-tests=error --parallel "$(nproc)" "$@" || status=$?

# ctest shows the output of failed tests only; what pytest counted and skipped is worth a line each.
echo
grep -aE '^SKIPPED|^=+ .*(passed|failed|skipped|error).* =+$' "$project/build/Testing/Temporary/LastTest.log" || true
exit "$status"
