// Masking of the ellipsoid NDF (Walter et al. 2015). The rest of it is that of plain GGX, with another shape.
#pragma once

#include <vndf/lanes/reflection.h>

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

/// G = G1(wo) G1(wi), eq. 5, with G1(v) = min(1, 2 v.z / (|A v| + (A v).z)), eq. 6. Leaning ellipsoids can show less
/// than the surface that they stand for; the minimum keeps G1 plausible.
struct Lunes {
  /// Eq. 50: G1(wo) G1(wi) area / (2 wo.z), which is min(1, area / (2 wo.z)) G1(wi). Each is a quotient of a smaller
  /// number and a larger one, and one division takes both, so that it exceeds 1 by no rounding.
  template <class F>
  static VNDF_INLINE F weight(F wo_z, F area, F wi_z, const Vec3<F>& stretched_wi) {
    const Vec3<F>& h = stretched_wi;
    F whole_o = wo_z + wo_z;
    auto less = area < whole_o;
    F l2 = h.x * h.x + h.y * h.y;
    F sum = op::sqrt(l2 + h.z * h.z) + op::abs(h.z);
    auto below = h.z < F(0.f);  // where |h| + h.z = l2 / sum
    F whole_i = wi_z + wi_z;
    whole_i = op::select(below, whole_i * sum, whole_i);
    F area_i = op::select(below, l2, sum);
    whole_i = op::select(whole_i < area_i, whole_i, area_i);
    return (op::select(less, area, F(1.f)) * whole_i) / (op::select(less, whole_o, F(1.f)) * area_i);
  }
};

}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
