// How far computed normals are from the oracle's.
#pragma once

#include "reference/oracle.h"

namespace vndf::reference {

/// The unit of all errors: the largest error of rounding to float in [1/2, 1].
constexpr double kEps = 0x1p-24;

struct NormalErrors {
  // Euclidean distance from the oracle, in eps; infinite for NaN.
  double mean = 0, p999 = 0, max = 0;
  std::size_t worst = 0;
  // |(d wm.x / alpha_x, d wm.y / alpha_y)|.
  double max_slope = 0;
  // The same, divided by a thousandth of |(wm.x / alpha_x, wm.y / alpha_y)| where that is more than 1. A normal a
  // thousand alphas from +z has a slope error of 3e-5 by the rounding of wm alone, and one a million from it 0.03.
  double max_resolved_slope = 0;
  std::size_t worst_slope = 0;
  // | |wm| - 1 |, in eps.
  double max_norm = 0;
  std::size_t worst_norm = 0;
};

NormalErrors measure(const Inputs& in, const OracleNormals& oracle, const float* wm_x, const float* wm_y,
                     const float* wm_z);

}  // namespace vndf::reference
