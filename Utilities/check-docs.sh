#!/usr/bin/env bash
# The architecture page tells the truth: every file it names is there, every header of the filter, of the numerics
# and of the rendering is named.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
page=Utilities/docs/architecture.md
status=0

# Paths that begin at the top of the project; `test_*.py` is a pattern.
while read -r path; do
  names=($path)
  [ -e "${names[0]}" ] || { echo "error: $page names $path, which is not there" >&2; status=1; }
done < <(grep -oE '`(Filters|Rendering|Plugin|Testing|Utilities)/[^` ]*`|`(CMakeLists\.txt|CHANGELOG\.md)`' "$page" | tr -d '`' | sort -u)

for header in Filters/*.h Filters/Core/*.h Rendering/*.h; do
  grep -qF "\`$(basename "$header")\`" "$page" || grep -qF "\`$header\`" "$page" ||
    { echo "error: $page does not say what $header is for" >&2; status=1; }
done
while read -r header; do
  [ -e "Filters/$header" ] || [ -e "Filters/Core/$header" ] || [ -e "Rendering/Representation/$header" ] ||
    { echo "error: $page names $header, which is not there" >&2; status=1; }
done < <(grep -oE '`[A-Za-z]+\.h`' "$page" | tr -d '`' | sort -u)
exit "$status"
