#!/usr/bin/env bash
# Each numbered equation of the paper has at most one owner: the function whose docstring has it in a line `Paper: … Eq. (n)`.
# docs/paper_map.md has one row an equation, | (n) | what | file | test |; the file it names holds the owner, the test
# exists, and an equation that nothing owns is marked `later`.
# Usage: paper_map.sh ROOT
set -euo pipefail
cd "$1"
n_equations=18
map=docs/paper_map.md
failures=0
fail() {
  echo "$1"
  failures=$((failures + 1))
}

# "file n" for every equation that a line `Paper:` lists.
owners=$(grep -rHE '^ *///? .*Paper: .*Eqs?\.' spume --include='*.hpp' --include='*.cpp' | while IFS= read -r hit; do
  file=${hit%%:*}
  listed=${hit#*Eq}
  grep -oE '\([0-9]+\)' <<<"${listed%%[Ss]ee *}" | tr -d '()' | sed "s|^|$file |"
done || true)

for n in $(seq 1 $n_equations); do
  owner=$(awk -v n="$n" '$2 == n {print $1}' <<<"$owners")
  count=$(grep -c . <<<"$owner" || true)
  [ "$count" -le 1 ] || fail "Eq. ($n) has $count owners: $(tr '\n' ' ' <<<"$owner")"

  row=$(grep -E "^\| *\($n\) *\|" "$map" || true)
  if [ "$(grep -c . <<<"$row" || true)" -ne 1 ]; then
    fail "$map: Eq. ($n) needs exactly one row"
    continue
  fi
  claimed=$(awk -F'|' '{gsub(/[ `]/, "", $4); print $4}' <<<"$row")
  if [ "$claimed" = later ]; then
    [ -z "$owner" ] || fail "$map: Eq. ($n) is marked later, but $owner holds it"
  elif [ "$claimed" != "$owner" ]; then
    fail "$map: Eq. ($n) should be in '$claimed'; its owner is '${owner:-nobody}'"
  fi
done

# Every path that the map names exists.
while IFS= read -r path; do
  [ -e "$path" ] || fail "$map: there is no $path"
done < <(grep -oE '`(spume|tests|cases|docs)/[^` ]+`' "$map" | tr -d '`' | sort -u)

[ "$failures" -eq 0 ] || exit 1
echo "paper map: every equation has one row and at most one owner"
