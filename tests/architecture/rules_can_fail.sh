#!/usr/bin/env bash
# Shows each rule a small tree that keeps it, then the same tree with one violation.
# Usage: rules_can_fail.sh FOLDER_OF_THE_RULES
set -euo pipefail
rules=$1
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
failures=0

fresh_tree() {
  rm -rf "$tree"
  mkdir -p "$tree"/spume/{base,parallel,grid,mesh,flow,drainage} "$tree"/tests "$tree"/docs
  printf '#pragma once\n#include "spume/base/vec3.hpp"\n/// Paper: Sec. 3.2.1, Eq. (8).\n' >"$tree/spume/flow/projection.hpp"
  for n in $(seq 1 18); do echo "| ($n) | what | later | later |"; done |
    sed 's|(8) . what . later|(8) \| what \| `spume/flow/projection.hpp`|' >"$tree/docs/paper_map.md"
}
# expect keeps|breaks RULE WHAT
expect() {
  local verdict=keeps
  bash "$rules/$2.sh" "$tree" >"$tree/report" 2>&1 || verdict=breaks
  [ "$verdict" = "$1" ] && return
  echo "$2: $3: expected that it $1 the rule, but it $verdict it:"
  cat "$tree/report"
  failures=$((failures + 1))
}
violate() {
  fresh_tree
  printf '#pragma once\n%b' "$3" >"$tree/$2"
  expect breaks "$1" "$2 with ${3%%\\n*}"
}

fresh_tree
for rule in layers paper_map sources; do expect keeps "$rule" "a tree without fault"; done

violate layers spume/base/up.hpp '#include "spume/grid/grid.hpp"\n'
violate layers spume/flow/across.hpp '#include "spume/drainage/drain.hpp"\n'
violate layers spume/mesh/across.hpp '#include "spume/grid/grid.hpp"\n'
violate layers spume/flow/mpi.hpp '#include <mpi.h>\n'
violate layers spume/flow/beside.hpp '#include "projection.hpp"\n'
violate sources spume/flow/left.hpp '// TO''DO\n'
violate sources spume/flow/long.hpp "$(printf '\\n%.0s' $(seq 1 501))"
fresh_tree
echo 'int guarded;' >"$tree/spume/flow/open.hpp"
expect breaks sources "a header without #pragma once"
violate paper_map spume/flow/second.hpp '/// Paper: Sec. 3, Eqs. (7) (8).\n'
violate paper_map spume/flow/unmapped.hpp '/// Paper: Sec. 2, Eq. (3).\n'

fresh_tree
mkdir "$tree/spume/util"
expect breaks layers "a folder without a layer"
expect breaks sources "a folder util"
fresh_tree
rm "$tree/spume/flow/projection.hpp"
expect breaks paper_map "an owner that is gone"

[ "$failures" -eq 0 ] || exit 1
echo "each rule tells a tree that keeps it from one that breaks it"
