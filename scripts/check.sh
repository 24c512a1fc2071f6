#!/usr/bin/env bash
# The slower checks, all of them; stops at the first that fails.
set -euo pipefail
cd "$(dirname "$0")/.."
jobs=$(nproc)
fuzz_seconds=${KEENLINE_FUZZ_SECONDS:-30}

step() { printf '\n== %s\n' "$*"; }

step "format"
scripts/format.sh --check

step "sanitizers: build and tests"
cmake --preset asan-ubsan
cmake --build --preset asan-ubsan
ctest --preset asan-ubsan

step "fuzzing, $fuzz_seconds s for each target"
scripts/fuzz.sh build/asan-ubsan "$fuzz_seconds" "$jobs"

step "every public header compiles alone; the installed package works"
cmake --preset release
cmake --build --preset release
cmake --build build/release --target all_verify_interface_header_sets
scripts/check_package.sh build/release

step "lint"
cmake --preset test
find src apps -name '*.cpp' | sort |
  xargs -P "$jobs" -n 4 clang-tidy-14 --quiet -p build/test --extra-arg=-Wno-unknown-warning-option

printf '\nall checks passed\n'
