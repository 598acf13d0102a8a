#!/usr/bin/env bash
# Runs one case on 1, 2 and 4 ranks and wants the same counts, and areas and volumes equal to 1e-6 relative.
# Usage: same_on_any_ranks.sh PROGRAM CASE.toml MPIEXEC
set -euo pipefail
program=$1
case_file=$2
mpiexec=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
for ranks in 1 2 4; do
  OMP_NUM_THREADS=1 "$mpiexec" --allow-run-as-root --oversubscribe -n "$ranks" "$program" run "$case_file" \
    -o "$folder/$ranks" > /dev/null
done

# Compares two tables field by field: numbers to the tolerance (relative), everything else to the letter.
compare() { # table, tolerance, reference folder, other folder
  paste -d '\n' "$3/$1" "$4/$1" | awk -F, -v tolerance="$2" -v table="$1" '
    NR % 2 == 1 { n = split($0, reference, ","); next }
    {
      if (NF != n) { print table ": lines of other lengths"; exit 1 }
      for (f = 1; f <= n; ++f) {
        if (reference[f] == $f) continue
        a = reference[f] + 0; b = $f + 0; size = (a < 0 ? -a : a); difference = a - b
        if (difference < 0) difference = -difference
        if (difference > tolerance * size) { print table " line " NR / 2 " field " f ": " reference[f] " and " $f; exit 1 }
      }
    }'
}

for ranks in 2 4; do
  # counts: phases, faces, lamellae and borders of every frame
  for columns in bubbles.csv:2,13 lamellae.csv:2-4 borders.csv:2-5; do
    table=${columns%:*}
    for r in 1 "$ranks"; do cut -d, -f"${columns#*:}" "$folder/$r/$table" > "$folder/$r/counts"; done
    compare counts 0 "$folder/1" "$folder/$ranks" || { echo "$table: other counts on $ranks ranks"; exit 1; }
  done
  for r in 1 "$ranks"; do cut -d, -f3,5 "$folder/$r/bubbles.csv" | tail -n +2 > "$folder/$r/volumes_and_areas"; done
  compare volumes_and_areas 1e-6 "$folder/1" "$folder/$ranks"
  for r in 1 "$ranks"; do cut -d, -f3,5 "$folder/$r/history.csv" | tail -n +2 > "$folder/$r/times_and_areas"; done
  compare times_and_areas 1e-6 "$folder/1" "$folder/$ranks"
  echo "$ranks ranks: the same counts, areas and volumes"
done
