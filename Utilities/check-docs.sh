#!/usr/bin/env bash
# The architecture page tells the truth: every file that it names is there, every header is named. Links between the
# pages of the documentation lead to files and headings that are there.
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

# What a heading is called in a link: small letters, blanks as '-', no punctuation. Headings in code blocks are none; of
# several with the same name the first counts.
anchors() { # FILE
  awk '/^ *```/ { code = !code; next } !code && /^#+ / { sub(/^#+ +/, ""); print }' "$1" |
    sed -E 's/`//g; s/\[([^]]*)\]\([^)]*\)/\1/g' | tr '[:upper:]' '[:lower:]' | sed -E 's/[^[:alnum:] _-]//g; s/ /-/g'
}

# Relative links and pictures of the pages; of links to a page also what follows '#'.
for text in README.md CHANGELOG.md Documentation/*.md Testing/Data/README.md; do
  while read -r link; do
    case $link in http://* | https://* | mailto:* | "") continue ;; esac
    target=$text
    [ -z "${link%%#*}" ] || target=$(dirname "$text")/${link%%#*}
    [ -e "$target" ] || { complain "$text links to $link, which is not there"; continue; }
    case $link in
      *#*) grep -qxF -- "${link#*#}" <<<"$(anchors "$target")" || complain "$text links to $link: no such heading" ;;
    esac
  done < <(awk '/^ *```/ { code = !code; next } !code' "$text" | tr '\n' ' ' | grep -oE '\]\([^) ]+\)' | sed -E 's/^\]\((.*)\)$/\1/')
done
# Headers cite sections of the page on the algorithm.
while read -r section; do
  grep -qxF "## $section" Documentation/algorithm.md || complain "a header cites the section '$section', which is not there"
done < <(grep -rhoE 'Derivation: Documentation/algorithm\.md, section [A-Za-z ]+' Filters | sed 's/.*section //' | sort -u)
exit "$status"
