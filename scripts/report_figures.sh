#!/usr/bin/env bash
# Reports as a browser shows them: a CAD part with the Gauss map of its first edge point, a scan of a building, noise.
# docs/cli.md and the README show them. Needs Chromium.
set -euo pipefail

keenline=${1:?usage: scripts/report_figures.sh KEENLINE MODELS FOLDER}
models=${2:?usage: scripts/report_figures.sh KEENLINE MODELS FOLDER}/data  # see scripts/models.sh
folder=${3:?usage: scripts/report_figures.sh KEENLINE MODELS FOLDER}
mkdir -p "$folder"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# page NAME [#VIEW]: NAME.html of the work folder
page() {
  chromium --headless=new --no-sandbox --hide-scrollbars --use-gl=angle --use-angle=swiftshader --enable-unsafe-swiftshader \
    --window-size=1200,960 --virtual-time-budget=20000 --screenshot="$folder/report-$1.png" "file://$work/$1.html${2:-}" 2>/dev/null
}
"$keenline" lines "$models/meshes/fandisk.off" --report "$work/fandisk.html" --quiet
"$keenline" detect "$models/meshes/fandisk.off" -o "$work/fandisk.csv" --quiet
on_edge=$(awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == "kind") kind = i; next } $kind == 2 { print NR - 2; exit }' "$work/fandisk.csv")
page fandisk "#point=$on_edge"
"$keenline" lines "$models/points_3/building.ply" --report "$work/building.html" --quiet
page building
"$keenline" synth cube -o "$work/noisy-cube.ply" --points 20000 --noise 0.1h --quiet
"$keenline" lines "$work/noisy-cube.ply" --report "$work/noisy-cube.html" --quiet
page noisy-cube
