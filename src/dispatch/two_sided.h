// Two-sided reflection, of any surface: block after block, views from below are mirrored to the upper side, and what a
// one-sided call makes of them is mirrored back. Kernels know nothing of it.
#pragma once

#include <cstring>

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

constexpr std::uint32_t kSign = 0x80000000u;
inline std::uint32_t bits(float value) noexcept {
  std::uint32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}
inline float from_bits(std::uint32_t bits) noexcept {
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

constexpr std::size_t kTwoSidedBlock = 512;

/// A block of wo.z, which the call may overwrite, and of |wo.z|.
struct Heights {
  std::size_t n;
  float z[kTwoSidedBlock], upper[kTwoSidedBlock];

  Heights(const Column& wo_z, std::size_t begin, std::size_t count) noexcept
      : n(count - begin < kTwoSidedBlock ? count - begin : kTwoSidedBlock) {
    for (std::size_t i = 0; i < n; ++i) {
      z[i] = wo_z.data ? wo_z.data[begin + i] : wo_z.value;
      upper[i] = from_bits(bits(z[i]) & ~kSign);
    }
  }

  float mirrored(float other_z, std::size_t i) const noexcept {
    return from_bits(bits(other_z) ^ (bits(z[i]) & kSign));
  }
  void mirror(float* other_z) const noexcept {
    for (std::size_t i = 0; i < n; ++i) other_z[i] = mirrored(other_z[i], i);
  }
  void mirror(const Column& in, std::size_t begin, float* out) const noexcept {
    for (std::size_t i = 0; i < n; ++i) out[i] = mirrored(in.data ? in.data[begin + i] : in.value, i);
  }
};

}  // namespace vndf
