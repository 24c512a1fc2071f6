#!/usr/bin/env bash
# Installs a build into a folder of its own and builds examples/consumer against it, as someone else would.
set -euo pipefail
build=${1:?usage: scripts/check_package.sh BUILD}
prefix=$PWD/$build/package
rm -rf "$prefix" "$build/consumer"
cmake --install "$build" --prefix "$prefix" >/dev/null
cmake -S examples/consumer -B "$build/consumer" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$prefix" >/dev/null
cmake --build "$build/consumer" >/dev/null
"$build/consumer/consumer"
