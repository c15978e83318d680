#!/usr/bin/env bash
# Every file stands in a room, and knows only files of its own room and of lower ones:
#  - Common and Filters/Core know neither VTK nor ParaView (Common/VtkThreads.* but for VTK's threads);
#  - the renderer does not know the filter, nor the filter the renderer;
#  - within a folder the rooms are ordered as listed here, lowest first; what stands beside them knows all of them.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
status=0
complain() { printf 'error: %s\n' "$*" >&2; status=1; }

# includes_of FILE: the names between quotes
includes_of() { sed -nE 's/^[[:space:]]*#[[:space:]]*include[[:space:]]*"([^"]+)".*/\1/p' "$1"; }

# check_rooms FOLDER ROOM ...: no file of a room includes one of a later room.
check_rooms() {
  local folder=$1 room file name below=()
  shift
  for room in "$@"; do
    below+=("$room")
    for file in "$folder/$room"/*.*; do
      for name in $(includes_of "$file"); do
        case $name in
          */*) [ -e "$folder/$name" ] || continue # of another folder
            [[ " ${below[*]} " = *" ${name%%/*} "* ]] || complain "$file includes $name, of a higher room" ;;
          *) [ ! -e "$folder/$room/$name" ] || complain "$file includes $name without its room" ;;
        esac
      done
    done
  done
  for room in "$folder"/*/; do
    room=$(basename "$room")
    [[ " ${below[*]} Core Representation glsl " = *" $room "* ]] || complain "$folder/$room is no room that $0 knows"
  done
}

core_rooms=(Kernel Support Elements Surface Isolation Topology Edges Mesh Fast Classic)
check_rooms Filters/Core "${core_rooms[@]}"
if grep -n 'include "Fast/' Filters/Core/Classic/*.*; then complain "the two distributions know each other"; fi
if grep -n 'include "Mesh/' Filters/Core/{Fast,Classic}/*.*; then complain "a distribution knows the mesh"; fi
check_rooms Filters Input Conversion Output Run
check_rooms Rendering OpenGL Particles Drawing Passes Shading

# The numerics include files of their own, of Common, of the standard library and of GLM only.
for file in Common/*.* Filters/Core/*/*.*; do
  case $file in Common/VtkThreads.* | *CMakeLists.txt) continue ;; esac
  while read -r line; do
    name=$(sed -E 's/.*include[[:space:]]*[<"]([^>"]+)[>"].*/\1/' <<<"$line")
    case $line in
      *\<glm/*) ;;
      *\<intrin.h\>) [ "$file" = Filters/Core/Kernel/InstructionSet.cpp ] || complain "$file includes <$name>" ;; # MSVC's CPUID
      *\<*) [[ $name =~ ^[a-z_0-9]+$ ]] || complain "$file includes <$name>" ;;
      *) { [ -e "Filters/Core/$name" ] && [[ $file = Filters/* ]]; } || [ -e "$name" ] || complain "$file includes $name" ;;
    esac
  done < <(grep -E '^[[:space:]]*#[[:space:]]*include' "$file")
done

while read -r line; do complain "the renderer knows the filter: $line"; done < <(
  find Rendering -name '*.h' -o -name '*.cxx' | while read -r file; do
    for name in $(includes_of "$file"); do
      for folder in Filters Filters/Core; do [ ! -e "$folder/$name" ] || echo "$file includes $name"; done
    done
  done)
if grep -rnE 'include "(vtkSurfaceSplat|(OpenGL|Particles|Drawing|Passes|Shading)/)' Common Filters; then
  complain "the filter knows the renderer"
fi

# A test stands in the room of the header that it is named after.
for file in Testing/Core/*/Test*.cpp; do
  room=$(basename "$(dirname "$file")")
  header=$(basename "$file" .cpp)
  found=$(find Common Filters/Core -name "${header#Test}.h")
  [ -z "$found" ] || [ "$(basename "$(dirname "$found")")" = "$room" ] || complain "$file tests $found, of another room"
done
exit "$status"
