#!/usr/bin/env bash
# Runs the program as a user does: exit codes, messages for bad input, no incomplete files, and the
# same bytes for any number of threads.
# Usage: command_line_test.sh FLYTRI SHORT_PATH.json
set -u
. "$(dirname "$0")/../support/expect.sh"
flytri=$1
short_path=$2
work=$(mktemp -d) || exit 1
trap 'umount "$work/disk" 2> /dev/null; rm -rf "$work"' EXIT
cd "$work" || exit 1
# absent NAME FILE...: fails if one of the files or a temporary file was left behind.
absent() {
  name=$1
  shift
  for file in "$@" .flytri-*; do [ ! -e "$file" ] || fail "$file was left behind"; done
}

reconstruct() { "$flytri" reconstruct "$1" --calibration calibration.json -o out.ply "${@:2}"; }

# bad_copy NAME: copies the recording, for a test that damages it.
bad_copy() { rm -rf "$1" && cp -r scan "$1"; }

# Data for the tests below.
expect 'simulate recording' 0 '^wrote scan' \
  "$flytri" simulate recording -o scan --path "$short_path" --duration 0.4
expect 'simulate without lines' 1 'DesignChange.lines is 0' "$flytri" simulate recording -o none --lines 0,7
expect 'simulate calibration set' 0 '^wrote set' "$flytri" simulate calibration-set -o set
expect 'calibrate' 0 '^wrote calibration.json' "$flytri" calibrate set -o calibration.json
[ "$failed" = 0 ] || exit 1

# The same bytes for any number of threads, and from run to run.
for run in '1 1' '2 4' '3 4'; do
  read -r i threads <<< "$run"
  expect "reconstruct, $threads threads" 0 '^wrote' "$flytri" reconstruct scan \
    --calibration calibration.json -o "$i.ply" -o "$i.glb" --report "$i.json" --threads "$threads"
done
for i in 2 3; do
  for ending in ply glb; do
    name="same bytes, .$ending"
    cmp "1.$ending" "$i.$ending" > log 2>&1 || fail "run $i differs"
  done
done
for word in manifold oriented; do
  expect "the report says $word" 0 "\"$word\": true" grep "\"$word\"" 1.json
done
expect 'the mesh that is written' 0 '"density": "full"' cat 1.json
expect 'few triangles' 0 '^wrote few\.ply' \
  "$flytri" reconstruct scan --calibration calibration.json -o few.ply --mesh-density cad
name='fewer triangles'
[ "$(stat -c %s few.ply)" -lt "$(($(stat -c %s 1.ply) / 2))" ] || fail "$(stat -c '%n %s' -- *.ply)"
expect 'no such density' 2 '--mesh-density' "$flytri" reconstruct scan -o out.ply --mesh-density fine
expect 'no such width' 2 '--close-holes' "$flytri" reconstruct scan -o out.ply --close-holes -1
expect 'evaluate' 0 'poses, RMS at the corners .* registered' \
  "$flytri" evaluate 1.ply --recording scan --report 1.json
expect 'where both patterns were' 0 'lines of both patterns within 0\.3 mm, [0-9.]* % are complete' \
  "$flytri" evaluate 1.ply --recording scan --report 1.json --calibration calibration.json
expect 'another calibration' 1 'none\.json' \
  "$flytri" evaluate 1.ply --recording scan --report 1.json --calibration none.json
bad_copy moved && sed -i '1s/{/{ "calibration": "gone.json",/' moved/recording.json
expect 'the calibration of the recording is gone' 0 'warning: .*gone\.json.*both patterns is left out' \
  "$flytri" evaluate 1.ply --recording moved --report 1.json

# Guided calibration: interrupted, continued, checked.
live() { "$flytri" calibrate --live --simulated -o chair --planes 5; }
expect 'live calibration, stopped' 0 '^stopped; chair keeps' live <<< $'\n\n\nq'
absent 'stopped calibration' chair/calibration.json chair/calibration-set.json
expect 'live calibration continues' 0 '^chair: continuing, 3 of 10' live < <(yes '')
expect 'offline as live' 0 '^wrote offline.json' "$flytri" calibrate chair -o offline.json --note '21 °C'
# They differ in the time when they were made.
without_history() { grep -v '^"history"' "$1"; }
cmp <(without_history offline.json) <(without_history chair/calibration.json) > log 2>&1 || fail 'offline calibration differs'
expect 'check on a plane' 0 '^the calibration holds' \
  "$flytri" calibrate --check --simulated --calibration offline.json --note '23 °C' < <(yes '')
