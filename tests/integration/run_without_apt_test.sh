#!/usr/bin/env bash
# ./run on a system without apt: it names the packages and goes on to the build.
set -euo pipefail
cd "$(dirname "$0")/../.."
tools=$(mktemp -d)
trap 'rm -rf "$tools"' EXIT
ln -s "$(command -v bash)" "$(command -v dirname)" "$tools"
printf '#!/bin/sh\necho "cmake $*"\n' > "$tools/cmake"
chmod +x "$tools/cmake"
said=$(PATH=$tools ./run build 2>&1) || true
for expected in 'no apt' libembree-dev 'cmake --build --preset release'; do
  grep -qF -- "$expected" <<< "$said" && continue
  printf 'FAILED: "%s" is not in the output:\n%s\n' "$expected" "$said"
  exit 1
done
