#!/usr/bin/env bash
# Measures on small models by hand-checked numbers: flytri review as a user calls it.
# Usage: review_test.sh FLYTRI
set -u
. "$(dirname "$0")/../support/expect.sh"
flytri=$1
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
absent() {
  name=$1
  shift
  for file in "$@" .flytri-*; do [ ! -e "$file" ] || fail "$file was left behind"; done
}

# box FILE SIGMA: a box of 4 x 2 x 1 mm without its bottom, on a plate of 8 x 6 mm.
box() {
  local sigma=$2
  {
    printf 'ply\nformat ascii 1.0\nelement vertex 12\nproperty float x\nproperty float y\nproperty float z\n'
    [ -z "$sigma" ] || printf 'property float sigma\n'
    printf 'element face 9\nproperty list uchar int vertex_indices\nend_header\n'
    local p
    for p in '-2 -1 1' '2 -1 1' '2 1 1' '-2 1 1' '-2 -1 0' '2 -1 0' '2 1 0' '-2 1 0' \
      '-4 -3 0' '4 -3 0' '4 3 0' '-4 3 0'; do echo "$p $sigma"; done
    printf '4 0 1 2 3\n4 0 4 5 1\n4 1 5 6 2\n4 2 6 7 3\n4 3 7 4 0\n'
    printf '4 4 8 9 5\n4 5 9 10 6\n4 6 10 11 7\n4 7 11 8 4\n'
  } > "$1"
}
box box.ply 0.01
box plain.ply ''

# has NAME PATTERN: the report has a line like this.
has() { expect "$1" 0 "$2" cat report.json; }

expect 'distance' 0 '^distance: 4\.000 ± 0\.014 mm' "$flytri" review box.ply --distance '-2,-1,1 2,-1,1'
expect 'angle' 0 '^angle: 90\.000 ± ' "$flytri" review box.ply --angle '-2,-1,1 -2,1,1 2,1,1'
expect 'points go to the surface' 0 '^distance: 3\.162 ' \
  "$flytri" review box.ply --distance '0,0,7 3,0,-2'
expect 'unknown uncertainty' 0 'distance: 4\.000 mm, uncertainty unknown' \
  "$flytri" review plain.ply --distance '-2,-1,1 2,-1,1'
expect 'uncertainty as given' 0 '^distance: 4\.000 ± 0\.042 mm' \
  "$flytri" review plain.ply --distance '-2,-1,1 2,-1,1' --sigma-um 30

expect 'section' 0 'outline 1: closed, 12\.000 ± ' \
  "$flytri" review box.ply --section-plane '0,0,0.5 0,0,1' --section-points '-2,0,0.5 2,0,0.5' \
  -o report.json --lines lines.obj
expect 'along the section' 0 'straight 4\.000 .* along the outline 6\.000 ± ' \
  "$flytri" review box.ply --section-plane '0,0,0.5 0,0,1' --section-points '-2,0,0.5 2,0,0.5'
has 'report: format' '"format": "flytri.review"'
has 'report: along' '"along_mm": 6'
expect 'lines' 0 '^o section-1' cat lines.obj
expect 'a closed line comes back' 0 '^l 1 .* 1$' cat lines.obj
name='only the owner can read'
[ "$(stat -c %a report.json lines.obj)" = "$(printf '600\n600')" ] || fail "$(stat -c '%n %a' report.json lines.obj)"

# Seen along x at 45 degrees: the wall behind (2 mm2), and its shadow on the plate (2 mm2).
expect 'undercut' 0 '^undercut: (3\.[89]|4\.[01])[0-9]+ ± .* of 60\.0 mm' \
  "$flytri" review box.ply --axis 1,0,1 -o undercut.json --undercut-map map.ply
expect 'undercut map' 0 '^ply' cat map.ply
expect 'axis by itself' 0 '^insertion axis: \(-?0\.0[0-9]+, -?0\.0[0-9]+, (1\.0|0\.99)[0-9]+\); axes up to' \
  "$flytri" review box.ply --axis auto --around 0,0,1

expect 'files stay' 1 'report\.json: exists already; .*--force' \
  "$flytri" review box.ply --distance '0,0,1 1,0,1' -o report.json
expect 'files are replaced when asked' 0 '^wrote report\.json' \
  "$flytri" review box.ply --distance '0,0,1 1,0,1' -o report.json --force
cp box.ply victim.json
expect 'other files are never replaced' 1 'victim\.json: exists already and is not' \
  "$flytri" review box.ply --distance '0,0,1 1,0,1' -o victim.json --force
cmp -s box.ply victim.json || fail 'it was changed'

expect 'nothing asked' 1 'nothing to measure; give --section-plane' "$flytri" review box.ply
expect 'no point' 1 '--distance: "1,2" is not a point' "$flytri" review box.ply --distance '0,0,1 1,2'
expect 'one point' 1 '--distance "0,0,1": give it as' "$flytri" review box.ply --distance '0,0,1'
expect 'not a number' 1 '"1,2,nan" is not a point' "$flytri" review box.ply --distance '0,0,1 1,2,nan'
expect 'plane beside' 1 'box\.ply: the section plane does not cut the model' \
  "$flytri" review box.ply --section-plane '0,0,5 0,0,1' -o no.json
expect 'no direction' 1 'the section plane has no direction' \
  "$flytri" review box.ply --section-plane '0,0,0.5 0,0,0' -o no.json
expect 'auto needs a place' 1 '--axis auto finds the axis of one tooth; add --around' \
  "$flytri" review box.ply --axis auto
expect 'around without axis' 1 'add --axis' "$flytri" review box.ply --around 0,0,1
expect 'nothing around' 1 'box\.ply: the model has no surface within 2 mm' \
  "$flytri" review box.ply --axis auto --around 50,0,1 --radius-mm 2 -o no.json
expect 'no edge' 1 'the surface has no edge within 0\.5 mm' \
  "$flytri" review box.ply --margin '0,0,1 1,0,1 1,1,1' -o no.json
expect 'two clicks' 1 'needs three points or more, but has 2' \
  "$flytri" review box.ply --margin '0,0,1 1,0,1' -o no.json
expect 'lines of nothing' 1 'lines writes outlines and margin' \
  "$flytri" review box.ply --distance '0,0,1 1,0,1' --lines no.obj
expect 'lines as ply' 1 'no\.ply: lines are written as \.obj' \
  "$flytri" review box.ply --section-plane '0,0,0.5 0,0,1' --lines no.ply
expect 'map as obj' 1 'no\.obj: the undercut map is written as \.ply' \
  "$flytri" review box.ply --axis 0,0,1 --undercut-map no.obj
expect 'no model' 1 'missing\.ply' "$flytri" review missing.ply --distance '0,0,1 1,0,1'
expect 'no case' 1 'missing\.flytri' "$flytri" review missing.flytri --distance '0,0,1 1,0,1'
absent 'nothing is left after errors' no.json no.obj no.ply

exit "$((failed > 0))"
