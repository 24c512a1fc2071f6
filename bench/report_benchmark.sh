#!/usr/bin/env bash
# The report of a cloud with POINTS points and its lines: how large it is, and what it costs a browser.
set -euo pipefail

build=${1:?usage: bench/report_benchmark.sh BUILD FOLDER [POINTS]}  # a build folder: its program, its packages of npm
folder=${2:?usage: bench/report_benchmark.sh BUILD FOLDER [POINTS]}
points=${3:-1000000}
mkdir -p "$folder"
"$build/bin/keenline" synth fandisk --points "$points" --noise 0.05h -o "$folder/fandisk.ply" --quiet
"$build/bin/keenline" lines "$folder/fandisk.ply" --report "$folder/fandisk.html" --quiet
cp "$(dirname "$0")/../viewer/bench.mjs" "$build/viewer/"
node "$build/viewer/bench.mjs" "$folder/fandisk.html"
