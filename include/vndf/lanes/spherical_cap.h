// Dupuy and Benyoub 2023: visible hemisphere normals as half vectors of the view and a uniform point of a spherical
// cap.
#pragma once

#include <vndf/lanes/hemisphere.h>

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

/// Nh = c + Vh for c uniform on the cap c.z >= -Vh.z, up to a positive factor (Dupuy and Benyoub 2023, Listing 3), from
/// u1 for the azimuth and u2 for the height of c.
///
/// c.z + Vh.z = (1 - u2) (1 + Vh.z), and 1 - c.z^2 = u2 (1 - Vh.z^2 + (1 + Vh.z) (c.z + Vh.z)): no difference is taken.
/// What stays is the sum c + Vh where c is nearly -Vh.
template <class F>
VNDF_INLINE Vec3<F> sample_cap(Vec3<F> wo, Vec2<F> alpha, Vec2<F> u) {
  F hx = alpha.x * wo.x;
  F hy = alpha.y * wo.y;
  Int<F> larger = op::max(op::max(op::bits(op::abs(hx)), op::bits(op::abs(hy))), op::bits(op::abs(wo.z)));
  Int<F> exponent = op::max(larger, Int<F>(0x00800000)) & Int<F>(0x7f800000);
  F scale = op::from_bits(Int<F>(0x7f000000) - exponent);
  F x = hx * scale;
  F y = hy * scale;
  F abs_z = op::abs(wo.z * scale);

  F r2 = x * x + y * y;
  F sum = op::sqrt(r2 + abs_z * abs_z) + abs_z;  // len (1 + |z|)
  F len_plus_z = op::select(wo.z < F(0.f), r2 / sum, sum);
  F z = (F(1.f) - u.y) * len_plus_z;
  F radius = op::sqrt(u.y * (r2 + len_plus_z * z));
  Angle<F> phi = sincos2pi(u.x);
  return {radius * phi.cos + x, radius * phi.sin + y, z};
}

}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
