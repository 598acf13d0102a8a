#!/usr/bin/env bash
# What the program says to wrong input: exit code 1, a message that names the place or the key, nothing left behind.
# Usage: bad_input.sh PROGRAM SCRATCH_FOLDER
set -uo pipefail
program=$1
scratch=$2
rm -rf "$scratch"
mkdir -p "$scratch"
cd "$scratch" || exit 1
n_passed=0
n_failed=0

cat >good.toml <<'CASE'
title = "one bubble"
[domain]
lower = [-0.004, -0.004, -0.004]
upper = [0.004, 0.004, 0.004]
cells = [32, 32, 32]
boundary = ["wall", "wall", "wall"]
[gas]
density = 1.2
[[foam.bubble]]
shape = "sphere"
center = [0, 0, 0]
radius = 0.0015
[cycle]
end_time = 1e-4
stages = ["rearrange"]
CASE

# refuses WHAT LINES PATTERN ARGUMENTS...: `program ARGUMENTS` must fail with code 1, print LINES lines that match
# PATTERN (an extended regular expression) on standard error, nothing on standard output, and leave all files as they were.
refuses() {
  local what=$1 lines=$2 pattern=$3 before after code complaint=""
  shift 3
  before=$(find . -type f -o -type d | sort | xargs -d '\n' ls -ld --time-style=full-iso)
  "$program" "$@" >"$scratch.out" 2>"$scratch.err"
  code=$?
  after=$(find . -type f -o -type d | sort | xargs -d '\n' ls -ld --time-style=full-iso)
  [ "$code" -eq 1 ] || complaint="exit code $code, not 1"
  grep -qE -- "$pattern" "$scratch.err" || complaint="$complaint; no line matches '$pattern'"
  [ "$(wc -l <"$scratch.err")" -eq "$lines" ] || complaint="$complaint; $(wc -l <"$scratch.err") lines, not $lines"
  [ ! -s "$scratch.out" ] || complaint="$complaint; wrote to standard output"
  [ "$before" = "$after" ] || complaint="$complaint; changed files: $(diff <(echo "$before") <(echo "$after"))"
  if [ -z "$complaint" ]; then
    n_passed=$((n_passed + 1))
  else
    n_failed=$((n_failed + 1))
    echo "FAILED: $what: ${complaint#; }"
    sed 's/^/    /' "$scratch.err"
  fi
}
# Makes wrong.toml: the good case with one line changed by sed.
wrong() { sed -E "$1" good.toml >wrong.toml; }

