// Reflection and refraction at a visible normal of a rough dielectric (Walter et al. 2007).
//
// eta is the index on the other side of the surface over the one on the view's. c = wo.wm, and g = eta cos of the angle
// of refraction: g^2 = eta^2 - 1 + c^2.
#pragma once

#include <vndf/lanes/reflection.h>

#include <type_traits>

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

/// c, kept from 0, and g: 0 where reflection is total.
template <class F>
struct Cosines {
  F c, g;
};
template <class F>
VNDF_INLINE Cosines<F> cosines(F cos, F eta) {
  F c = cos + F(0x1p-62f);
  F g2 = (eta - F(1.f)) * (eta + F(1.f)) + c * c;
  return {c, op::sqrt(op::select(g2 > F(0.f), g2, F(0.f)))};
}

/// Fresnel's equations for unpolarised light.
template <class F>
struct Fresnel {
  F reflected, transmitted;  // shares; their sum is 1 but for rounding
  F bend;                    // c - g: wm's share in eta wi = (c - g) wm - wo
};

/// Walter et al. 2007, eq. 22. Every difference is taken of eta alone: c - g = (1 - eta^2) / (c + g), and eta^2 c - g =
/// (eta^2 - 1) ((eta^2 + 1) c^2 - 1) / (eta^2 c + g), so eta near 1 costs no digits, and neither does the small one of
/// the two shares.
template <class F>
VNDF_INLINE Fresnel<F> fresnel(const Cosines<F>& cos, F eta) {
  const auto& [c, g] = cos;
  F eta2 = eta * eta;
  F more = (eta - F(1.f)) * (eta + F(1.f));  // eta^2 - 1
  F c2 = c * c;
  auto total = g > F(0.f);  // no total reflection
  F s = F(1.f) / (c + g);
  F p = F(1.f) / (eta2 * c + g);
  F s2 = s * s;
  F p2 = p * p;
  F rs = more * s2;
  F rp = (more * p2) * (((eta2 + F(1.f)) * c2) - F(1.f));
  F cg = c * g;
  return {op::select(total, (rs * rs + rp * rp) * F(0.5f), F(1.f)),
          op::select(total, (cg + cg) * (s2 + eta2 * p2), F(0.f)), F(0.f) - more * s};
}

template <class F>
VNDF_INLINE Fresnel<F> fresnel(F cos, F eta) {
  return fresnel(cosines(cos, eta), eta);
}

/// The density of a refracted direction over that of the reflected one, both without Fresnel's factor: 4 c times
/// |d wm / d wi| = eta g / (c - g)^2 (eq. 17 of Walter et al. 2007, with the index of the view's side 1).
template <class F>
VNDF_INLINE F refraction_over_reflection(const Cosines<F>& cos, F bend, F eta) {
  F j = (cos.c * cos.g) * eta;
  return (j + j + j + j) / (bend * bend);
}

/// What light does at a facet, and the factors that the density of a reflected direction has there.
template <class F>
struct Crossing {
  F side;      // 1: reflected, -1: refracted
  F share;     // Fresnel's
  F jacobian;  // 1, or refraction over reflection
  F bend;      // as in Fresnel
};

/// Reflection where u is below Fresnel's share of it, else refraction.
template <class F>
VNDF_INLINE Crossing<F> choose_side(const Cosines<F>& cos, F eta, F u) {
  auto f = fresnel(cos, eta);
  auto reflects = u < op::select(f.transmitted > F(0.f), f.reflected, F(2.f));
  return {op::select(reflects, F(1.f), F(-1.f)), op::select(reflects, f.reflected, f.transmitted),
          op::select(reflects, F(1.f), refraction_over_reflection(cos, f.bend, eta)), f.bend};
}

/// `reflected`, or eta wi = (c - g) wm - wo.
template <class F>
VNDF_INLINE Vec3<F> leave(const Vec3<F>& wo, const Vec3<F>& reflected, const Vec3<F>& wm, const Crossing<F>& at,
                          F eta) {
  auto reflects = at.side > F(0.f);
  F inv_eta = F(1.f) / eta;
  return {op::select(reflects, reflected.x, (at.bend * wm.x - wo.x) * inv_eta),
          op::select(reflects, reflected.y, (at.bend * wm.y - wo.y) * inv_eta),
          op::select(reflects, reflected.z, (at.bend * wm.z - wo.z) * inv_eta)};
}

/// A view from below sees the surface turned upside down: everything is mirrored in the origin, which leaves A as it
/// is, and eta is that of the other way.
template <class F>
VNDF_INLINE Vec3<F> mirrored(Mask<F> below, const Vec3<F>& v) {
  return {op::select(below, F(0.f) - v.x, v.x), op::select(below, F(0.f) - v.y, v.y),
          op::select(below, F(0.f) - v.z, v.z)};
}
template <class F>
VNDF_INLINE F mirrored_eta(Mask<F> below, F eta) {
  return op::select(below, F(1.f) / eta, eta);
}

/// The weight of refraction, G1(wi), the masking of the two sides being independent. `length_i` = |A wi|.
template <class F>
VNDF_INLINE F refraction_weight(F wi_z, F length_i) {
  return at_most_one((wi_z + wi_z) / (wi_z + length_i));
}

/// Lunes do not tell the sides apart: their weight is the one of reflection for either.
template <class Masking>
constexpr bool kTellsSides = std::is_base_of_v<ByLengths, Masking>;

