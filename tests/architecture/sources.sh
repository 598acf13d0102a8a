#!/usr/bin/env bash
# No folder without a meaning, no left-overs, no file that is too long to read.
# Usage: sources.sh ROOT
set -euo pipefail
cd "$1"
failures=0
fail() {
  echo "$1"
  failures=$((failures + 1))
}
longest=500

folders=()
for folder in spume apps tests bench examples; do
  [ -d "$folder" ] && folders+=("$folder")
done

while IFS= read -r folder; do
  fail "$folder: a folder is named after what it is about"
done < <(find "${folders[@]}" -type d \( -iname 'util*' -o -iname misc -o -iname 'helper*' -o -iname common \))

while read -r lines file; do
  [ "$file" = total ] || [ "$lines" -le "$longest" ] ||
    fail "$file: $lines lines; split it by subject (at most $longest)"
done < <(find "${folders[@]}" \( -name '*.hpp' -o -name '*.cpp' \) -exec wc -l {} +)

while IFS= read -r file; do
  fail "$file: has no line #pragma once"
done < <(grep -rL '^#pragma once$' "${folders[@]}" --include='*.hpp' || true)

while IFS= read -r hit; do
  fail "${hit%%:*}: left-over: ${hit#*:}"
done < <(grep -rHE '(TO''DO|FIX''ME|^ *#if 0)' "${folders[@]}" --include='*.hpp' --include='*.cpp' || true)

[ "$failures" -eq 0 ] || exit 1
echo "sources: every file is short and every folder has a subject"