wrong 's/^density/densty/'
refuses "unknown key" 1 "^wrong.toml:8:1: unknown key 'gas.densty'; did you mean 'gas.density'\?$" run wrong.toml
wrong 's/^\[cycle\]/[cylce]/'
refuses "misspelt section" 1 "^wrong.toml:13:2: unknown section 'cylce'; did you mean 'cycle'\?$" run wrong.toml
wrong 's/^density.*/density = "air"/'
refuses "wrong type" 1 "^wrong.toml:8:11: 'gas.density' must be a number > 0, not the text \"air\"$" run wrong.toml
wrong 's/^radius.*/radius = -0.0015/'
refuses "negative radius" 1 "^wrong.toml:12:10: bubble 1: 'foam.bubble.radius' must be a number > 0" run wrong.toml
wrong 's/^center.*/center = [0.003, 0, 0]/'
refuses "bubble outside the box" 1 "^wrong.toml:9:[0-9]+: bubble 1 reaches from 0.0015 to 0.0045 m along x" run wrong.toml
wrong 's/^cells.*/cells = [32, 32, 40]/'
refuses "cells that are no cubes" 1 "^wrong.toml:5:9: cells must be cubes.*0.00025 × 0.00025 × 0.0002 m" run wrong.toml
wrong 's/^upper.*/upper = [-0.005, 0.004, 0.004]/'
refuses "box inside out" 1 "^wrong.toml:4:9: 'domain.upper' must be larger .* along x" run wrong.toml
wrong 's/^title.*/title = "no end/'
refuses "syntax error" 1 "^wrong.toml:1:[0-9]+: " run wrong.toml
wrong 's/^density.*/density = 1.2\ndensity = 1.3/'
refuses "key given twice" 1 "^wrong.toml:9:[0-9]+: .*density" run wrong.toml
wrong 's/^stages.*/stages = ["rearrange", "melt"]/'
refuses "unknown stage" 1 "^wrong.toml:15:10: 'cycle.stages' must be one of .*not the text \"melt\"" run wrong.toml
wrong 's/^boundary.*/boundary = ["wall", "walls", "wall"]/'
refuses "bad boundary" 1 "^wrong.toml:6:12: 'domain.boundary' .*did you mean 'wall'\?$" run wrong.toml
wrong '/foam.bubble/,/radius/d'
refuses "no bubbles" 1 "^wrong.toml: no bubbles" run wrong.toml
wrong 's/^\[cycle\]/[drainage]\nscheme = "papers"\n[cycle]/'
refuses "unknown drainage scheme" 1 "'drainage.scheme' .*did you mean 'paper'" run wrong.toml
wrong 's/^\[cycle\]/[foam.membrane]\npoint = [0, 0, 0]\nnormal = [0, 1, 1]\n[cycle]/'
refuses "oblique membrane" 1 "^wrong.toml:.*must be along x, y or z" run wrong.toml
wrong '/foam.bubble/,/radius/d; s/^\[cycle\]/[foam.labels]\nfile = "missing.mha"\n[cycle]/'
refuses "labelled image that is not there" 1 "^wrong.toml: .*missing.mha: no such file$" run wrong.toml
echo "no image" >broken.mha
wrong '/foam.bubble/,/radius/d; s/^\[cycle\]/[foam.labels]\nfile = "broken.mha"\n[cycle]/'
refuses "labelled image that is none" 1 "^wrong.toml: .*broken.mha: damaged" run wrong.toml
wrong 's/^\[cycle\]/[drainage]\nedge_at_junctions = 1e-9\n[cycle]/'
refuses "edges far below a cell" 1 "^wrong.toml:14:21: 'drainage.edge_at_junctions' must be 0 or from 5e-06 to" run wrong.toml

# films TRIANGLE PHASE: films.vtp of two triangles, the second with these points and between phases 0 and PHASE.
films() {
  cat >films.vtp <<VTP
<VTKFile type="PolyData" version="1.0" header_type="UInt64"><PolyData>
<FieldData><DataArray type="Float64" Name="TimeValue" NumberOfTuples="1" format="ascii">0</DataArray></FieldData>
<Piece NumberOfPoints="4" NumberOfPolys="2">
<PointData>
<DataArray type="Float64" Name="half_thickness_m" format="ascii">5e-6 5e-6 5e-6 5e-6</DataArray>
<DataArray type="Float64" Name="border_area_m2" format="ascii">0 0 0 0</DataArray>
</PointData>
<CellData>
<DataArray type="Float64" Name="lamella" format="ascii">0 0</DataArray>
<DataArray type="Float64" Name="phase_a" format="ascii">0 0</DataArray>
<DataArray type="Float64" Name="phase_b" format="ascii">1 $2</DataArray>
</CellData>
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1e-3 0 0 1e-3 1e-3 0 0 1e-3 0</DataArray></Points>
<Polys><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 $1</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">3 6</DataArray></Polys>
</Piece></PolyData></VTKFile>
VTP
}
printf '[foam.films]\nfile = "films.vtp"\n[cycle]\nstages = ["drain"]\n' >films.toml
films "0 2 3" 1
"$program" check films.toml >"$scratch.out" 2>&1 || { echo "FAILED: good films"; n_failed=$((n_failed + 1)); }
films "0 2 999999999" 1
refuses "triangle of a point that is not there" 1 "films.vtp: a cell uses point 999999999; there are 4" run films.toml
films "0 2 -5" 1
refuses "triangle of a negative point" 1 "films.vtp: a cell uses point -5; there are 4" run films.toml
films "0 2 3" 2147483647
refuses "phase without bound" 1 "films.vtp: the triangle at .* has the phase 2147483647" run films.toml
films "0 2 3" 1e10
refuses "phase beyond all numbers" 1 "films.vtp: 'phase_b' of triangle 1 is" run films.toml
rm films.vtp films.toml
wrong 's/^density.*/density = 0/; s/^radius.*/radius = 0/; s/^end_time/endtime/'
refuses "three problems at once" 3 "^wrong.toml:14:1: unknown key 'cycle.endtime'; did you mean 'cycle.end_time'\?$" run wrong.toml
refuses "the same by check" 3 "^wrong.toml:8:11: 'gas.density' must be a number > 0, not 0$" check wrong.toml
rm wrong.toml

