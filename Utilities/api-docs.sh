#!/usr/bin/env bash
# Build the API reference from the comments of the headers: build/api/html/index.html. Warnings are errors.
#   bash Utilities/api-docs.sh [--no-install] [OUTPUT_FOLDER]
# Installs doxygen where it is missing (Debian); with --no-install: exit code 77 then.
set -euo pipefail
case "${1:-}" in -h | --help) sed -n 2,4p "${BASH_SOURCE[0]}" && exit ;; esac
cd "$(dirname "${BASH_SOURCE[0]}")/.."

install=yes
if [ "${1:-}" = --no-install ]; then install=no && shift; fi
output=${1:-build/api}

if ! command -v doxygen >/dev/null; then
  [ "$install" = yes ] || { echo "doxygen is not installed: nothing checked"; exit 77; }
  command -v apt-get >/dev/null || { echo "error: no doxygen here, and no apt-get to install it" >&2; exit 1; }
  as_root=(env)
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null ||
      { echo "error: not root and no sudo; have an administrator run: apt-get install doxygen" >&2; exit 1; }
    as_root=(sudo env)
  fi
  "${as_root[@]}" DEBIAN_FRONTEND=noninteractive apt-get -q -o Acquire::Retries=3 update
  "${as_root[@]}" DEBIAN_FRONTEND=noninteractive apt-get -q -o Acquire::Retries=3 install -y --no-install-recommends doxygen
fi

mkdir -p "$output"
(cat Documentation/doxygen/Doxyfile && echo "OUTPUT_DIRECTORY = \"$output\"") | doxygen -
echo "$output/html/index.html"
