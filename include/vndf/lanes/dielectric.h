// Reflection and refraction at a visible normal of a rough dielectric (Walter et al. 2007).
//
// eta is the index on the other side of the surface over the one on the view's. c = wo.wm, and g = eta cos of the angle
// of refraction: g^2 = eta^2 - 1 + c^2.
#pragma once

#include <vndf/lanes/reflection.h>

#include <type_traits>

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

/// eta, the index on the other side over the one on the view's, and eta - 1 with the digits that 1 / eta loses; and the
/// index that was given, the one below the surface over the one above.
template <class F>
struct Index {
  F eta, minus_1, given;
};
/// Views from below see the inverse.
template <class F>
VNDF_INLINE Index<F> index_seen(Mask<F> from_below, F given) {
  F inv = F(1.f) / given;
  F minus_1 = given - F(1.f);
  return {op::select(from_below, inv, given), op::select(from_below, F(0.f) - minus_1 * inv, minus_1), given};
}
template <class F>
VNDF_INLINE F squared_minus_1(const Index<F>& index) {
  return index.minus_1 * (index.eta + F(1.f));
}

/// Where the index differs by less, the surface is index-matched: light passes straight on, as a delta.
constexpr float kIndexMatched = 0x1p-16f;
template <class F>
VNDF_INLINE Mask<F> index_matched(const Index<F>& index) {
  return op::abs(index.minus_1) < F(kIndexMatched);
}
/// Not so 0, negative numbers, infinity and NaN.
template <class F>
VNDF_INLINE Mask<F> possible(const Index<F>& index) {
  return (index.eta > F(0x1p-20f)) & (index.eta < F(0x1p20f));
}

/// Where squares and inverses of eta magnify what is rounded beside them.
template <class F>
VNDF_INLINE Mask<F> is_small(const Index<F>& index) {
  return index.eta < F(0.5f);
}

/// c, kept from 0, and g: 0 where reflection is total.
template <class F>
struct Cosines {
  F c, g;
};

template <class F>
VNDF_INLINE F root_of_positive(F a) {
  return op::sqrt(op::select(a > F(0.f), a, F(0.f)));
}
template <class F>
VNDF_INLINE Cosines<F> cosines(F cos, const Index<F>& index) {
  F c = cos + F(0x1p-62f);
  return {c, root_of_positive(squared_minus_1(index) + c * c)};
}

/// What Snell's law needs: t = wo - c wm, along the surface of the facet, of which refraction leaves the direction.
template <class F>
struct Incidence {
  Vec3<F> t;
  Cosines<F> cosines;
};
/// g^2 = eta^2 - 1 + c^2, or eta^2 - |t|^2 where eta is small: |t| is then too, and the difference no worse than the
/// problem.
template <class F>
VNDF_INLINE Incidence<F> incidence(const Vec3<F>& wo, const UnitNormal<F>& normal, const Index<F>& index) {
  F c = normal.cos + F(0x1p-62f);
  Vec3<F> t = {wo.x - c * normal.wm.x, wo.y - c * normal.wm.y, wo.z - c * normal.wm.z};
  F eta2 = index.eta * index.eta;
  F g2 = op::select(is_small(index), eta2 - dot(t, t), squared_minus_1(index) + c * c);
  return {t, {c, root_of_positive(g2)}};
}

/// Fresnel's equations for unpolarised light.
template <class F>
struct Fresnel {
  F reflected, transmitted;  // shares; their sum is 1 but for rounding
  F bend;                    // c - g: wm's share in eta wi = (c - g) wm - wo
};

/// Walter et al. 2007, eq. 22. Every difference is taken of eta alone, so eta near 1 costs no digits, and neither does
/// the small one of the two shares: c - g = (1 - eta^2) / (c + g), and eta^2 c - g = (eta^2 - 1) b / (eta^2 c + g),
/// where b = (eta^2 + 1) c^2 - 1 = (eta^2 + 1) g^2 - eta^4 vanishes at Brewster's angle alone. The former loses digits
/// where eta is small, the latter where it is large.
template <class F>
VNDF_INLINE Fresnel<F> fresnel(const Cosines<F>& cos, const Index<F>& index) {
  const auto& [c, g] = cos;
  F eta2 = index.eta * index.eta;
  F more = squared_minus_1(index);
  auto denser = more > F(0.f);
  F brewster = (eta2 + F(1.f)) * op::select(denser, c * c, g * g) - op::select(denser, F(1.f), eta2 * eta2);
  auto passes = g > F(0.f);  // no total reflection
  F s = F(1.f) / (c + g);
  F p = F(1.f) / (eta2 * c + g);
  F s2 = s * s;
  F p2 = p * p;
  F rs = more * s2;
  F rp = (more * p2) * brewster;
  F cg = c * g;
  return {op::select(passes, (rs * rs + rp * rp) * F(0.5f), F(1.f)),
          op::select(passes, (cg + cg) * (s2 + eta2 * p2), F(0.f)), F(0.f) - more * s};
}