refuses "case file that is not there" 1 "^missing.toml: cannot be read: No such file" run missing.toml
mkdir folder.toml
refuses "folder in place of a case file" 1 "^folder.toml: is a folder" run folder.toml
refuses "option with a bad key" 1 "^--set cycle.endtime=1: unknown key .*'cycle.end_time'\?$" run good.toml --set cycle.endtime=1
refuses "option with a bad value" 1 "^--set gas.density=-1: 'gas.density' must be" run good.toml --set gas.density=-1
refuses "option without a value" 1 "^--set gas.density: an option has the form section.key=value$" run good.toml --set gas.density
echo "a file" >file
refuses "output folder that is a file" 1 "^file: no output can be written there, because .*file is a file$" run good.toml -o file
refuses "output folder below a file" 1 "^file/out: no output can be written there, because .*file is a file$" run good.toml -o file/out
mkdir other && cp good.toml other/case.toml
refuses "output into the folder of the case file" 1 "^other: holds the case file itself" run other/case.toml -o other --force
mkdir empty
refuses "resume of an empty folder" 1 "^empty: holds no run" resume empty
refuses "resume of a folder that is not there" 1 "^nowhere: no such folder" resume nowhere
refuses "resume of a run without a checkpoint" 1 "^other: holds no complete checkpoint" resume other
refuses "info of an empty folder" 1 "^empty: holds no run" info empty
refuses "unknown section of describe" 1 "^no section 'drainge'; did you mean 'drainage'\?$" describe drainge
refuses "no sub-command" 2 "subcommand" 
refuses "unknown sub-command" 2 "^unknown sub-command .rnu.; did you mean .run.\?$" rnu good.toml
refuses "run without a case" 2 "CASE.toml is required" run

if ! "$program" run good.toml --quiet || [ ! -f good-run/history.csv ]; then
  echo "FAILED: the good case does not run into good-run/"
  n_failed=$((n_failed + 1))
fi
refuses "finished run without --force" 1 "finished.*--force" run good.toml -o good-run
refuses "render of an empty folder" 1 "^empty: holds no films.pvd" render empty
refuses "frame that is not there" 1 "^--frame 99: must be last, all, or a number from 0 to" render good-run --frame 99
refuses "style of a later version" 1 "^--style interference: is not available in this version" render good-run --style interference
refuses "size that is no size" 1 "^--size 100: must be WIDTHxHEIGHT" render good-run --size 100
refuses "picture that cannot be written" 1 "^file/picture.png: cannot be written" render good-run -o file/picture.png
refuses "domain changed on resume" 1 "^good-run: \[domain\] cannot change" resume good-run --set domain.cells=[64,64,64]

rm -rf "$scratch.out" "$scratch.err"
echo "$n_passed passed, $n_failed failed"
[ "$n_failed" -eq 0 ]
