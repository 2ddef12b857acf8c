#!/usr/bin/env bash
# Cases on the command line: models that are made from them, and messages where that is impossible.
# Usage: case_test.sh FLYTRI FLYTRI_MAKE_CASE SHORT_PATH.json GLTF_TESTS
set -u
. "$(dirname "$0")/../support/expect.sh"
flytri=$1
make_case=$2
short_path=$3
gltf=$4
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
unset FLYTRI_PASSPHRASE
same() {
  name="same bytes: $1 $2"
  cmp "$1" "$2" > log 2>&1 || fail 'they differ'
}

# Data for the tests below: a recording, and cases with its views.
expect 'simulate recording' 0 '^wrote scan' \
  "$flytri" simulate recording -o scan --path "$short_path" --duration 0.4
expect 'simulate calibration set' 0 '^wrote set' "$flytri" simulate calibration-set -o set
expect 'calibrate' 0 '^wrote c.json' "$flytri" calibrate set -o c.json
# A case keeps the calibration with ten digits, as calibration.json does.
expect 'reconstruct the recording' 0 '^wrote direct.glb' \
  "$flytri" reconstruct scan --calibration c.json -o direct.glb -o direct.ply
expect 'a case' 0 '^made' "$make_case" scan c.json a.flytri upper placed
expect 'an encrypted case' 0 '^made' env FLYTRI_PASSPHRASE=secret \
  "$make_case" scan c.json secret.flytri lower unplaced
[ "$failed" = 0 ] || exit 1

# The case gives the same model as the recording, with and without poses.
expect 'no result yet' 1 'a\.flytri: no stage has a finished model; make one with flytri reconstruct --keep' \
  "$flytri" export a.flytri -o none.glb
cp a.flytri untouched.flytri
expect 'reconstruct a case' 0 '^wrote placed\.ply' \
  "$flytri" reconstruct a.flytri -o placed.glb -o placed.ply
same direct.glb placed.glb
same direct.ply placed.ply
echo secret > passphrase
expect 'reconstruct an encrypted case' 0 '^wrote unplaced\.glb' \
  "$flytri" reconstruct secret.flytri -o unplaced.glb --passphrase-file passphrase --keep
same direct.glb unplaced.glb

expect 'keep' 0 '^wrote placed\.glb' "$flytri" reconstruct a.flytri -o placed.glb --keep --force
expect 'the model says what it is of' 0 'made_of' grep -ao '"made_of":{[^}]*}' a.flytri

# What the scan is worth.
expect 'report' 0 '^wrote r\.json' "$flytri" report a.flytri -o r.html -o r.json
expect 'the page is a page' 0 '^<!DOCTYPE html>' cat r.html
expect 'the page names the distance' 0 'A end to end.*mm <b>± ' cat r.html
name='the page needs no network'
! grep -qE '(src|href)="?http' r.html || fail 'it loads something'
expect 'JSON of the report' 0 '"format": "flytri.scan-report"' cat r.json
expect 'the calibration has its date' 0 '"made_at": "20' cat r.json
name='only the owner can read'
[ "$(stat -c %a r.html r.json)" = "$(printf '600\n600')" ] || fail "$(stat -c '%n %a' r.html r.json)"
expect 'a report stays' 1 'r\.html: exists already; .*--force' "$flytri" report a.flytri -o r.html
cp direct.ply victim.html
expect 'other files are never replaced' 1 'victim\.html: exists already and is not' \
  "$flytri" report a.flytri -o victim.html --force
expect 'unknown kind of report' 1 'r\.pdf: reports are written as \.html or \.json' \
  "$flytri" report a.flytri -o r.pdf
expect 'report of a recording' 0 '^wrote scan\.html' \
  "$flytri" reconstruct scan --calibration c.json -o again.ply --report scan.html --report scan.json
expect 'both reports' 0 '"format": "flytri.report"' cat scan.json

# Export of what is kept.
expect 'export' 0 '^wrote kept\.glb' env FLYTRI_PASSPHRASE=secret \
  "$flytri" export secret.flytri -o kept.glb -o kept.stl -o kept.obj --mesh-density full
same direct.glb kept.glb
expect 'evaluate an export' 0 'RMS' "$flytri" evaluate kept.stl --recording scan
expect 'needs a passphrase' 1 'secret\.flytri: is encrypted.*FLYTRI_PASSPHRASE' \
  "$flytri" export secret.flytri -o no.glb
expect 'wrong passphrase' 1 'secret\.flytri: the passphrase is wrong' \
  env FLYTRI_PASSPHRASE=guess "$flytri" export secret.flytri -o no.glb
expect 'no passphrase file' 1 'nothing: ' \
  "$flytri" export secret.flytri -o no.glb --passphrase-file nothing

