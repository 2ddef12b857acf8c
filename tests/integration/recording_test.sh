#!/usr/bin/env bash
# Reconstructs the recording of a real jaw by an independent instrument, from calibration to model, and
# compares the result with the truth. Also checks the .glb with the Khronos validator.
# Usage: recording_test.sh FLYTRI DATA_FOLDER GLTF_TEST_FOLDER
set -eu
flytri=$1
data=$2
gltf=$3
if [ ! -d "$data/recording-quadrant" ]; then
  echo "skipped: $data/recording-quadrant is missing; it comes with the shared data"
  exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

"$flytri" calibrate "$data/calibration-intraoral" -o calibration.json
"$flytri" reconstruct "$data/recording-quadrant" --calibration calibration.json \
  -o out.glb -o out.ply --report report.json
"$flytri" evaluate out.ply --recording "$data/recording-quadrant" --report report.json \
  --calibration calibration.json -o evaluation.json
node "$gltf/validate.mjs" out.glb

cat > check.mjs <<'E2'
import { readFileSync } from 'node:fs';
const { counts, frames } = JSON.parse(readFileSync('report.json'));
const { as_it_stands: surface, crossed, color, poses } = JSON.parse(readFileSync('evaluation.json'));
const rejected = Object.values(counts.rejected).reduce((sum, count) => sum + count, 0);
const checks = {
  'every frame is accounted for': counts.frames === frames.length &&
    counts.frames === counts.registered + counts.interpolated + counts.textured + rejected,
  'nine of ten measurement frames are registered': counts.registered >= 0.9 * 204,
  'surface RMS is at most 32 µm': surface.rms_mm <= 0.032,
  'at least 98 % is complete where lines of both patterns were': crossed.complete_surface_share >= 0.98,
  'at least 97 % is complete where any line was': surface.complete_surface_share >= 0.97,
  'colors are at the right places': color.median < 0.2 * color.median_by_chance,
  'poses are within 20 µm': poses.first_view_rms_mm < 0.02,
};
for (const [name, holds] of Object.entries(checks)) console.log(`${holds ? 'ok' : 'FAILED'}: ${name}`);
process.exit(Object.values(checks).every(Boolean) ? 0 : 1);
E2
node check.mjs