/// The density of a refracted direction over that of the reflected one, both without Fresnel's factor: 4 c times
/// |d wm / d wi| = eta g / |h|^2, h = wo + eta wi = (c - g) wm (eq. 17 of Walter et al. 2007, with the index of the
/// view's side 1).
template <class F>
VNDF_INLINE F refraction_over_reflection(const Cosines<F>& cos, F h2, F eta) {
  F j = (cos.c * cos.g) * eta;
  return (j + j + j + j) / h2;
}

/// What light does at a facet, and the factors that the density of a reflected direction has there.
template <class F>
struct Crossing {
  F side;      // 1: reflected, -1: refracted
  F share;     // Fresnel's
  F jacobian;  // 1, or refraction over reflection
};

/// Reflection where u is below Fresnel's share of it, else refraction.
template <class F>
VNDF_INLINE Crossing<F> choose_side(const Cosines<F>& cos, const Index<F>& index, F u) {
  auto f = fresnel(cos, index);
  auto reflects = u < op::select(f.transmitted > F(0.f), f.reflected, F(2.f));
  return {op::select(reflects, op::select(index_matched(index), F(-1.f), F(1.f)), F(-1.f)),
          op::select(reflects, f.reflected, f.transmitted),
          op::select(reflects, F(1.f), refraction_over_reflection(cos, f.bend * f.bend, index.eta))};
}

/// `reflected`, or eta wi = -(t + g wm). What rounding leaves of t along wm comes off g where 1 / eta would magnify it.
template <class F>
VNDF_INLINE Vec3<F> leave(const Vec3<F>& wo, const Vec3<F>& reflected, const Incidence<F>& in, const Vec3<F>& wm,
                          F side, const Index<F>& index) {
  auto reflects = side > F(0.f);
  auto straight = index_matched(index);
  F inv_eta = F(1.f) / index.eta;
  F g = in.cosines.g - op::select(is_small(index), dot(in.t, wm), F(0.f));
  auto back = [&](F o, F t, F m) { return op::select(straight, o, (t + g * m) * inv_eta); };
  auto choose = [&](F reflection, F back) { return op::select(reflects, reflection, F(0.f) - back); };
  return {choose(reflected.x, back(wo.x, in.t.x, wm.x)), choose(reflected.y, back(wo.y, in.t.y, wm.y)),
          choose(reflected.z, at_most_one_cosine(back(wo.z, in.t.z, wm.z)))};
}

