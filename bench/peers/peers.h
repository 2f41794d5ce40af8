// Other ways to sample GGX normals, written from the mathematics of their papers, to be measured as published.
#pragma once

#include <cstddef>

namespace peers {

/// The columns of a batch in the order of ../inputs.h, as far as the peer reads and writes them. One that samples
/// normals reads the first seven, wo.x, wo.y, wo.z, alpha_x, alpha_y, u1, u2, and writes the first three, wm.x, wm.y,
/// wm.z. Others do what the library's operation does in the benchmark, with the same columns.
using Sample = void(std::size_t count, const float* const in[], float* const out[]);

/// The same map of the same float inputs, in long double throughout.
using Oracle = void(std::size_t count, const float* const in[7], long double* const out[3]);

/// One peer, compiled for one instruction set.
struct Peer {
  const char* name;       ///< first part of a benchmark's name
  const char* operation;  ///< that of the library which it does, or "sample_ndf" (all normals)
  const char* warp;       ///< a parameterisation of the library's, "own", or "none"
  const char* isa;        ///< "scalar", "sse42", "avx2", "avx512"
  bool supported;         ///< by this processor and its operating system
  int columns;            ///< read and written
  Sample* sample;
  Oracle* oracle;  ///< the peer's formulas in long double, the measure of its rounding errors; null: not measured
};

struct Peers {
  const Peer* first;
  const Peer* last;
  const Peer* begin() const { return first; }
  const Peer* end() const { return last; }
};

/// Those compiled in, the plain listing first.
Peers peers();

/// How far the fitted curve of heitz_deon_2014 is from the inverse that it stands for, in exact arithmetic, over a grid
/// of 2^20 midpoints of the random number: no rounding errors of anything in it.
struct FitError {
  double max_slope, mean_slope;    ///< relative error of slope_y
  double max_normal, mean_normal;  ///< distance of the unit normals, at unit roughness and slope_x = 0
};
FitError heitz_deon_2014_fit_error();

}  // namespace peers