expect 'the note of a calibration' 0 '^made  *20.* UTC  21 °C$' "$flytri" calibrate --history --calibration offline.json
expect 'the check is noted' 0 '^checked  *20.* UTC  passed, 23 °C$' "$flytri" calibrate --history --calibration offline.json
expect 'a note of two lines' 2 'note.*one line' "$flytri" calibrate chair -o few.json --note $'a\nb'
# A rig that measures with it, and then with another one.
mkdir clinic && echo '{ "format": "flytri.rig", "version": 1, "measurement_camera": { "match": { "name": "Mono" },
  "format": "GREY", "size_px": [1024, 768], "rate_hz": 30 }, "lights": { "chip": { "label": "ftdi-cbus" },
  "vertical": { "line": 0 }, "horizontal": { "line": 1 } } }' > clinic/rig.json
expect 'a calibration is taken into use' 0 '^clinic/rig.json measures with clinic/calibration.json' \
  "$flytri" calibrate --use offline.json --rig clinic/rig.json
expect 'another one is taken into use' 0 '^clinic/rig.json measures with clinic/calibration.json' \
  "$flytri" calibrate --use calibration.json --rig clinic/rig.json
expect 'the former one is in the history' 0 '^replaced  *20.* UTC  kept in calibration-until-' \
  "$flytri" calibrate --history --calibration clinic/calibration.json
expect 'no rig to use it' 1 'gone\.json' "$flytri" calibrate --use calibration.json --rig gone.json
expect 'check without a plane' 1 'no verdict' \
  "$flytri" calibrate --check --calibration calibration.json --recording scan
expect 'against another calibration' 0 '^the calibration holds' \
  "$flytri" calibrate --check --calibration offline.json --against chair/calibration.json
expect 'the other calibration is missing' 1 'gone\.json' \
  "$flytri" calibrate --check --calibration offline.json --against gone.json
expect 'corrected' 0 '^wrote better.json' \
  "$flytri" calibrate --check --calibration offline.json --against chair/calibration.json --correct better.json
expect 'nothing to correct by' 2 '--against' \
  "$flytri" calibrate --check --calibration offline.json --correct other.json
absent 'a correction by nothing' other.json
by_hand() { "$flytri" calibrate --live --by-hand --simulated -o hand; }
expect 'calibration by hand, stopped' 0 '^stopped; hand keeps' by_hand <<< $'\n\nx\nq'
expect 'calibration by hand continues' 0 '^hand: continuing, 2 of 30' by_hand <<< q
expect 'too few poses' 1 'has 2 poses of the board, but a calibration needs at least 15' \
  "$flytri" calibrate hand -o few.json
absent 'stopped calibration by hand' hand/calibration.json few.json
expect 'by hand is live' 2 '--live' "$flytri" calibrate --by-hand
expect 'dotted board' 0 '^36.0 x 30.0 mm on A4' "$flytri" make hand-board -o hand-board.pdf
expect 'live without a folder' 1 '-o' "$flytri" calibrate --live --simulated
expect 'nothing to calibrate' 1 '--live' "$flytri" calibrate

# Exit codes of usage.
for command in '' simulate 'simulate recording' 'simulate calibration-set' 'simulate board-set' 'simulate calibration' calibrate reconstruct \
  evaluate demo app devices record export occlude review make 'make slides' 'make target' 'make board' 'make hand-board' design; do
  # shellcheck disable=SC2086  # the words of a command
  expect "help: $command" 0 'Usage' "$flytri" $command --help
done
# The manual pages are made from it.
expect 'help of every command' 0 '^flytri simulate recording:$' "$flytri" --help-all
expect 'unknown option' 2 '--nonsense' "$flytri" reconstruct scan -o out.ply --nonsense
expect 'unknown command' 2 'no command nonsense' "$flytri" nonsense
expect 'unknown second command' 2 'no command nonsense' "$flytri" simulate nonsense
expect 'no second command' 2 'subcommand is required' "$flytri" simulate
expect 'window without a screen' 1 'no window.*DISPLAY' env -u DISPLAY "$flytri"
expect 'required option' 2 '--recording' "$flytri" evaluate nowhere
expect 'missing argument' 2 'RECORDING' "$flytri" reconstruct -o out.ply
expect 'unknown extension' 1 'out\.xyz.*\.glb, \.ply' "$flytri" reconstruct scan -o out.xyz
expect 'two outputs, one file' 1 'out\.png: two outputs.* out\.obj and out\.png' \
  "$flytri" reconstruct scan -o out.obj --report out.png

