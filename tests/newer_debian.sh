#!/bin/sh
# The bits by the compilers and the xsimd of another Debian than this one: golden, bits, lanes and dispatch tests with its
# GCC and its Clang, without a warning. Needs root and debootstrap.
#   sh tests/newer_debian.sh ROOT [SUITE [OPTION...]]
# ROOT is the folder of a minimal Debian, made where there is none; SUITE is trixie unless it says otherwise; options
# are CMake's, -DVNDF_ISAS for instance. Packages come from where this machine's own come from.
set -e
[ $# -ge 1 ] || { echo "usage: sh tests/newer_debian.sh ROOT [SUITE [OPTION...]]" >&2; exit 2; }
root=$1 suite=${2:-trixie}
shift; [ $# -eq 0 ] || shift
# One that was left half made has no CMake.
[ -x "$root/usr/bin/cmake" ] || debootstrap --variant=minbase \
  --include=g++,clang,cmake,ninja-build,libxsimd-dev,libgtest-dev,libboost-dev "$suite" "$root" \
  "$(apt-get indextargets --format '$(REPO_URI)' | grep -m1 '/debian/*$')"
rm -rf "$root/vndf" && mkdir "$root/vndf"
git -C "$(dirname "$0")/.." archive HEAD | tar -x -C "$root/vndf"
# Nothing of the caller's environment: its compilers and launchers are not there.
env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin chroot "$root" sh -e -s -- "$@" <<'END'
cd /vndf
for compiler in g++ clang++; do
  cmake --preset test -B "/vndf-$compiler" -DCMAKE_CXX_COMPILER=$compiler -DCMAKE_COMPILE_WARNING_AS_ERROR=ON "$@"
  cmake --build "/vndf-$compiler" -j2 --target golden_test bits_test dispatch_test dispatch_stub_rows_test \
    lanes_float_test lanes_batch_test lanes_many_test
  ctest --test-dir "/vndf-$compiler" -j2 --output-on-failure -R '^(golden|bits|lanes|dispatch)[a-z_]*_test|^symbols'
done
END
