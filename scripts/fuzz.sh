#!/usr/bin/env bash
# Runs every fuzz target for a while on its seeds; a crash leaves its input in BUILD/crashes and fails.
set -euo pipefail
build=${1:?usage: scripts/fuzz.sh BUILD SECONDS JOBS}
seconds=${2:?}
jobs=${3:?}
seeds=$(dirname "$0")/../tests/fuzz/seeds
mkdir -p "$build/crashes"

fuzz_one() {
  local target=$1
  local name=${target##*/fuzz_}
  local work="$build/fuzz-corpus/$name"
  mkdir -p "$work"
  local folders=("$work")
  [ -d "$seeds/$name" ] && folders+=("$seeds/$name")
  # One thread, bounded memory: an allocation that a header merely claims ends here.
  if "$target" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -malloc_limit_mb=256 -max_len=65536 \
      -artifact_prefix="$build/crashes/$name-" -print_final_stats=1 "${folders[@]}" > "$build/fuzz-$name.log" 2>&1; then
    printf '%-10s %s\n' "$name" "$(grep -m1 number_of_executed_units "$build/fuzz-$name.log" | tr -s ' ')"
  else
    tail -n 40 "$build/fuzz-$name.log"
    printf '%-10s FAILED\n' "$name"
    return 1
  fi
}
export -f fuzz_one
export build seconds seeds
printf '%s\0' "$build"/bin/fuzz_* | xargs -0 -P "$jobs" -I{} bash -c 'fuzz_one "$1"' _ {}