# Recordings.
bad_copy bad && truncate -s 1000 bad/frames/000003.png
expect 'truncated PNG' 0 'rejected: .*000003\.png.*truncated' reconstruct bad
rm -f out.ply
cp bad/frames/000003.png set/frames.png
bad_copy bad && cp set/frames.png bad/frames/000003.png && sed -i 's/"version": 1/"version": 99/' bad/recording.json
expect 'unknown version' 1 'bad/recording\.json: .*version.*1' reconstruct bad
bad_copy bad && sed -i '0,/"time_s"/s//"tme_s"/' bad/recording.json
expect 'missing key' 1 'bad/recording\.json: .*frames\[0\]\.time_s' reconstruct bad
bad_copy bad && printf '{"format": "flytri.recording", "version": 1, "frames": []}' > bad/recording.json
expect 'empty recording' 1 'bad/recording\.json: .*empty; record again' reconstruct bad
bad_copy bad && sed -i 's/"horizontal"/"vertical"/' bad/recording.json
expect 'one pattern only' 1 'bad: of [0-9]+ frames [1-9][0-9]* show vertical and 0 show horizontal lines .*the horizontal pattern is missing' \
  reconstruct bad
bad_copy bad && rm bad/frames/*
expect 'no images' 1 'bad: .*frame 0 was rejected: bad/frames/000000\.png: .*o such file.*; correct the path' reconstruct bad
expect 'no recording' 1 'nowhere/recording\.json: .*o such file.*; correct the path' reconstruct nowhere
expect 'no calibration named' 1 'scan/recording\.json: .*--calibration' "$flytri" reconstruct scan -o out.ply
absent 'bad recordings' out.ply

# Calibrations.
sed '0,/"rms": *[0-9.e-]*/s//"rms": NaN/' calibration.json > nan.json
expect 'NaN in calibration' 1 'nan\.json: .*flytri calibrate' \
  "$flytri" reconstruct scan --calibration nan.json -o out.ply
bad_copy bad
small=$(find "$(dirname "$short_path")" -name 'small.png')
cp "$small" bad/frames/000003.png
expect 'one image of a wrong size' 0 'rejected: bad/frames/000003\.png: .* pixels' reconstruct bad
rm -f out.ply
for frame in bad/frames/*.png; do cp "$small" "$frame"; done
expect 'wrong image size' 1 'bad/frames/000000\.png: .* pixels.*calibration' reconstruct bad
expect 'not a calibration' 1 'scan/recording\.json: .*flytri calibrate' \
  "$flytri" reconstruct scan --calibration scan/recording.json -o out.ply
sed 's/"measurement_volume_mm":\[20,15,15\]/"measurement_volume_mm":[20,15,10]/' calibration.json > scaled.json
expect 'depths of another scale' 1 'scaled\.json: "vertical\.lines\[0\]\.rows\[.*measurement volume.*flytri calibrate' \
  "$flytri" reconstruct scan --calibration scaled.json -o out.ply
sed '0,/"count":[0-9]*/s//"count":7/' calibration.json > changed.json
expect 'a changed number' 1 'changed\.json: "fingerprint": .*flytri calibrate' \
  "$flytri" reconstruct scan --calibration changed.json -o out.ply
# The calibration that a recording names is found from any folder, and is no other one.
own=$(sed -n 's/^"fingerprint":"\(.*\)",$/\1/p' calibration.json)
bad_copy bad && mkdir -p else/where && cp scaled.json else/where/calibration.json && cp calibration.json bad/
sed -i "s/\"frames\"/\"calibration\": \"calibration.json\", \"calibration_fingerprint\": \"$own\",\n \"frames\"/" \
  bad/recording.json
in_other_folder() { (cd else/where && "$flytri" reconstruct ../../bad -o ../../out.ply); }
expect 'calibration beside a recording' 0 '^wrote' in_other_folder
sed -i 's/"calibration_fingerprint": "[0-9a-f]*"/"calibration_fingerprint": "0123456789abcdef"/' bad/recording.json
rm -f out.ply
expect 'calibration of another sensor' 1 'bad/calibration\.json: is not the calibration .*--calibration' \
  "$flytri" reconstruct bad -o out.ply
absent 'calibration of another sensor' out.ply
expect 'another calibration, chosen' 0 'warning: calibration\.json: is not the calibration' reconstruct bad
rm -f out.ply
mkdir empty
expect 'no calibration set' 1 'empty/calibration-set\.json: .*o such file.*; correct the path' \
  "$flytri" calibrate empty -o other.json
absent 'bad calibrations' out.ply