# The journal says what was done, by whom, and to which files.
expect 'journal' 0 '^20.*Z  computed .* upper .*@.* flytri ' "$flytri" journal a.flytri
expect 'journal of an encrypted case' 0 "^ *$work/kept\.obj" \
  "$flytri" journal secret.flytri --passphrase-file passphrase
expect 'journal as JSON' 0 '"action": "opened read-only"' "$flytri" journal a.flytri --json
expect 'journal needs a passphrase' 1 'secret\.flytri: is encrypted' "$flytri" journal secret.flytri
chmod a-w a.flytri
if [ ! -w a.flytri ]; then
  expect 'a case that cannot be written' 0 'warning: the journal of the case does not have' \
    "$flytri" export a.flytri -o readonly.glb
fi
chmod u+w a.flytri

# Stages.
expect 'another stage' 0 '^made' "$make_case" scan c.json a.flytri lower unplaced
expect 'several stages' 1 'several stages have views: upper, lower; .*--stage' \
  "$flytri" reconstruct a.flytri -o no.glb
expect 'empty stage' 1 'the stage bite has no views; the stages with views: upper, lower' \
  "$flytri" reconstruct a.flytri -o no.glb --stage bite
expect 'no such stage' 2 '--stage' "$flytri" reconstruct a.flytri -o no.glb --stage left
expect 'chosen stage' 0 '^wrote lower\.glb' "$flytri" reconstruct a.flytri -o lower.glb --stage lower
same direct.glb lower.glb

# All jaws in one frame. Without a bite nothing says how they meet.
expect 'keep the lower jaw' 0 '^wrote lower\.glb' \
  "$flytri" reconstruct a.flytri -o lower.glb --stage lower --keep --force
mkdir jaws
expect 'jaws in one frame' 0 '^wrote jaws/smith-lower\.stl' "$flytri" export a.flytri --jaws \
  -o jaws/smith.glb -o jaws/smith.stl -o jaws/smith.ply -o jaws/smith.obj
expect 'a node for each jaw' 0 '"name":"lower"' grep -ao '"name":"[a-z]*"' jaws/smith.glb
expect 'jaws without a bite' 0 'do not lie as they bite' "$flytri" export a.flytri --jaws -o jaws/b.glb
expect 'jaws replace nothing' 1 'jaws/smith-upper\.ply: exists already' \
  "$flytri" export a.flytri --jaws -o jaws/smith.ply
expect 'jaws or a stage' 1 '--jaws and --stage' \
  "$flytri" export a.flytri --jaws --stage upper -o no.glb
expect 'a plane of two points' 1 '--occlusal-plane: 2 points are given' \
  "$flytri" export a.flytri --jaws --occlusal-plane '0,0,0 9,0,0' -o no.glb
expect 'a plane on a line' 1 'occlusal plane that was set does not fit.*nearly on a line' \
  "$flytri" export a.flytri --jaws --occlusal-plane '0,0,0 10,0,0 20,0,0' -o no.glb
expect 'a plane without jaws' 2 '--occlusal-plane requires --jaws' \
  "$flytri" export a.flytri --occlusal-plane '0,0,0 10,0,0 0,10,0' -o no.glb
name='jaws: as many files as stages'
[ "$(find jaws -name 'smith*.*' -not -name '*.png' -not -name '*.mtl' | wc -l)" = 7 ] || fail "$(ls jaws)"
expect 'another scan of the jaw' 0 '^made' "$make_case" scan c.json a.flytri upper-preop unplaced
expect 'keep its model' 0 '^wrote preop\.glb' \
  "$flytri" reconstruct a.flytri -o preop.glb --stage upper-preop --keep
expect 'both scans of the jaw lie on each other' 0 '^wrote jaws/two-upper-preop\.stl' \
  "$flytri" export a.flytri --jaws -o jaws/two.stl -o jaws/two.glb --mesh-density full
expect 'a node for each scan' 0 '"name":"upper-preop"' grep -ao '"name":"[a-z-]*"' jaws/two.glb
name='both scans are whole'
[ "$(stat -c %s jaws/two-upper.stl)" = "$(stat -c %s jaws/two-upper-preop.stl)" ] || fail "$(ls -l jaws)"
if command -v node > /dev/null && [ -d "$gltf/node_modules/three" ]; then
  expect 'other programs read the same jaws from all formats' 0 '^ok: .*offset' node "$gltf/overlay.mjs" jaws/smith.glb \
    jaws/smith-upper.stl jaws/smith-upper.ply jaws/smith-upper.obj jaws/smith-lower.stl jaws/smith-lower.ply jaws/smith-lower.obj
else
  echo 'skipped: readers of other programs: node or three.js is not installed'
fi

