#!/usr/bin/env bash
# A folder includes only folders of lower layers; MPI and PETSc are seen only in parallel/ and grid/.
# Usage: layers.sh ROOT
set -euo pipefail
cd "$1"
failures=0
fail() {
  echo "$1"
  failures=$((failures + 1))
}

# What each folder may include, besides itself. A new edge is written here, with its reason.
tools="base parallel"
declare -A allowed=(
  [base]=""
  [parallel]="base"
  [grid]="$tools"
  [mesh]="$tools"
  [fem]="$tools"
)
allowed[state]="$tools grid mesh fem"
for model in interface flow transport meshing drainage rupture optics io; do
  allowed[$model]="${allowed[state]} state"
done
# The paper's interface method makes its films from potentials with the contour and volumes of interface/.
allowed[viim]="${allowed[interface]} interface"
allowed[simulation]="${allowed[io]} interface viim flow transport meshing drainage rupture optics io"
allowed[config]="${allowed[simulation]} simulation"
allowed[verification]="${allowed[simulation]} simulation"

for path in spume/*/; do
  folder=$(basename "$path")
  if [ -z "${allowed[$folder]+known}" ]; then
    fail "$path: a folder without a layer; give it one in tests/architecture/layers.sh"
    continue
  fi
  while IFS= read -r hit; do
    [[ $hit =~ \"spume/([^/]+)/ ]]
    included=${BASH_REMATCH[1]}
    case " $folder ${allowed[$folder]} " in
      *" $included "*) ;;
      *) fail "${hit%%:*}: $folder/ must not include $included/" ;;
    esac
  done < <(grep -rHE '^ *#include "spume/[^/"]+/' "$path" --include='*.hpp' --include='*.cpp' || true)
  while IFS= read -r hit; do
    fail "${hit%%:*}: an include within the project has the form \"spume/folder/file.hpp\""
  done < <(grep -rHE '^ *#include "' "$path" --include='*.hpp' --include='*.cpp' | grep -vE '"spume/[^/]+/[^/]+"' || true)
done

while IFS= read -r hit; do
  case "$hit" in
    spume/parallel/* | spume/grid/*) ;;
    *) fail "${hit%%:*}: MPI and PETSc belong to parallel/ and grid/" ;;
  esac
done < <(grep -rHE '^ *#include <(mpi|petsc)' spume --include='*.hpp' --include='*.cpp' || true)

[ "$failures" -eq 0 ] || exit 1
echo "layers: every include goes down"
