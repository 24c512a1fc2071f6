#!/usr/bin/env bash
# Formats all sources; with --check only says whether they are formatted.
set -euo pipefail
cd "$(dirname "$0")/.."
mode=(-i)
[ "${1:-}" = --check ] && mode=(--dry-run --Werror)
find src apps tests examples bench -name '*.cpp' -o -name '*.h' | sort | xargs clang-format-14 --style=file "${mode[@]}"
