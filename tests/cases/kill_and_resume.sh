#!/usr/bin/env bash
# Kills a run with SIGKILL in each of its stages, resumes it, and wants the events and the history of an undisturbed run.
# Usage: kill_and_resume.sh PROGRAM CASE.toml
set -euo pipefail
program=$1
case_file=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

"$program" run "$case_file" -o "$folder/whole" > /dev/null

# Waits until the last line of history.csv is of the wanted stage and the run has had a few ruptures, then kills it.
kill_in() { # run folder, stage, ruptures
  "$program" run "$case_file" -o "$1" > /dev/null 2>&1 &
  local run=$! stage=$2 ruptures=$3
  for _ in $(seq 3000); do
    if [ -d "$1/checkpoint" ] && [ "$(tail -n 1 "$1/history.csv" | cut -d, -f2)" = "$stage" ] &&
       [ "$(grep -c ',rupture,' "$1/events.csv" || true)" -ge "$ruptures" ]; then
      break
    fi
    kill -0 "$run" 2>/dev/null || break
    sleep 0.02
  done
  kill -9 "$run" 2>/dev/null || { echo "the run ended before it could be killed in $stage"; exit 1; }
  wait "$run" 2>/dev/null || true
}

for stage in rearrange:0 drain:0 rearrange:1; do
  killed="$folder/${stage/:/_}"
  kill_in "$killed" "${stage%:*}" "${stage#*:}"
  "$program" resume "$killed" > /dev/null
  for table in events.csv history.csv; do
    cmp "$folder/whole/$table" "$killed/$table" || { echo "$table differs after a kill in $stage"; exit 1; }
  done
  echo "killed in $stage and resumed: the same events and history"
done
