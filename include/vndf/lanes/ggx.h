// GGX: the distribution of normals, Smith's masking, and the densities of visible normals, in forms without division
// by a cosine.
//
// With a = |A v|, A = diag(alpha_x, alpha_y, 1), everything of masking is rational in a and v.z:
// 1 + Lambda(v) = (a + v.z) / (2 v.z), and (a + v.z) / 2 is the projected area of what v sees.
#pragma once

#include <vndf/lanes/hemisphere.h>

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

constexpr float kInvPi = 0x1.45f306p-2f;
constexpr float kInv2Pi = 0x1.45f306p-3f;

template <class F>
VNDF_INLINE F dot(const Vec3<F>& a, const Vec3<F>& b) {
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}

/// |A v|.
template <class F>
VNDF_INLINE F stretched_length(const Vec3<F>& v, const Vec2<F>& alpha) {
  F x = alpha.x * v.x;
  F y = alpha.y * v.y;
  return op::sqrt((x * x + y * y) + v.z * v.z);
}

/// The roughness that densities are evaluated with: at least 2^-60, which keeps a mirror's finite.
template <class F>
VNDF_INLINE F evaluated_alpha(F alpha) {
  constexpr float kMirror = 0x1p-60f;
  F abs = op::abs(alpha);
  return op::select(abs < F(kMirror), F(kMirror), abs);
}

/// D(m), Heitz 2018, eq. 1, for m of any length from 2^-40 to 8.
///
/// D = (alpha_x / alpha_y) (alpha_x |m|^2 / k^2)^2 / pi with k = (m.x, m.y alpha_x / alpha_y, alpha_x m.z): sums of
/// positive terms that stay within the range of float, which alpha^2 does not.
template <class F>
VNDF_INLINE F ndf(const Vec3<F>& m, const Vec2<F>& alpha) {
  constexpr float kUnit = 0x1p40f;
  F alpha_x = evaluated_alpha(alpha.x);
  F ratio = alpha_x / evaluated_alpha(alpha.y);
  Vec3<F> v = {m.x * F(kUnit), m.y * F(kUnit), m.z * F(kUnit)};
  F ky = v.y * ratio;
  F kz = v.z * alpha_x;
  F q = (dot(v, v) * alpha_x) / ((v.x * v.x + ky * ky) + kz * kz);
  return (ratio * F(kInvPi)) * (q * q);
}

/// Lambda(v), eq. 2, for v.z > 0: (a - v.z) / (2 v.z) with the difference taken apart.
template <class F>
VNDF_INLINE F smith_lambda(const Vec3<F>& v, const Vec2<F>& alpha) {
  F x = alpha.x * v.x;
  F y = alpha.y * v.y;
  F l2 = x * x + y * y;
  return l2 / ((op::sqrt(l2 + v.z * v.z) + v.z) * (v.z + v.z));
}

/// G1(v), eq. 2; 0 for v.z <= 0.
template <class F>
VNDF_INLINE F smith_g1(const Vec3<F>& v, const Vec2<F>& alpha) {
  return op::select(v.z > F(0.f), (v.z + v.z) / (stretched_length(v, alpha) + v.z), F(0.f));
}

/// G2(v, l) = 1 / (1 + Lambda(v) + Lambda(l)), height-correlated (Heitz 2014, eq. 99); 0 where either is not above the
/// horizon.
template <class F>
VNDF_INLINE F smith_g2_correlated(const Vec3<F>& v, const Vec3<F>& l, const Vec2<F>& alpha) {
  F area = stretched_length(v, alpha) * l.z + stretched_length(l, alpha) * v.z;
  F g2 = ((v.z + v.z) * l.z) / area;
  return op::select(v.z > F(0.f), op::select(l.z > F(0.f), g2, F(0.f)), F(0.f));
}

/// G2(v, l) = G1(v) G1(l), separable.
template <class F>
VNDF_INLINE F smith_g2_separable(const Vec3<F>& v, const Vec3<F>& l, const Vec2<F>& alpha) {
  return smith_g1(v, alpha) * smith_g1(l, alpha);
}

/// The density of visible normals, eq. 3, for any view, m of the upper hemisphere: 2 D(m) max(0, v.m) / (a + v.z), and
/// a + v.z = |(alpha_x v.x, alpha_y v.y)|^2 / (a - v.z) below the horizon.
template <class F>
VNDF_INLINE F visible_normal_pdf(const Vec3<F>& v, const Vec3<F>& m, const Vec2<F>& alpha) {
  F x = alpha.x * v.x;
  F y = alpha.y * v.y;
  F l2 = x * x + y * y;
  F sum = op::sqrt(l2 + v.z * v.z) + op::abs(v.z);
  sum = op::select(v.z < F(0.f), l2 / sum, sum);
  F cos = dot(v, m);
  F pdf = ((cos + cos) / sum) * ndf(m, alpha);
  return op::select(cos > F(0.f), op::select(m.z < F(0.f), F(0.f), pdf), F(0.f));
}

}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
