#!/usr/bin/env bash
# Lines against the true lines of the shapes, default options: counts, length, distances in point spacings h.
# Further options go to keenline lines, as in: … build/lines --no-snap
set -euo pipefail
keenline=${1:?usage: bench/lines_benchmark.sh KEENLINE FOLDER [lines options]}
folder=${2:?}
shift 2
mkdir -p "$folder"

row='%-18s %6s  %9s %9s %9s %7s  %8s %8s %8s %8s %8s\n'
printf "$row" shape noise corners lines loops loose length chamfer worst corner missed
# shape, points, and how the cloud is made where that is not by default
while read -r shape points made; do
  for noise in 0 0.05h 0.1h 0.2h; do
    cloud=$folder/$shape-$noise
    # shellcheck disable=SC2086 # made is words
    spacing=$("$keenline" synth "$shape" --points "$points" --noise "$noise" $made -o "$cloud.ply" --lines "$cloud-truth.json" --json |
      python3 -c 'import json, sys; print(json.load(sys.stdin)["spacing"])')
    "$keenline" lines "$cloud.ply" -o "$cloud-found.json" --quiet "$@"
    "$keenline" evaluate "$cloud-found.json" --lines "$cloud-truth.json" --spacing "$spacing" --json > "$cloud.json"
    python3 - "$cloud.json" "$shape" "$noise" "$row" <<'PYTHON'
import json, sys
c = json.load(open(sys.argv[1]))["files"][0]
found, truth = c["found"], c["truth"]
spacings = lambda key: "-" if c[key]["in_spacings"] is None else f"{c[key]['in_spacings']:.3f}"
cells = [sys.argv[2], sys.argv[3], *(f"{found[k]}/{truth[k]}" for k in ("corners", "polylines", "loops")), found["loose_ends"],
         f"{100 * (c['length_ratio'] - 1):+.2f}%" if truth["length"] else f"{found['length']:.3g}",
         spacings("chamfer"), spacings("hausdorff"), spacings("corner_mean"), c["missed_corners"]]
print(sys.argv[4].replace("\\n", "") % tuple(cells))
PYTHON
  done
done <<'SHAPES'
cube 12000
cylinder 12000
cone 12000
box 12000
through-hole 12000
icosahedron 12000
sphere 12000
torus 12000
plane 12000
vase 12000
rounded-cube 12000
trim-star 30000
fandisk 30000
SHAPES

# What drawing costs beside finding: the time of the line stage by that of detection.
for points in 100000 1000000; do
  "$keenline" synth fandisk --points "$points" --noise 0.05h -o "$folder/large.ply" --quiet
  "$keenline" lines "$folder/large.ply" -o "$folder/large.dxf" --json "$@" | python3 -c '
import json, sys
seconds = json.load(sys.stdin)["timings_s"]
print(f"fandisk, {int(sys.argv[1]):,} points, noise 0.05h: lines / detection {seconds['"'lines'"'] / seconds['"'detect'"']:.2f}")' "$points"
done
