#!/usr/bin/env bash
# Reproduce the paper: all cases, both methods, stock filters and sampled cells; tables, plots and pictures.
#   bash Utilities/paper.sh [FOLDER] [--limit SECONDS] [--help]
# FOLDER (default: paper-report) gets results.md, results.json and pictures/. A measurement that takes more than
# SECONDS (default 40) of processor time is given up. Set-up included, some ten minutes on two quiet cores.
set -euo pipefail
case "${1:-}" in -h | --help) sed -n 2,5p "${BASH_SOURCE[0]}" && exit ;; esac

project=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
folder=paper-report
case "${1:-}" in "" | --*) ;; *) folder=$1 && shift ;; esac
/usr/bin/python3 -c "import matplotlib" || { echo "error: the plots want Debian's python3-matplotlib" >&2; exit 1; }
bash "$project/Utilities/setup.sh" -DBUILD_TESTING=ON -DBUILD_BENCHMARKS=ON

program=$project/build/bin/distribution_benchmark
plugin=$project/build/lib/HighOrderParticleIsosurface/HighOrderParticleIsosurface.so
mkdir -p "$folder/pictures"
/usr/bin/python3 "$project/Testing/Benchmarks/paper_report.py" "$program" "$folder" "$@"

grids=$(mktemp -d)
trap 'rm -rf "$grids"' EXIT
for name in teardrop quartic tangle octic vortex_street; do
  "$program" grid=$name method=write spacing=1 out="$grids/$name.vtu" > "$grids/log"
done
bash "$project/Utilities/with-display.sh" pvbatch --force-offscreen-rendering \
  "$project/Testing/Benchmarks/paper_pictures.py" "$plugin" "$folder/pictures/results_cases.png" \
  "quartic:$grids/quartic.vtu:f:0:0:0.1" "quartic:$grids/quartic.vtu:f:0:7:0.1" \
  "quartic:$grids/quartic.vtu:f:0:15:0.1" "teardrop:$grids/teardrop.vtu:f:0:7:0.1" \
  "tangle cube:$grids/tangle.vtu:f:0:15:0.1" "octic:$grids/octic.vtu:f:0:7:0.1" \
  "vortex street:$grids/vortex_street.vtu:f:-0.5:10:0.08"
echo "== $folder/results.md"