/// A view from below sees the surface turned upside down: everything is mirrored in the origin, which leaves A as it
/// is, and eta is that of the other way.
template <class F>
VNDF_INLINE Vec3<F> mirrored(Mask<F> below, const Vec3<F>& v) {
  return {op::select(below, F(0.f) - v.x, v.x), op::select(below, F(0.f) - v.y, v.y),
          op::select(below, F(0.f) - v.z, v.z)};
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
VNDF_INLINE Weighed<F> weigh_dielectric(F wo_z, const ViewSize<F>& view, F wi_z, F spread, const Crossing<F>& at,
                                        const Index<F>& index, const typename Masking::template Light<F>& light) {
  F pdf = at_most_delta(((F(kInv2Pi) / spread) * at.share) * at.jacobian);
  F weight = dielectric_weight<Masking>(at.side, wo_z, view.length, view.area, wi_z, light);
  auto straight = index_matched(index);
  pdf = op::select(straight, F(kDelta), pdf);
  weight = op::select(straight, F(1.f), weight);
  auto leaves = both_above(wo_z, at.side * wi_z, view.area) & possible(index);
  return {op::select(leaves, pdf, F(0.f)), op::select(leaves, weight, F(0.f))};
}

template <class F>
struct DielectricSample {
  Vec3<F> wi;
  F pdf, weight;
  F side;
};

/// For a view and its eta that have been turned to the upper hemisphere, see `mirrored`, with its facet; wi is to be
/// turned back. The shape is as for sample_reflection.
template <class Masking, class F, template <class> class Facet, class Shape = Vec2<F>>
VNDF_INLINE DielectricSample<F> sample_dielectric(const Vec3<F>& wo, const Shape& shape,
                                                  const FacetOfView<F, Facet>& of, const Index<F>& index, F u) {
  auto normal = normal_of(wo, of.facet, shape);
  auto unit = unit_normal(normal);
  auto in = incidence(wo, unit, index);
  auto at = choose_side(in.cosines, index, u);
  Vec3<F> wi = leave(wo, reflect(wo, normal), in, unit.wm, at.side, index);
  auto weighed = weigh_dielectric<Masking>(wo.z, of.view, wi.z, spread(of.facet.nh, normal, of.view.area, shape), at,
                                           index, dielectric_light<Masking>(at.side, wi, shape));
  return {wi, weighed.pdf, weighed.weight, at.side};
}

/// Of a pair whose view has been turned to the upper hemisphere: its normal up to its length, and the products of that
/// with wo and wi, as lengths. Both are negative where that normal does not take the one to the other.
///
/// Across the surface h is that of the upper direction and `given` times the lower one (Walter et al. 2007, eq. 16),
/// the same for either view, turned to the side of the smaller index. As the sum of the two and (given - 1) times the
/// lower nothing is lost where they are nearly opposite and the index is nearly 1.
template <class F>
struct PairNormal {
  Vec3<F> h;
  F cos_o, cos_i;
};
template <class F>
VNDF_INLINE PairNormal<F> pair_normal(const Vec3<F>& wo, const Vec3<F>& wi, const Index<F>& index) {
  auto reflects = wi.z >= F(0.f);
  auto from_above = index.eta == index.given;
  F more = op::select(reflects, F(0.f), index.given - F(1.f));
  auto near_1 = op::abs(more) < F(0.5f);
  auto sum = [&](F o, F i) {
    F upper = op::select(from_above, o, i), lower = op::select(from_above, i, o);
    return op::select(near_1, (o + i) + more * lower, upper + index.given * lower);
  };
  Vec3<F> h = {sum(wo.x, wi.x), sum(wo.y, wi.y), sum(wo.z, wi.z)};
  h = mirrored((index.minus_1 > F(0.f)) & !reflects, h);
  F cos_i = dot(wi, h);
  return {h, dot(wo, h), op::select(reflects, cos_i, F(0.f) - cos_i)};
}

template <class Masking, class F>
struct DielectricTerms {
  PairTerms<Masking, F> pair;
  F h_z, h2, cos_o, cos_i;  // see PairNormal
};
template <class Masking, class F, class Shape = Vec2<F>>
VNDF_INLINE DielectricTerms<Masking, F> dielectric_terms(const Vec3<F>& wo, const Vec3<F>& wi, const Shape& shape,
                                                         const Index<F>& index) {
  auto normal = pair_normal(wo, wi, index);
  F side = op::select(wi.z >= F(0.f), F(1.f), F(-1.f));
  return {pair_terms<Masking>(wo, normal.h, shape, dielectric_light<Masking>(side, wi, narrowed(shape))), normal.h.z,
          dot(normal.h, normal.h), normal.cos_o, normal.cos_i};
}

/// The share and the Jacobian of a pair, with m = h / |h|; the latter has eta / |wo + eta wi|^2, which is given /
/// |h|^2. Across the surface g is eta times the cosine of wi: neither cosine is computed from the other, and the two
/// sides are alike.
///
/// A pair that was sampled may be off by rounding: what is impossible by less than that counts as the limit.
template <class Masking, class F>
VNDF_INLINE Crossing<F> crossing_of(F wi_z, const DielectricTerms<Masking, F>& terms, const Index<F>& index) {
  constexpr float kRounding = 0x1p-23f, kLimit = 0x1p-40f;
  F zero(0.f);
  F inv_h = F(1.f) / op::sqrt(terms.h2);
  F c_o = terms.cos_o * inv_h;
  F c_i = terms.cos_i * inv_h;
  F slack = zero - (F(kRounding) * (F(1.f) + index.given)) * inv_h;
  auto crosses = (terms.h_z * inv_h > slack) & (c_o > slack) & (c_i > slack);
  c_i = op::select(c_i > F(kLimit), c_i, F(kLimit));
  auto cos = cosines(op::select(c_o > F(kLimit), c_o, F(kLimit)), index);
  auto reflects = wi_z >= zero;
  cos.g = op::select(reflects, cos.g, index.eta * c_i);
  auto f = fresnel(cos, index);
  return {op::select(reflects, F(1.f), F(-1.f)),
          op::select(reflects, f.reflected, op::select(crosses, f.transmitted, zero)),
          op::select(reflects, F(1.f), refraction_over_reflection(cos, terms.h2, index.given))};
}

template <class Masking, class F>
VNDF_INLINE Evaluation<F> evaluate_crossing(F wo_z, F wi_z, const Index<F>& index, const PairTerms<Masking, F>& pair,
                                            const Crossing<F>& at) {
  F pdf = at_most_delta((pair_pdf(pair) * at.share) * at.jacobian);
  auto leaves =
      both_above(wo_z, op::abs(wi_z), pair.area) & (at.share > F(0.f)) & possible(index) & !index_matched(index);
  F weight = dielectric_weight<Masking>(at.side, wo_z, pair.length, pair.area, wi_z, pair.light);
  return {op::select(leaves, pdf * weight, F(0.f)), op::select(leaves, pdf, F(0.f))};
}

template <class Masking, class F, class Shape = Vec2<F>>
VNDF_INLINE Evaluation<F> evaluate_dielectric(const Vec3<F>& wo, const Vec3<F>& wi, const Shape& shape,
                                              const Index<F>& index) {
  auto terms = dielectric_terms<Masking>(wo, wi, shape, index);
  return evaluate_crossing(wo.z, wi.z, index, terms.pair, crossing_of(wi.z, terms, index));
}

}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
