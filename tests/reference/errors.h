// How far computed normals are from the oracle's.
#pragma once

#include <cmath>

#include "reference/oracle.h"

namespace vndf::reference {

/// The unit of all errors: the largest error of rounding to float in [1/2, 1].
constexpr double kEps = 0x1p-24;

/// NaN is an error that no bound holds for.
inline double or_infinite(double error) {
  return std::isnan(error) ? INFINITY : error;
}
/// Whether this error is the largest yet, which it is from now on. NaN is larger than any number; std::max and
/// std::fmax would pass over it.
inline bool keep_larger(double& largest, double error) {
  if (error <= largest) return false;
  largest = or_infinite(error);
  return true;
}

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
