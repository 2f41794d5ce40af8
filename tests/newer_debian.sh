#!/bin/sh
# The bits by the compilers and the xsimd of another Debian than this one: golden, bits, lanes and dispatch tests with its
# GCC and its Clang. Needs root and debootstrap.
#   sh tests/newer_debian.sh ROOT [SUITE]
# ROOT is the folder of a minimal Debian, made where there is none; SUITE is trixie unless it says otherwise.
set -e
root=$1 suite=${2:-trixie}
[ -d "$root" ] || debootstrap --variant=minbase \
  --include=g++,clang,cmake,ninja-build,libxsimd-dev,libgtest-dev,libboost-dev "$suite" "$root"
rm -rf "$root/vndf" && mkdir "$root/vndf"
git -C "$(dirname "$0")/.." archive HEAD | tar -x -C "$root/vndf"
chroot "$root" sh -e <<'END'
cd /vndf
for compiler in g++ clang++; do
  cmake --preset test -B "/vndf-$compiler" -DCMAKE_CXX_COMPILER=$compiler
  cmake --build "/vndf-$compiler" -j2 --target golden_test bits_test dispatch_test dispatch_stub_rows_test \
    lanes_float_test lanes_batch_test lanes_many_test
  ctest --test-dir "/vndf-$compiler" -j2 -R '^(golden|bits|lanes|dispatch)[a-z_]*_test|^symbols'
done
END