# The demo. It may follow one that was stopped. Its picture must not replace the texture of its OBJ.
timeout -s INT 2 "$flytri" demo --duration 2 -o demo > log 2>&1
expect 'demo' 0 '^wrote demo/preview\.png' "$flytri" demo --duration 2 -o demo
# So short a scan has no texture: nothing else may take the place of it.
[ ! -e demo/jaw.png ] || fail 'demo/jaw.png is not the texture of demo/jaw.obj'

rm demo/demo.json
expect 'files that are not of the demo' 1 'demo/jaw\.glb: exists already; .*--force' \
  "$flytri" demo --duration 2 -o demo

# Files that exist are replaced only with --force, those of another kind never.
forced() {
  "$flytri" reconstruct scan --calibration calibration.json -o 2.ply -o 2.glb --report "$@"
}
cp 2.glb former.glb
expect 'a model exists' 1 '2\.ply: exists already; .*--force' forced new.json
grep -q Measuring log && fail 'found only after the work'
expect 'a report exists' 1 '3\.json: exists already; .*--force' "$flytri" reconstruct scan \
  --calibration calibration.json -o out.ply --report 3.json
printf 'SQLite format 3' > smith.flytri
expect 'a report over a case' 1 'smith\.flytri: .*never replaced' forced smith.flytri --force
expect 'a report over a calibration' 1 'offline\.json: .*never replaced' forced offline.json --force
printf 'SQLite format 3' | cmp - smith.flytri > log 2>&1 || fail 'the case was replaced'
expect 'figures over a picture' 1 'frames\.png: .*never replaced' \
  "$flytri" evaluate 1.ply --recording scan --report 1.json -o set/frames.png --force
expect 'a calibration exists' 1 'calibration\.json: exists already' \
  "$flytri" calibrate set -o calibration.json
expect 'a recording exists' 1 'scan/recording\.json: exists already' \
  "$flytri" simulate recording -o scan --path "$short_path" --duration 0.4
expect 'a calibration set exists' 1 'set/calibration-set\.json: exists already' \
  "$flytri" simulate calibration-set -o set
: > .flytri-0123abcd
chmod 644 2.glb
expect 'with --force' 0 '^wrote new\.json' forced new.json --force
cmp former.glb 2.glb > log 2>&1 || fail 'another model'
absent 'temporary file of a killed program'
name='only the owner may read a model'
[ "$(stat -c %a 2.glb 2.ply new.json | sort -u)" = 600 ] || fail "$(stat -c '%a %n' 2.* new.json)"
expect 'without a home' 1 'HOME' env -u HOME -u XDG_CONFIG_HOME "$flytri" app

# Sheets and designs.
expect 'slides' 0 '^vertical: 10 lines, 15\.27 µm wide, 14\.483 mm before the lens' \
  "$flytri" make slides -o slide.svg --projector-focal-mm 12
expect 'one slide a projector' 0 'width="297mm" height="210mm"' grep -h '<svg' slide-vertical.svg slide-horizontal.svg
expect 'a target as PDF' 0 '^28\.0 x 22\.0 mm on A4' "$flytri" make target -o dots.pdf
expect 'a target for faces' 0 ' on A3' "$flytri" make target --sensor face -o face.svg
expect 'a white board' 0 ' on A4' "$flytri" make board -o board.pdf
expect 'another sensor' 0 '^vertical: 6 lines' \
  "$flytri" make slides -o six.pdf --projector-focal-mm 12 --lines 6,4 --baseline-mm 14
expect 'a sheet exists' 1 'slide-vertical\.svg: exists already; .*--force' \
  "$flytri" make slides -o slide.svg --projector-focal-mm 12
rm slide-vertical.svg
expect 'one of two sheets exists' 1 'slide-horizontal\.svg: exists already' \
  "$flytri" make slides -o slide.svg --projector-focal-mm 12
absent 'one of two sheets exists' slide-vertical.svg
expect 'a sheet again' 0 '^wrote dots\.pdf' "$flytri" make target -o dots.pdf --force
cp 1.ply model.svg
expect 'a sheet over a model' 1 'model\.svg: .*never replaced' "$flytri" make target -o model.svg --force
expect 'a sheet as a picture' 1 'dots\.png: .*\.svg or \.pdf' "$flytri" make target -o dots.png
expect 'a lens without an image' 1 'focal_mm is 90' \
  "$flytri" make slides -o far.svg --projector-focal-mm 90
expect 'dots that overlap' 1 'marker_diameter_mm is 2' "$flytri" make target -o far.svg --dots 1 0.5 2
expect 'a field that no paper holds' 1 'too large for A0' \
  "$flytri" make board -o far.svg --sensor face --field-mm 2000,1500
