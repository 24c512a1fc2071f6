#!/usr/bin/env bash
# The main job on real models, a machine part and a scan of a building.
set -euo pipefail

keenline=${1:?usage: scripts/demo.sh KEENLINE FOLDER}
folder=${2:?usage: scripts/demo.sh KEENLINE FOLDER}
models=$folder/models
mkdir -p "$folder"

"$(dirname "$0")/models.sh" "$models" || {
  echo "demo: try a file of your own: $keenline detect YOUR.ply -o features.ply" >&2
  exit 1
}

for model in meshes/fandisk.off points_3/building.ply; do
  name=$(basename "${model%.*}")
  "$keenline" detect "$models/data/$model" -o "$folder/$name-features.ply"
  "$keenline" lines "$folder/$name-features.ply" -o "$folder/$name.dxf" -o "$folder/$name.json"
  "$keenline" picture "$folder/$name-features.ply" --lines "$folder/$name.json" -o "$folder/$name.png" --size 1200,900
  echo
done
echo "In $folder lie, of both models (fandisk, building):"
echo "  NAME-features.ply   the points with their labels: colour them by 'kind' in CloudCompare or MeshLab"
echo "  NAME.dxf            the sharp edges as a drawing for CAD (NAME.json: the same for programs)"
echo "  NAME.png            a picture of both"
echo "Continue with"
echo "  $keenline lines YOUR-SCAN.las -o drawing.dxf -o drawing.gpkg"
