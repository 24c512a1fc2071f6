#!/usr/bin/env bash
# Installs what `make build`, `make figures`, `make test`, `make check` or `make bench` needs, where this is Debian or Ubuntu and we may.
# Elsewhere it prints what is missing and succeeds when nothing is.
set -euo pipefail

level=${1:?usage: scripts/setup.sh build|figures|test|check|bench}
packages=(g++ cmake ninja-build libeigen3-dev libtbb-dev libcli11-dev libfmt-dev nlohmann-json3-dev libfast-float-dev libpng-dev zlib1g-dev libsqlite3-dev libhwy-dev)
tools=(c++ cmake ninja)
# The page of reports is built with npm. Whoever has a Node keeps it.
if ! command -v npm >/dev/null || ! node -e 'process.exit(parseInt(process.versions.node) >= 18 ? 0 : 1)' 2>/dev/null; then
  packages+=(nodejs npm)
  tools+=(node npm)
fi
headers=(Eigen/Core oneapi/tbb/parallel_for.h CLI/CLI.hpp fmt/format.h nlohmann/json.hpp fast_float/fast_float.h png.h zlib.h sqlite3.h hwy/highway.h)
case $level in
  build) ;;
  figures)
    packages+=(chromium)
    tools+=(chromium) ;;
  bench)
    packages+=(libbenchmark-dev libnanoflann-dev libcgal-dev libpcl-dev pkg-config)
    headers+=(benchmark/benchmark.h nanoflann.hpp) ;;
  test|check)
    packages+=(libgtest-dev python3 python3-ezdxf chromium)
    tools+=(python3 chromium)
    headers+=(gtest/gtest.h) ;;&
  check)
    packages+=(libocct-data-exchange-dev clang-14 libclang-rt-14-dev clang-tidy-14 clang-format-14)
    tools+=(clang++-14 clang-tidy-14 clang-format-14) ;;
  test) ;;
  *) echo "setup: unknown level '$level': expected build, figures, test, check or bench" >&2; exit 2 ;;
esac

if command -v dpkg-query >/dev/null && command -v apt-get >/dev/null; then
  missing=()
  for package in "${packages[@]}"; do
    dpkg-query -W -f '${db:Status-Abbrev}' "$package" 2>/dev/null | grep -q '^ii' || missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && exit 0
  as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
      echo "setup: please install (as root): apt-get install ${missing[*]}" >&2
      exit 1
    fi
    as_root=(sudo)
  fi
  echo "setup: installing ${missing[*]}"
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
  exit 0
fi

absent=()
for tool in "${tools[@]}"; do
  command -v "$tool" >/dev/null || absent+=("$tool")
done
if command -v c++ >/dev/null; then
  for header in "${headers[@]}"; do
    printf '#include <%s>\n' "$header" |
      c++ -std=c++20 -x c++ -fsyntax-only -I/usr/include/eigen3 -I/usr/local/include -I/opt/homebrew/include - 2>/dev/null ||
      absent+=("$header")
  done
fi
if [ ${#absent[@]} -gt 0 ]; then
  echo "setup: this is neither Debian nor Ubuntu; please install what provides: ${absent[*]}" >&2
  exit 1
fi
