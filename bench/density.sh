#!/usr/bin/env bash
# F1 on shapes with exact truth (points within half a spacing of an edge), default options, at a number of points and at
# half of it; mean over five seeds.
set -euo pipefail
keenline=${1:?usage: bench/density.sh KEENLINE [points]}
points=${2:-12000}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

f1() {
  local shape=$1 count=$2 noise=$3
  local outputs=()
  for seed in 1 2 3 4 5; do
    "$keenline" synth "$shape" -o "$folder/cloud.ply" --points "$count" --noise "$noise" --seed "$seed" --quiet
    "$keenline" detect "$folder/cloud.ply" -o "$folder/$seed.ply" --quiet
    outputs+=("$folder/$seed.ply")
  done
  "$keenline" evaluate "${outputs[@]}" --json | python3 -c 'import json, sys; print(json.load(sys.stdin)["macro_mean"]["f1"])'
}

printf '%-12s %6s %12s %12s %8s\n' shape noise "n = $points" "n / 2" change
for noise in 0 0.05h; do
  for shape in cube icosahedron cylinder trim-star fandisk; do
    full=$(f1 "$shape" "$points" "$noise")
    half=$(f1 "$shape" $((points / 2)) "$noise")
    awk -v s="$shape" -v o="$noise" -v a="$full" -v b="$half" 'BEGIN { printf "%-12s %6s %12.3f %12.3f %8.3f\n", s, o, a, b, b - a }'
  done
done