expect 'no such sheet' 2 'no command poster' "$flytri" make poster -o far.svg
absent 'bad sheets' far.svg
expect 'a design' 0 '^wrote design\.json' "$flytri" design --baseline-mm 14 --lines 6,4 \
  -o design.json --plot plot.svg --drawing head.pdf
expect 'the design as JSON' 0 '"baseline_mm": 14' cat design.json
expect 'the design exists' 1 'design\.json: exists already' "$flytri" design -o design.json
expect 'lines that cannot be told apart' 0 'vertical lines cannot be told apart' \
  "$flytri" design --baseline-mm 14
expect 'a bad design' 1 'baseline_mm is -1' "$flytri" design --baseline-mm -1
expect 'a drawing as a picture' 1 'plot\.png: .*\.svg or \.pdf' "$flytri" design --plot plot.png

# Truth.
bad_copy bad && rm bad/truth.json
expect 'no truth' 1 'bad/truth\.json: .*simulate' "$flytri" evaluate 1.ply --recording bad

# Writing.
expect 'below a file' 1 '1\.ply/out\.ply: .*folder' "$flytri" reconstruct scan \
  --calibration calibration.json -o 1.ply/out.ply
expect 'no such folder' 1 'nowhere/out\.ply: .*folder' "$flytri" reconstruct scan \
  --calibration calibration.json -o nowhere/out.ply
expect 'no folder for the report' 1 'nowhere/report\.json: .*folder' "$flytri" reconstruct scan \
  --calibration calibration.json -o out.ply --report nowhere/report.json
grep -q Measuring log && fail 'found only after the work'
absent 'no folder for the report' out.ply
expect 'no folder for the calibration' 1 'nowhere/c\.json: .*folder' \
  "$flytri" calibrate set -o nowhere/c.json
if [ "$(id -u)" = 0 ] && setpriv --reuid=65534 --clear-groups true 2> /dev/null; then
  chmod 755 "$work" && mkdir -m 755 locked
  expect 'no permission' 1 'locked/out\.ply: .*[Pp]ermission' \
    setpriv --reuid=65534 --clear-groups "$flytri" reconstruct scan --calibration calibration.json -o locked/out.ply
  absent 'no permission' locked/out.ply locked/.flytri-*
else
  echo 'skipped: no permission: needs root and setpriv'
fi
mkdir disk
if mount -t tmpfs -o size=64k none disk 2> /dev/null; then
  expect 'disk full' 1 'disk/out\.ply: .*space' "$flytri" reconstruct scan \
    --calibration calibration.json -o disk/out.ply
  absent 'disk full' disk/out.ply disk/.flytri-*
else
  echo 'skipped: disk full: needs the right to mount a tmpfs'
fi

# Where messages go must not decide what becomes of the work.
to_full() { "$@" > /dev/full; }
messages_to_full() { "$@" 2> /dev/full; }
limited() { (ulimit -f 16 && "$@"); }
expect 'output on a full disk' 1 'could be printed: ' to_full "$flytri" reconstruct scan \
  --calibration calibration.json -o out.ply
expect 'help on a full disk' 1 'could be printed: ' to_full "$flytri" --help-all
rm -f out.ply
expect 'messages on a full disk' 0 '^wrote out\.ply' messages_to_full "$flytri" reconstruct scan \
  --calibration calibration.json -o out.ply
rm -f out.ply
expect 'limit on the size of files' 1 'out\.ply: .*larger' limited "$flytri" reconstruct scan \
  --calibration calibration.json -o out.ply
absent 'limit on the size of files' out.ply
bad_copy $'bad\e[31m' && rm $'bad\e[31m/recording.json'
expect 'control characters in a name' 1 'bad\\x1b\[31m/recording\.json' reconstruct $'bad\e[31m'

# Ctrl-C, and a terminal that is closed. A program in the background of a shell ignores SIGINT; env
# undoes that.
for signal in INT TERM HUP; do
  rm log
  env --default-signal=$signal "$flytri" reconstruct scan --calibration calibration.json -o out.ply > log 2>&1 &
  running=$!
  until grep -qs 'Registering\|Meshing\|Measuring' log || ! kill -0 $running 2> /dev/null; do sleep 0.02; done
  kill -$signal $running
  wait $running
  status=$?
  name="SIG$signal"
  [ "$status" = 1 ] || fail "exit code $status, not 1"
  grep -q 'stopped; nothing was written' log || fail 'does not report that it stopped'
  absent "SIG$signal" out.ply
done

echo "$failed failed"
[ "$failed" = 0 ]
