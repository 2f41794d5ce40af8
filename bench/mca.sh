#!/bin/sh
# Estimates the kernels' cycles per sample on processors that are not at hand, with llvm-mca.
usage() {
  cat <<'END'
Usage: bench/mca.sh [--help] [CPU...]

Compiles the loops of the sampling kernels (bench/mca.cpp) for each instruction set, with the compiler options and the
number of vectors at once that cmake/isa.cmake gives them, runs llvm-mca over one iteration of each for every CPU
(default: znver4 skylake-avx512 icelake-server sapphirerapids), and prints a Markdown table of cycles per sample in the
steady state.

Caches are taken as warm. The scalar set is left out: compilers give it branches, which llvm-mca cannot follow.
Environment: CXX, the compiler (c++); CXXFLAGS, options added to it, e.g. -I with the place of xsimd; LLVM_MCA, the
program (the newest one found).
END
}

fail() {
  echo "mca.sh: $*" >&2
  exit 2
}

cpus=""
for argument in "$@"; do
  case $argument in
    -h | --help) usage; exit 0 ;;
    -*) fail "unknown option $argument; see --help" ;;
    *) cpus="$cpus $argument" ;;
  esac
done
: "${cpus:=znver4 skylake-avx512 icelake-server sapphirerapids}"

# The newest first: older ones do not know znver4.
mca=${LLVM_MCA:-}
for name in llvm-mca-22 llvm-mca-21 llvm-mca-20 llvm-mca-19 llvm-mca-18 llvm-mca-17 llvm-mca; do
  [ -z "$mca" ] && command -v "$name" >/dev/null && mca=$name
done
: "${mca:=llvm-mca}"
command -v "$mca" >/dev/null || fail "llvm-mca was not found; Debian has it in the package llvm-19, or set LLVM_MCA"
cxx=${CXX:-c++}
command -v "$cxx" >/dev/null || fail "no compiler $cxx; set CXX"

root=$(cd "$(dirname "$0")/.." && pwd)
dir=$(mktemp -d) || fail "no temporary directory"
trap 'rm -rf "$dir"' EXIT
trap 'exit 2' HUP INT TERM

# measure isa vectors width-of-one batch flag...: appends lines "isa lanes cpu kernel cycles" to $dir/cycles.
measure() {
  isa=$1 vectors=$2 lanes=$(($2 * $3)) batch=$4
  shift 4
  # Word splitting is meant: several options.
  # shellcheck disable=SC2086
  "$cxx" -std=c++17 -O3 -ffp-contract=off -fno-math-errno $scheduler -I"$root/include" ${CXXFLAGS:-} "$@" \
    -DVNDF_BATCH="$batch" -DVNDF_VECTORS="$vectors" -S "$root/bench/mca.cpp" -o "$dir/$isa.s" 2>"$dir/log" || fail "cannot compile for $isa: $(grep -m1 error "$dir/log")"
  for cpu in $cpus; do
    "$mca" -mcpu="$cpu" -iterations=1000 "$dir/$isa.s" >"$dir/out" 2>"$dir/log" ||
      fail "$mca fails for $cpu: $(head -n 1 "$dir/log")"
    # Also with an unknown processor llvm-mca may end well.
    ! grep -q "not a recognized processor" "$dir/log" || fail "$mca does not know the processor $cpu"
    awk -v isa="$isa" -v lanes="$lanes" -v cpu="$cpu" '
      /Code Region - / { kernel = $NF }
      /^Iterations:/ { iterations = $2 }
      /^Total Cycles:/ { print isa, lanes, cpu, kernel, $3 / iterations }' "$dir/out" >>"$dir/cycles"
  done
}
# Clang has no such option, and schedules so by itself.
scheduler="-fschedule-insns -fsched-pressure"
"$cxx" --version | grep -q clang && scheduler=""
measure sse42 2 4 'xsimd::batch<float,xsimd::sse4_2>' -msse4.2
measure avx2 2 8 'xsimd::batch<float,xsimd::avx2>' -mavx2
measure avx512 4 16 'xsimd::batch<float,xsimd::avx512bw>' -mavx512f -mavx512cd -mavx512dq -mavx512bw

awk -v cpus="$cpus" '
  BEGIN { columns = split(cpus, cpu) }
  { cycles[$1, $3, $4] = $5 / $2 }
  !($4 in seen) { seen[$4] = kernel[++kernels] = $4 }
  END {
    printf "| cycles per sample | |"
    for (c = 1; c <= columns; ++c) printf " %s |", cpu[c]
    printf "\n|---|---|"
    for (c = 1; c <= columns; ++c) printf "---:|"
    printf "\n"
    isas = split("sse42 avx2 avx512", isa)
    for (k = 1; k <= kernels; ++k)
      for (i = 1; i <= isas; ++i) {
        printf "| %s | %s |", kernel[k], isa[i]
        for (c = 1; c <= columns; ++c) printf " %.2f |", cycles[isa[i], cpu[c], kernel[k]]
        printf "\n"
      }
  }' "$dir/cycles"
