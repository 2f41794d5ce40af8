// The GGX distribution of normals, and the density of visible ones, in forms without division by a cosine.
#pragma once

#include <vndf/lanes/masking.h>
#include <vndf/lanes/shape_for_pairs.h>

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

constexpr float kInvPi = 0x1.45f306p-2f;
constexpr float kInv2Pi = 0x1.45f306p-3f;

/// The largest density there is: that of a mirror. Finite, so that the weights of multiple importance sampling, with
/// squares of densities in them, are those of a delta and not NaN.
constexpr float kDelta = 0x1p60f;
template <class F>
VNDF_INLINE F at_most_delta(F pdf) {
  return op::select(pdf > F(kDelta), F(kDelta), pdf);
}

/// D(m), Heitz 2018, eq. 1, Walter et al. 2015, eq. 1, for m of any length from 2^-70 to 2, up to its division. Of a
/// shorter m it is finite, and may be 0.
///
/// With |A| = a b, D = (a / b) (a |m|^2 / k^2)^2 / pi with k = a A^-T m: that stays within the range of float, which
/// alpha^2 does not. For plain GGX a is alpha_x, b is alpha_y, and k^2 is a sum of positive terms. kUnit centres its
/// range, which is that of |m| times 2^+-27, between the ends of float's.
template <class F>
struct NdfTerms {
  F a_m2, k2, a_over_b;
};
template <class F, class Shape = Vec2<F>>
VNDF_INLINE NdfTerms<F> ndf_terms(const Vec3<F>& m, const Shape& shape) {
  constexpr float kUnit = 0x1p34f;
  Vec3<F> v = {m.x * F(kUnit), m.y * F(kUnit), m.z * F(kUnit)};
  auto k = unstretch(v, shape);
  return {dot(v, v) * k.a, dot(k.v, k.v) + F(0x1p-126f), k.a_over_b};
}
template <class F>
VNDF_INLINE F ndf(const NdfTerms<F>& terms) {
  F q = terms.a_m2 / terms.k2;
  return (terms.a_over_b * F(kInvPi)) * (q * q);
}
template <class F, class Shape = Vec2<F>>
VNDF_INLINE F ndf(const Vec3<F>& m, const Shape& shape) {
  return ndf(ndf_terms(m, shape));
}

/// Of a view and a normal, what comes before the divisions of their density.
template <class F>
struct NormalTerms {
  NdfTerms<F> ndf;
  F cos, area;
};
template <class F, class Shape = Vec2<F>>
VNDF_INLINE NormalTerms<F> normal_terms(const Vec3<F>& v, const Vec3<F>& m, const Shape& shape) {
  return {ndf_terms(m, shape), dot(v, m), lune_area(stretch(v, narrowed(shape)))};
}

/// The density of visible normals, eq. 3 (Walter et al. 2015, eq. 33), for any view, m of the upper hemisphere:
/// 2 D(m) max(0, v.m) / (|A v| + (A v).z).
template <class F>
VNDF_INLINE F visible_normal_pdf(F m_z, const NormalTerms<F>& terms) {
  F area = terms.area + F(0x1p-125f);  // there is none along an axis where alpha is 0
  F pdf = at_most_delta(((terms.cos + terms.cos) / area) * ndf(terms.ndf));
  return op::select(terms.cos > F(0.f), op::select(m_z < F(0.f), F(0.f), pdf), F(0.f));
}
template <class F, class Shape = Vec2<F>>
VNDF_INLINE F visible_normal_pdf(const Vec3<F>& v, const Vec3<F>& m, const Shape& shape) {
  return visible_normal_pdf(m.z, normal_terms(v, m, shape));
}

}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
