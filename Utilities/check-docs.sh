#!/usr/bin/env bash
# The architecture page tells the truth: every file that it names is there, every header is named. Links between the
# pages of the documentation lead somewhere.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
page=Documentation/architecture.md
status=0
complain() { printf 'error: %s\n' "$*" >&2; status=1; }

# Paths that begin at the top of the project; `test_*.py` is a pattern.
while read -r path; do
  names=($path)
  [ -e "${names[0]}" ] || complain "$page names $path, which is not there"
done < <(grep -oE '`(Common|Filters|Rendering|Plugin|Testing|Utilities|Documentation)/[^` ]*`|`(CMakeLists\.txt|CHANGELOG\.md)`' "$page" | tr -d '`' | sort -u)

# A table's head says in which folder its headers are: `Name.h` or `Room/Name.h`.
named=$(awk '/^\| header of `/ { split($0, parts, "`"); folder = parts[2] }
             /^\|/ { n = split($0, parts, "`"); for (i = 2; i <= n; i += 2) if (parts[i] ~ /\.h$/) print folder parts[i] }
             !/^\|/ { n = split($0, parts, "`"); for (i = 2; i <= n; i += 2) if (parts[i] ~ /\.h$/) print parts[i] }' "$page")
headers=$(find Common Filters Rendering -name '*.h')
while read -r header; do
  grep -qxF "$header" <<<"$named" || complain "$page does not say what $header is for"
done <<<"$headers"
while read -r header; do
  [ -e "$header" ] || complain "$page names $header, which is not there"
done <<<"$named"

# Relative links and pictures of the pages, without what follows '#'.
for text in README.md CHANGELOG.md Documentation/*.md; do
  while read -r link; do
    case $link in http://* | https://* | mailto:* | "#"* | "") continue ;; esac
    [ -e "$(dirname "$text")/${link%%#*}" ] || complain "$text links to $link, which is not there"
  done < <(grep -oE '\]\([^) ]+\)' "$text" | sed -E 's/^\]\((.*)\)$/\1/')
done
exit "$status"