/// The weight of a direction on the view's side or across, where G is that of wi turned to the view's side, Walter et
/// al. 2015, eq. 7. Lengths are the same turned or not.
template <class Masking, class F, class Shape = Vec2<F>>
VNDF_INLINE typename Masking::template Light<F> dielectric_light(F side, const Vec3<F>& wi, const Shape& shape) {
  if constexpr (kTellsSides<Masking>)
    return Masking::light(wi, shape);
  else
    return Masking::light(mirrored(side < F(0.f), wi), shape);
}
template <class Masking, class F>
VNDF_INLINE F dielectric_weight(F side, F wo_z, F length, F area, F wi_z,
                                const typename Masking::template Light<F>& light) {
  F weight = Masking::weight(wo_z, length, area, wi_z, light);
  if constexpr (kTellsSides<Masking>)
    weight = op::select(side > F(0.f), weight, refraction_weight(F(0.f) - wi_z, light));
  return weight;
}

/// Of a sampled direction.
template <class Masking, class F>
VNDF_INLINE Weighed<F> weigh_dielectric(F wo_z, F length, F area, F wi_z, F spread, const Crossing<F>& at,
                                        const typename Masking::template Light<F>& light) {
  F height = at.side * wi_z;
  F weight = dielectric_weight<Masking>(at.side, wo_z, length, area, wi_z, light);
  return {where_above(wo_z, height, ((F(kInv2Pi) / spread) * at.share) * at.jacobian),
          where_above(wo_z, height, weight)};
}

template <class F>
struct DielectricSample {
  Vec3<F> wi;
  F pdf, weight;
  F side;
};

/// For a view and its eta that have been turned to the upper hemisphere, see `mirrored`, with its facet; wi is to be
/// turned back. The shape is as for sample_reflection.
template <class Masking, class F, class Shape = Vec2<F>>
VNDF_INLINE DielectricSample<F> sample_dielectric(const Vec3<F>& wo, const Shape& shape, const Facet<F>& facet, F eta,
                                                  F u) {
  auto normal = normal_of(facet, shape);
  auto unit = unit_normal(facet, normal);
  auto at = choose_side(cosines(unit.cos, eta), eta, u);
  Vec3<F> wi = leave(wo, reflect(wo, facet, normal), unit.wm, at, eta);
  auto weighed = weigh_dielectric<Masking>(wo.z, facet.length, facet.area, wi.z, spread(facet, normal, shape), at,
                                           dielectric_light<Masking>(at.side, wi, shape));
  return {wi, weighed.pdf, weighed.weight, at.side};
}

/// Of a pair whose view has been turned to the upper hemisphere. The normal is that of wo + wi, or of wo + eta wi
/// across the surface (eq. 13 and 16).
template <class Masking, class F>
struct DielectricTerms {
  PairTerms<Masking, F> pair;
  F cos_o, cos_i, h2;  // wo.h, wi.h, |h|^2
};
template <class Masking, class F, class Shape = Vec2<F>>
VNDF_INLINE DielectricTerms<Masking, F> dielectric_terms(const Vec3<F>& wo, const Vec3<F>& wi, const Shape& shape,
                                                         F eta) {
  auto reflects = wi.z >= F(0.f);
  F e = op::select(reflects, F(1.f), eta);
  Vec3<F> h = {wo.x + e * wi.x, wo.y + e * wi.y, wo.z + e * wi.z};
  h = mirrored(h.z < F(0.f), h);
  F side = op::select(reflects, F(1.f), F(-1.f));
  return {pair_terms<Masking>(wo, h, shape, dielectric_light<Masking>(side, wi, narrowed(shape))), dot(wo, h),
          dot(wi, h), dot(h, h)};
}

template <class Masking, class F>
VNDF_INLINE Cosines<F> cosines_of(const DielectricTerms<Masking, F>& terms, F eta) {
  return cosines(terms.cos_o / op::sqrt(terms.h2), eta);
}

/// The pair is impossible where either direction is at the back of its normal: then the share is 0.
template <class Masking, class F>
VNDF_INLINE Crossing<F> crossing_of(F wi_z, const DielectricTerms<Masking, F>& terms, const Cosines<F>& cos, F eta) {
  auto f = fresnel(cos, eta);
  auto reflects = wi_z >= F(0.f);
  auto refracts = (terms.cos_o > F(0.f)) & (terms.cos_i < F(0.f));
  return {op::select(reflects, F(1.f), F(-1.f)),
          op::select(reflects, f.reflected, op::select(refracts, f.transmitted, F(0.f))),
          op::select(reflects, F(1.f), refraction_over_reflection(cos, f.bend, eta)), f.bend};
}

template <class Masking, class F>
VNDF_INLINE Evaluation<F> evaluate_crossing(F wo_z, F wi_z, const PairTerms<Masking, F>& pair, const Crossing<F>& at) {
  F pdf = (pair_pdf(pair) * at.share) * at.jacobian;
  pdf = where_above(wo_z, op::abs(wi_z), op::select(at.share > F(0.f), pdf, F(0.f)));
  F weight = dielectric_weight<Masking>(at.side, wo_z, pair.length, pair.area, wi_z, pair.light);
  return {op::select(pdf > F(0.f), pdf * weight, F(0.f)), pdf};
}

template <class Masking, class F, class Shape = Vec2<F>>
VNDF_INLINE Evaluation<F> evaluate_dielectric(const Vec3<F>& wo, const Vec3<F>& wi, const Shape& shape, F eta) {
  auto terms = dielectric_terms<Masking>(wo, wi, shape, eta);
  return evaluate_crossing(wo.z, wi.z, terms.pair, crossing_of(wi.z, terms, cosines_of(terms, eta), eta));
}

}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