# As many triangles as are asked for.
expect 'all triangles' 0 '^wrote full\.stl' \
  "$flytri" export a.flytri --stage upper -o full.stl --mesh-density full
expect 'triangles for CAD' 0 'triangles for cad' "$flytri" export a.flytri --stage upper -o cad.stl
name='fewer triangles'
[ "$(stat -c %s cad.stl)" -lt "$(($(stat -c %s full.stl) / 2))" ] || fail "$(stat -c '%n %s' -- *.stl)"

# Damage and misuse.
expect 'no such case' 1 'absent\.flytri: there is no such case' \
  "$flytri" reconstruct absent.flytri -o no.glb
expect 'not a case' 1 'c\.json: .*or not a case' "$flytri" reconstruct c.json -o no.glb
expect 'keep of a recording' 1 '--keep' "$flytri" reconstruct scan --keep -o no.glb
head -c $(($(stat -c %s untouched.flytri)  / 4)) untouched.flytri > cut.flytri
expect 'truncated case' 0 'lost: views: upper' \
  "$flytri" reconstruct cut.flytri -o cut.ply --calibration c.json
expect 'rescue a truncated case' 0 'lost: views: upper' \
  "$flytri" rescue cut.flytri -o rescued.flytri
expect 'the rescue copy is whole' 0 '^wrote rescued\.ply' \
  "$flytri" reconstruct rescued.flytri -o rescued.ply --calibration c.json
same cut.ply rescued.ply
expect 'a rescue copy replaces nothing' 1 'rescued\.flytri: .*exists already' \
  "$flytri" rescue cut.flytri -o rescued.flytri
expect 'rescue an encrypted case' 0 '^wrote secret2\.flytri; nothing was damaged' \
  "$flytri" rescue secret.flytri -o secret2.flytri --passphrase-file passphrase
expect 'its copy is encrypted' 1 'secret2\.flytri: is encrypted' \
  "$flytri" export secret2.flytri -o no.glb
expect 'keep in a truncated case' 1 'cut\.flytri: .*damaged' \
  "$flytri" reconstruct cut.flytri -o no.ply --calibration c.json --keep

# Margin lines of a case go with its model.
expect 'a case with a margin line' 0 '^made' "$make_case" prepared prepared.flytri margin
clicks=$(sed -n 's/^margin //p' log)
expect 'export with a margin line' 0 '^wrote tooth-margin\.obj' \
  "$flytri" export prepared.flytri -o tooth.glb -o tooth.stl
expect 'the margin line is an object' 0 '^o margin-1$' cat tooth-margin.obj
name='one file for both models'
[ "$(echo ./*-margin.obj)" = ./tooth-margin.obj ] || fail "$(echo ./*-margin.obj)"
rm tooth.glb tooth.stl
expect 'a margin line stays' 1 'tooth-margin\.obj: exists already; .*--force' \
  "$flytri" export prepared.flytri -o tooth.glb
name='no model without its margin line'
[ ! -e tooth.glb ] || fail 'tooth.glb was written'
expect 'a margin line by review' 0 '^wrote lines\.obj' \
  "$flytri" review prepared.flytri --margin "$clicks" --lines lines.obj
name='both are the same line'
paste <(grep '^v' lines.obj) <(grep '^v' tooth-margin.obj) \
  | awk '{ for (i = 2; i < 5; ++i) if (($i - $(i + 4))^2 > 1e-8) exit 1 } END { exit NR < 100 }' \
  || fail 'they differ'

# A system call that fails: the message says the file and the reason, and nothing half is left.
if strace -qq -o strace.log true 2> /dev/null; then
  for call in write fsync rename; do
    expect "export, $call fails" 1 'no\.glb: cannot be written: No space left' strace -f -qq -o strace.log \
      -e trace="$call" -e inject="$call:error=ENOSPC:when=1" "$flytri" export a.flytri --stage upper -o no.glb \
      --mesh-density full
  done
  name='export, killed'
  (strace -f -qq -o strace.log -e trace=fsync -e inject=fsync:signal=KILL:when=1 \
    "$flytri" export a.flytri --stage upper -o no.glb) > log 2>&1
  [ $? = 137 ] || fail 'it was not killed'
  expect 'export after that' 0 '^wrote after' "$flytri" export a.flytri --stage upper -o after.glb
  name='the temporary file of the killed program is gone'
  [ -z "$(find . -name '.flytri-*')" ] || fail "$(find . -name '.flytri-*')"
else
  echo 'skipped: strace is missing, or may not trace here (ptrace)'
fi
for file in no.*; do
  name="no file is left behind"
  [ ! -e "$file" ] || fail "$file was left behind"
done

[ "$failed" = 0 ] && echo 'all as expected'
exit $((failed > 0))
