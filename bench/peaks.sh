#!/usr/bin/env bash
# How often the point of a cone's cloud that is nearest to the apex is called a peak, and what else is.
set -euo pipefail
keenline=${1:?usage: bench/peaks.sh KEENLINE [clouds per opening]}
clouds=${2:-100}
python3 - "$keenline" "$clouds" <<'PYTHON'
import csv, json, math, subprocess, sys, tempfile
keenline, clouds = sys.argv[1], int(sys.argv[2])
PEAK = 4
print(f"{'opening':>8} {'clouds':>7} {'apex is a peak':>15} {'other peaks':>12} {'nearest beyond h':>17}")
with tempfile.TemporaryDirectory() as folder:
    cloud, lines, labels = (f"{folder}/{name}" for name in ("cloud.ply", "lines.json", "labels.csv"))
    for opening in (30, 45, 60, 90, 105, 120):
        found = others = beyond = 0
        for seed in range(1, clouds + 1):
            made = subprocess.run([keenline, "synth", "cone", "--angle", str(opening), "--points", "4000", "--seed", str(seed),
                                   "-o", cloud, "--lines", lines, "--json"], check=True, capture_output=True)
            spacing = json.loads(made.stdout)["spacing"]
            graph = json.load(open(lines))
            ends = {end for line in graph["polylines"] for end in line["corners"]}
            apex, = (corner["position"] for i, corner in enumerate(graph["corners"]) if i not in ends)
            subprocess.run([keenline, "detect", cloud, "-o", labels, "--quiet"], check=True)
            rows = list(csv.DictReader(open(labels)))
            distances = [math.dist(apex, (float(r["x"]), float(r["y"]), float(r["z"]))) for r in rows]
            nearest = min(range(len(rows)), key=distances.__getitem__)
            is_peak = int(rows[nearest]["kind"]) == PEAK
            found += is_peak
            others += sum(int(r["kind"]) == PEAK for r in rows) - is_peak
            beyond += distances[nearest] > spacing
        print(f"{opening:>7}° {clouds:>7} {found:>15} {others:>12} {beyond:>17}", flush=True)
PYTHON
