#!/usr/bin/env bash
# Recall within 0.5 h of a true edge and false positives beyond 2.5 h on shapes with exact truth, mean over ten seeds:
# of all points that see an edge (--no-thin), looked at as they are.
set -euo pipefail
keenline=${1:?usage: bench/analytic_shapes.sh KEENLINE [detect options]}
shift
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

measure() {
  local shape=$1 noise=$2
  shift 2
  for seed in 1 2 3 4 5 6 7 8 9 10; do
    "$keenline" synth "$shape" -o "$folder/cloud.ply" --points 6000 --noise "${noise}h" --seed "$seed" --json > "$folder/synth.json"
    "$keenline" detect "$folder/cloud.ply" -o "$folder/labels.csv" --quiet --no-thin --smooth no "$@"
    python3 - "$folder/synth.json" "$folder/labels.csv" <<'PYTHON'
import csv, json, sys
h = json.load(open(sys.argv[1]))["spacing"]
near, far = [], []
for row in csv.DictReader(open(sys.argv[2])):
    distance = float(row["truth_distance"])
    if distance <= 0.5 * h:
        near.append(int(row["feature"]))
    elif distance > 2.5 * h:
        far.append(int(row["feature"]))
print(sum(near) / len(near) if near else float("nan"), sum(far) / len(far) if far else float("nan"))
PYTHON
  done | awk -v label="$shape, noise ${noise} h $*" '{ r += $1; f += $2; n++ }
    END { printf "%-60s recall %5.3f   false positives %6.4f\n", label, r / n, f / n }'
}

for shape in cube icosahedron cylinder sphere; do measure "$shape" 0 --min-sine 1e-6 "$@"; done
for shape in cube sphere; do
  measure "$shape" 0.05 "$@"
  measure "$shape" 0.05 --triangles 32385 --min-sine 0.3 --neighbors 16 "$@"
  measure "$shape" 0.05 --triangles 32385 --min-sine 0.3 --neighbors 24 "$@"
done
