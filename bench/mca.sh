#!/bin/sh
# Estimates the kernels' cycles per sample on processors that are not at hand, with llvm-mca.
usage() {
  cat <<'END'
Usage: bench/mca.sh [--help] [--stages] [CPU...]

Compiles the stages of the sampling kernels (bench/mca.cpp) for each instruction set, runs llvm-mca over one iteration of
each for every CPU (default: znver4 skylake-avx512 icelake-server sapphirerapids), and prints a Markdown table of cycles
per sample: the stages' cycles, in the steady state, summed over the warp and divided by the vector width.
--stages prints the stages one by one instead.

Caches are taken as warm. The scalar set is left out: compilers give it branches, which llvm-mca cannot follow. Environment: CXX, the compiler (c++); CXXFLAGS, options added to it, e.g.
-I with the place of xsimd; LLVM_MCA, the program (the newest one found).
END
}

fail() {
  echo "mca.sh: $*" >&2
  exit 2
}

stages=0
cpus=""
for argument in "$@"; do
  case $argument in
    -h | --help) usage; exit 0 ;;
    --stages) stages=1 ;;
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

# measure isa width batch flag...: appends lines "isa width cpu stage cycles" to $dir/cycles.
measure() {
  isa=$1 width=$2 batch=$3
  shift 3
  # Word splitting is meant: several options.
  # shellcheck disable=SC2086
  "$cxx" -std=c++17 -O3 -ffp-contract=off -fno-math-errno -I"$root/include" ${CXXFLAGS:-} "$@" -DVNDF_BATCH="$batch" \
    -S "$root/bench/mca.cpp" -o "$dir/$isa.s" 2>"$dir/log" || fail "cannot compile for $isa: $(grep -m1 error "$dir/log")"
  for cpu in $cpus; do
    "$mca" -mcpu="$cpu" -iterations=1000 "$dir/$isa.s" >"$dir/out" 2>"$dir/log" ||
      fail "$mca fails for $cpu: $(head -n 1 "$dir/log")"
    # Also with an unknown processor llvm-mca may end well.
    ! grep -q "not a recognized processor" "$dir/log" || fail "$mca does not know the processor $cpu"
    awk -v isa="$isa" -v width="$width" -v cpu="$cpu" '
      /Code Region - / { stage = $NF }
      /^Iterations:/ { iterations = $2 }
      /^Total Cycles:/ { print isa, width, cpu, stage, $3 / iterations }' "$dir/out" >>"$dir/cycles"
  done
}
measure sse42 4 'xsimd::batch<float,xsimd::sse4_2>' -msse4.2
measure avx2 8 'xsimd::batch<float,xsimd::avx2>' -mavx2
measure avx512 16 'xsimd::batch<float,xsimd::avx512bw>' -mavx512f -mavx512cd -mavx512dq -mavx512bw

awk -v cpus="$cpus" -v by_stage="$stages" '
  BEGIN {
    disk = "chord scale_view elevation_of reproject map_from_hemisphere"
    warps = by_stage ? "polar_map concentric_map " disk " cap_view on_cap" : "polar concentric spherical_cap"
    parts["polar"] = "polar_map " disk
    parts["concentric"] = "concentric_map " disk
    parts["spherical_cap"] = "cap_view on_cap map_from_hemisphere"
    rows = split(warps, warp)
    columns = split(cpus, cpu)
  }
  { cycles[$1, $3, $4] = $5 / $2 }
  END {
    printf "| cycles per sample | |"
    for (c = 1; c <= columns; ++c) printf " %s |", cpu[c]
    printf "\n|---|---|"
    for (c = 1; c <= columns; ++c) printf "---:|"
    printf "\n"
    isas = split("sse42 avx2 avx512", isa)
    for (r = 1; r <= rows; ++r)
      for (i = 1; i <= isas; ++i) {
        printf "| %s | %s |", warp[r], isa[i]
        for (c = 1; c <= columns; ++c) {
          n = split(by_stage ? warp[r] : parts[warp[r]], part)
          sum = 0
          for (p = 1; p <= n; ++p) sum += cycles[isa[i], cpu[c], part[p]]
          printf " %.2f |", sum
        }
        printf "\n"
      }
  }' "$dir/cycles"
