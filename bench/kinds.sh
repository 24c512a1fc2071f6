#!/usr/bin/env bash
# How often points of one kind are taken for another, default options, on shapes that have them all.
set -euo pipefail
keenline=${1:?usage: bench/kinds.sh KEENLINE [noise]}
noise=${2:-0}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
outputs=()
for shape in cube icosahedron cylinder cone crease fandisk trim-star vase sphere torus; do
  for seed in 1 2 3; do
    "$keenline" synth "$shape" -o "$folder/cloud.ply" --points 10000 --noise "$noise" --seed "$seed" --quiet
    "$keenline" detect "$folder/cloud.ply" -o "$folder/$shape-$seed.ply" --quiet
    outputs+=("$folder/$shape-$seed.ply")
  done
done
"$keenline" evaluate "${outputs[@]}" --kinds
