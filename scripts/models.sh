#!/usr/bin/env bash
# Real models, a machine part and a scan of a building among them, from Debian's package libcgal-demo: FOLDER/data.
set -euo pipefail

models=${1:?usage: scripts/models.sh FOLDER}
[ -f "$models/data/meshes/fandisk.off" ] && exit 0

if ! command -v apt-get >/dev/null || ! command -v dpkg-deb >/dev/null; then
  echo "models: they come from Debian's package libcgal-demo, and apt-get is not here." >&2
  exit 1
fi
echo "models: fetching them (Debian package libcgal-demo, 24 MB)"
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
