// Two-sided reflection, of any surface: block after block, views from below are mirrored to the upper side, and what a
// one-sided call makes of them is mirrored back. Kernels know nothing of it.
#pragma once

#include <cmath>

#include "dispatch.h"

namespace vndf {

// Columns from an index on.
inline Column from(const Column& c, std::size_t i) noexcept {
  return c.data ? Column(c.data + i) : c;
}
inline Columns2 from(const Columns2& c, std::size_t i) noexcept {
  return {from(c.x, i), from(c.y, i)};
}
inline Ellipsoid from(const Ellipsoid& e, std::size_t i) noexcept {
  return {from(e.alpha, i), from(e.theta_x, i), from(e.theta_y, i), from(e.theta_z, i)};
}
inline const Shape& from(const Shape& shape, std::size_t) noexcept {
  return shape;
}
inline float* from(float* out, std::size_t i) noexcept {
  return out ? out + i : nullptr;
}
inline Out3 from(const Out3& out, std::size_t i) noexcept {
  return {from(out.x, i), from(out.y, i), from(out.z, i)};
}

constexpr std::size_t kTwoSidedBlock = 512;

/// A block of wo.z, which the call may overwrite, and of what it is on the upper side. -0 is below, as its sign says.
struct Heights {
  std::size_t n;
  float z[kTwoSidedBlock], upper[kTwoSidedBlock];

  Heights(const Column& wo_z, std::size_t begin, std::size_t count) noexcept
      : n(count - begin < kTwoSidedBlock ? count - begin : kTwoSidedBlock) {
    for (std::size_t i = 0; i < n; ++i) z[i] = wo_z.data ? wo_z.data[begin + i] : wo_z.value;
    mirror(z, 0, upper);
  }
  void mirror(const Column& from, std::size_t begin, float* to) const noexcept {
    for (std::size_t i = 0; i < n; ++i) {
      float other = from.data ? from.data[begin + i] : from.value;
      to[i] = std::signbit(z[i]) ? -other : other;
    }
  }
};

}  // namespace vndf
