#!/bin/sh
# The Debian package on a bare Debian: installed, used by CMake and by pkg-config, removed, and nothing left behind.
#   sh debian.sh ROOT PACKAGE.deb HOSTS EXPECTED
# ROOT is the root folder of a minimal Debian 12 with g++, cmake, make and pkg-config, as debootstrap makes it:
#   debootstrap --variant=minbase --include=g++,cmake,make,pkg-config bookworm ROOT
# HOSTS is tests/hosts, EXPECTED what its programs must find. Needs root.
set -e
root=$1 deb=$2 hosts=$3 expected=$4
work=$root/tmp/vndf_host
# Nothing of the caller's environment: its compilers and launchers are not there.
bare() { env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin chroot "$root" "$@"; }
rm -rf "$work" && mkdir -p "$work"
trap 'rm -rf "$work"; bare dpkg --purge libvndf-dev >/dev/null 2>&1' EXIT
cp -r "$hosts" "$work/hosts" && cp -r "$hosts/../support" "$work/support"
cp "$deb" "$work/vndf.deb" && cp "$expected" "$work/expected.txt"

files() { (cd "$root" && find usr etc opt var/lib/dpkg/info | LC_ALL=C sort); }
files >"$work/before"
bare dpkg --install /tmp/vndf_host/vndf.deb
files >"$work/with"
! cmp -s "$work/before" "$work/with" || { echo "the package installs nothing" >&2; exit 1; }

bare sh -e <<'END'
cd /tmp/vndf_host
# No xsimd here: vndf::vndf is complete without it, and vndf::lanes is not asked for.
cat >hosts/CMakeLists.txt <<'PROJECT'
cmake_minimum_required(VERSION 3.22)
project(host LANGUAGES CXX)
find_package(vndf 0.1 REQUIRED)
include(programs/programs.cmake)
host_program(batches LIBRARIES vndf::vndf ARGUMENTS ${EXPECTED})
PROJECT
cmake -S hosts -B by_cmake -DEXPECTED=/tmp/vndf_host/expected.txt
cmake --build by_cmake
by_cmake/batches expected.txt
# shellcheck disable=SC2046
g++ -std=c++17 hosts/programs/batches.cpp $(pkg-config --cflags --libs vndf) -o by_hand
./by_hand expected.txt
END

bare dpkg --remove libvndf-dev
files >"$work/after"
diff "$work/before" "$work/after"
