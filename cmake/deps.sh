#!/bin/sh
# Installs what vndf builds with on Debian and Ubuntu; elsewhere says what to install. Does nothing where all is there.
# --wavefront: what the renderer of bench/wavefront builds with, as well.
# --emulators: what ARM and old processors are tested with, as well.
# --coverage: gcovr, as well.
# --sanitizers: Clang, its sanitizers and its libFuzzer, as well.
# --windows: what Windows is tested with, as well: Clang, mingw-w64 and Wine, a gigabyte.
set -e
packages="g++ make cmake ninja-build pkg-config libxsimd-dev libgtest-dev libboost-dev libbenchmark-dev libcli11-dev
  nlohmann-json3-dev python3-matplotlib python3-pandas python3-jinja2"

for option; do
  case "$option" in
    --wavefront) packages="$packages libembree-dev libtbb-dev libopenexr-dev libpng-dev libtinyobjloader-dev
      openimageio-tools" ;;
    --emulators) packages="$packages g++-aarch64-linux-gnu qemu-user" ;;
    --coverage) packages="$packages gcovr" ;;
    --sanitizers) packages="$packages clang libclang-rt-dev" ;;
    --windows) packages="$packages clang lld g++-mingw-w64-x86-64-posix wine64" ;;
    *) echo "usage: sh cmake/deps.sh [--wavefront] [--emulators] [--coverage] [--sanitizers] [--windows]" >&2; exit 2 ;;
  esac
done

if ! command -v apt-get >/dev/null; then
  cat >&2 <<'END'
This script installs Debian and Ubuntu packages only. Please install, by your system's means:
  GCC or Clang with C++17 (GCC 12 and Clang 14 are tested), CMake 3.25 or newer (the library alone: 3.22), Ninja,
  and for the tests Make and pkg-config
  xsimd 8.1 to 14 (header-only)   https://github.com/xtensor-stack/xsimd
  GoogleTest                      https://github.com/google/googletest
  Boost.Math (for the tests)      https://www.boost.org
  Google Benchmark                https://github.com/google/benchmark
  CLI11                           https://github.com/CLIUtils/CLI11
  nlohmann/json                   https://github.com/nlohmann/json
  Python 3.10 with matplotlib, pandas and Jinja2 (for the report)
For the renderer of bench/wavefront: Embree 3.12 to 4, oneTBB, OpenEXR 3, libpng, tinyobjloader 2, Boost.Random, and for its
tests OpenImageIO's oiiotool
END
  exit 2
fi

missing=""
for package in $packages; do
  dpkg-query -W -f '${Status}\n' "$package" 2>/dev/null | grep -q 'install ok installed' || missing="$missing $package"
done
[ -n "$missing" ] || exit 0

as_root=""
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || { echo "Run as root, or install:$missing" >&2; exit 2; }
  as_root=sudo
fi
echo "Installing:$missing"
$as_root apt-get update -qq
# Word splitting is meant: one argument a package.
# shellcheck disable=SC2086
DEBIAN_FRONTEND=noninteractive $as_root apt-get install -y -qq --no-install-recommends $missing
