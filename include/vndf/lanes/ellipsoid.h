// Masking of the ellipsoid NDF (Walter et al. 2015). The rest of it is that of plain GGX, with another shape.
#pragma once

#include <vndf/lanes/reflection.h>
#include <vndf/lanes/tilted_shape.h>

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

/// G = G1(wo) G1(wi), eq. 5, with G1(v) = min(1, 2 v.z / (|A v| + (A v).z)), eq. 6. Leaning ellipsoids can show less
/// than the surface that they stand for; the minimum keeps G1 plausible.
struct Lunes {
  /// G1 as a quotient of two positive numbers.
  template <class F>
  struct Light {
    F numerator, denominator;
  };
  template <class F, class Shape>
  static VNDF_INLINE Light<F> light(const Vec3<F>& wi, const Shape& shape) {
    Vec3<F> h = stretch(wi, shape);
    F l2 = h.x * h.x + h.y * h.y;
    F sum = op::sqrt(l2 + h.z * h.z) + op::abs(h.z);
    auto below = h.z < F(0.f);  // where |h| + h.z = l2 / sum
    F whole = wi.z + wi.z;
    whole = op::select(below, whole * sum, whole);
    F area = op::select(below, l2, sum);
    return {op::from_bits(op::min(op::bits(whole), op::bits(area))), area};
  }

  /// Eq. 50: G1(wo) G1(wi) area / (2 wo.z), which is min(1, area / (2 wo.z)) G1(wi). Each is a quotient of a smaller
  /// number and a larger one, and one division takes both, so that it exceeds 1 by no rounding. The minimum and the
  /// maximum are those of bits, for positive numbers; what the others give is not used.
  template <class F>
  static VNDF_INLINE F weight(F wo_z, F, F area, F, const Light<F>& light) {
    F larger = op::from_bits(op::max(op::bits(area), op::bits(wo_z + wo_z)));
    return at_most_one((area * light.numerator) / (larger * light.denominator));
  }
};

}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
