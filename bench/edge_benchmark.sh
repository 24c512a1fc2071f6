#!/usr/bin/env bash
# Accuracy of the default method on clouds with known sharp features, beside published rivals on the same clouds.
# One command line for all clouds, nothing tuned per set: KEENLINE detect CLOUD -o OUT [further options].
set -euo pipefail
keenline=${1:?usage: bench/edge_benchmark.sh KEENLINE DATA FOLDER [detect options]}
data=${2:?}
folder=${3:?}
shift 3

if [ ! -f "$data/rivals.tsv" ]; then
  echo "benchmark: the clouds are not here ($data); nothing to measure" >&2
  exit 0
fi
printf '%-10s %-42s %8s %8s %8s %8s %8s %8s\n' set method P R F1 medianF1 MCC IoU
for set_folder in "$data"/*/; do
  name=$(basename "$set_folder")
  mkdir -p "$folder/$name"
  outputs=()
  for cloud in "$set_folder"*.ply; do
    output=$folder/$name/$(basename "$cloud")
    "$keenline" detect "$cloud" -o "$output" --quiet "$@"
    outputs+=("$output")
  done
  "$keenline" evaluate "${outputs[@]}" --json > "$folder/$name.json"
  python3 - "$folder/$name.json" "$name" "$data/rivals.tsv" <<'PYTHON'
import csv, json, sys
summary = json.load(open(sys.argv[1]))
mean, median = summary["macro_mean"], summary["median"]
row = "{:<10} {:<42} {:8.3f} {:8.3f} {:8.3f} {:8.3f} {:8.3f} {:8.3f}"
print(row.format(sys.argv[2], "keenline", mean["precision"], mean["recall"], mean["f1"], median["f1"], mean["mcc"], mean["iou"]))
for rival in csv.DictReader(open(sys.argv[3]), delimiter="\t"):
    if rival["set"] == sys.argv[2]:
        numbers = [float(rival[k]) for k in ("mean_precision", "mean_recall", "mean_F1", "median_F1", "mean_MCC", "mean_IoU")]
        print(row.format("", f"{rival['rival']} ({rival['clouds']})", *numbers))
PYTHON
done
