#!/usr/bin/env bash
# The main job on real models, a machine part and a scan of a building, from Debian's package libcgal-demo.
set -euo pipefail

keenline=${1:?usage: scripts/demo.sh KEENLINE FOLDER}
folder=${2:?usage: scripts/demo.sh KEENLINE FOLDER}
models=$folder/models
mkdir -p "$folder"

if [ ! -f "$models/data/meshes/fandisk.off" ]; then
  if ! command -v apt-get >/dev/null || ! command -v dpkg-deb >/dev/null; then
    echo "demo: the model comes from Debian's package libcgal-demo, and apt-get is not here." >&2
    echo "demo: try a file of your own: $keenline detect YOUR.ply -o features.ply" >&2
    exit 1
  fi
  echo "demo: fetching the model (Debian package libcgal-demo, 24 MB)"
  package_folder=$(mktemp -d)
  trap 'rm -rf "$package_folder"' EXIT
  chmod 755 "$package_folder"  # apt downloads as a user of its own
  (
    cd "$package_folder"
    apt-get download -qq libcgal-demo 2>/dev/null || {
      if [ "$(id -u)" -eq 0 ]; then apt-get update -qq; else sudo apt-get update -qq; fi
      apt-get download -qq libcgal-demo
    }
    dpkg-deb -x libcgal-demo_*.deb unpacked
  )
  mkdir -p "$models"
  # Newer packages hold the data in another folder; the archive's name stayed.
  archive=$(find "$package_folder/unpacked" -name data.tar.gz | head -n 1)
  tar -xzf "$archive" -C "$models"
fi

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
