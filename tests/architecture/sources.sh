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

while IFS= read -r file; do
  lines=$(wc -l <"$file")
  [ "$lines" -le "$longest" ] || fail "$file: $lines lines; split it by subject (at most $longest)"
  case "$file" in
    *.hpp) head -n 1 "$file" | grep -q '^#pragma once$' || fail "$file: does not begin with #pragma once" ;;
  esac
done < <(find "${folders[@]}" -name '*.hpp' -o -name '*.cpp')

while IFS= read -r hit; do
  fail "${hit%%:*}: left-over: ${hit#*:}"
done < <(grep -rHE '(TO''DO|FIX''ME|^ *#if 0)' "${folders[@]}" --include='*.hpp' --include='*.cpp' || true)

[ "$failures" -eq 0 ] || exit 1
echo "sources: every file is short and every folder has a subject"
