// Reflection and refraction at a visible normal of a rough dielectric (Walter et al. 2007).
#pragma once

#include <vndf/lanes/fresnel.h>
#include <vndf/lanes/reflection.h>

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

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

/// The density of a refracted direction over that of the reflected one, both without Fresnel's factor: 4 c times
/// |d wm / d wi| = eta g / |h|^2, h = wo + eta wi = (c - g) wm (eq. 17 of Walter et al. 2007, with the index of the
/// view's side 1).
template <class F>
VNDF_INLINE F refraction_over_reflection(const Cosines<F>& cos, F h2, F eta) {
  F j = (cos.c * cos.g) * eta;
  return (j + j + j + j) / h2;
}

/// What a caller may ask of the two lobes. Functions take any type with these members: one that loads the probability
/// when it is asked for keeps no register before.
template <class F>
struct Lobes {
  bool radiance = false;  // refracted light counts (index at wo / index at wi)^2
  bool given = false;     // the probability of reflection is `probability`, and not Fresnel's share
  F probability = F(0.f);

  VNDF_INLINE F reflection() const { return probability; }
};

/// What light does at a facet, and the factors that the density of a reflected direction has there.
template <class F>
struct Crossing {
  F side;      // 1: reflected, -1: refracted
  F share;     // Fresnel's, the probability of the side unless another is given
  F jacobian;  // 1, or refraction over reflection
};

/// The probability of a side that is given, over Fresnel's share; 0 where light cannot take that side.
template <class F>
VNDF_INLINE F given_over_share(const Crossing<F>& at, F reflection) {
  F given = op::select(at.side > F(0.f), reflection, F(1.f) - reflection);
  return op::select(at.share > F(0.f), given / at.share, F(0.f));
}

/// Reflection where u is below its probability, else refraction.
template <class F, class Lobes>
VNDF_INLINE Crossing<F> choose_side(const Fresnel<F>& f, const Cosines<F>& cos, const Index<F>& index, F u,
                                    const Lobes& lobes) {
  F reflection = op::select(f.transmitted > F(0.f), f.reflected, F(2.f));
  if (lobes.given) reflection = op::select(lobes.reflection() < F(1.f), lobes.reflection(), F(2.f));
  auto reflects = u < reflection;
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
  auto choose = [&](F reflection, F past) { return op::select(reflects, reflection, F(0.f) - past); };
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

/// What the masking takes from a direction on the view's side or across, where G is that of wi turned to the view's
/// side, Walter et al. 2015, eq. 7.
template <class Masking, class F, class Shape = Vec2<F>>
VNDF_INLINE auto shadowing_of(F side, const Vec3<F>& wi, const Shape& shape, const Masking& masking) {
  if constexpr (Masking::kEven)
    return masking.shadowing(wi, shape);
  else
    return masking.shadowing(mirrored(side < F(0.f), wi), shape);
}
/// G2 / G1(wo), for energy or radiance.
template <class Masking, class F, class Lobes, class Shadowing>
VNDF_INLINE F dielectric_weight(F side, bool any_crosses, const SeenView<F>& view, F wi_z, const Index<F>& index,
                                const Lobes& lobes, const Masking& masking, const Shadowing& shadowing) {
  auto reflects = side > F(0.f);
  F weight = masking.weight_of_side(reflects, any_crosses, view, wi_z, shadowing);
  if (lobes.radiance) weight = op::select(reflects, weight, weight / (index.eta * index.eta));
  return weight;
}

/// The density and the weight of a sampled direction.
template <class F, class Lobes, class Masking, class Shadowing>
VNDF_INLINE Weighed<F> weigh_dielectric(const SeenView<F>& view, F wi_z, F spread, const Crossing<F>& at,
                                        const Index<F>& index, const Lobes& lobes, const Masking& masking,
                                        const Shadowing& shadowing) {
  F pdf = at_most_delta(((F(kInv2Pi) / spread) * at.share) * at.jacobian);
  F weight = dielectric_weight(at.side, true, view, wi_z, index, lobes, masking, shadowing);
  if (lobes.given) {
    F ratio = given_over_share(at, lobes.reflection());
    auto can = ratio > F(0.f);
    pdf = op::select(can, at_most_delta(pdf * ratio), F(0.f));
    weight = op::select(can, weight / ratio, F(0.f));
  }
  auto straight = index_matched(index);
  pdf = op::select(straight, F(kDelta), pdf);
  weight = op::select(straight, F(1.f), weight);
  auto refracts = possible(index);
  auto leaves = both_above(view.z, at.side * wi_z, view.area) & refracts;
  return {op::select(leaves, pdf, F(0.f)), op::select(leaves, weight, F(0.f))};
}

template <class F>
struct DielectricSample {
  Vec3<F> wi;
  F pdf, weight;
  F side;
  Mask<F> straight;  // index-matched
  Vec3<F> wm;        // on the side of the view
  F cos_o, cos_i;    // its cosines
  F reflectance;     // Fresnel's
};

/// Reflection or refraction at the visible normal that the warp maps u.x and u.y to; u.z chooses. `eta` is the index
/// below the surface over the one above, whichever side the view is on.
template <class Warp, class Masking, class F, class Shape = Vec2<F>, class Lobes = lanes::Lobes<F>>
VNDF_INLINE DielectricSample<F> sample_dielectric(const Vec3<F>& wo_given, const Shape& shape, F eta, const Vec3<F>& u,
                                                  const Masking& masking, const Lobes& lobes = {}) {
  const auto& floats = narrowed(shape);
  auto below = wo_given.z < F(0.f);
  Vec3<F> wo = mirrored(below, wo_given);
  auto index = index_seen(below, eta);
  auto [facet, view] = sample_facet<Warp>(wo, shape, Vec2<F>{u.x, u.y});
  auto normal = normal_of(wo, facet, floats);
  auto unit = unit_normal(normal);
  auto in = incidence(wo, unit, index);
  auto shares = fresnel(in.cosines, index);
  auto at = choose_side(shares, in.cosines, index, u.z, lobes);
  auto straight = index_matched(index);
  F way = at.side;
  if (lobes.given)  // where it cannot refract it is a reflection, and counts nothing
    way = op::select((at.share > F(0.f)) | straight, way, F(1.f));
  Vec3<F> wi = leave(wo, reflect(wo, normal), in, unit.wm, way, index);
  auto weighed = weigh_dielectric(view, wi.z, spread(facet.nh, normal, view.area, floats), at, index, lobes, masking,
                                  shadowing_of(at.side, wi, floats, masking));
  F across = op::select(straight, unit.cos, at_most_one_cosine(in.cosines.g / index.eta));
  return {mirrored(below, wi),
          weighed.pdf,
          weighed.weight,
          at.side,
          straight,
          mirrored(below, unit.wm),
          unit.cos,
          op::select(way > F(0.f), unit.cos, F(0.f) - across),
          op::select(straight, F(0.f), shares.reflected)};
}

/// The direction in which `sample` leaves, turned back from the frame that wo was turned to. Straight on it is -wo to
/// the last bit; turning and turning back would lose that.
template <class F>
VNDF_INLINE Vec3<F> turn_back(const DielectricSample<F>& sample, const Vec3<F>&, XAxis) {
  return sample.wi;
}
template <class F>
VNDF_INLINE Vec3<F> turn_back(const DielectricSample<F>& sample, const Vec3<F>& wo, const Angle<F>& theta_z) {
  Vec3<F> back = turn_back(sample.wi, theta_z);
  F zero(0.f);
  return {op::select(sample.straight, zero - wo.x, back.x), op::select(sample.straight, zero - wo.y, back.y),
          op::select(sample.straight, zero - wo.z, back.z)};
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

/// The share and the Jacobian of a pair, with m = h / |h|; the latter has eta / |wo + eta wi|^2, which is given /
/// |h|^2. Across the surface g is eta times the cosine of wi: neither cosine is computed from the other, and the two
/// sides are alike.
///
/// A pair that was sampled may be off by rounding: what is impossible by less than that counts as the limit.
template <class F>
VNDF_INLINE Crossing<F> crossing_of(F wi_z, const PairNormal<F>& normal, const Index<F>& index) {
  constexpr float kRounding = 0x1p-23f, kLimit = 0x1p-40f;
  F zero(0.f);
  F h2 = dot(normal.h, normal.h);
  F inv_h = F(1.f) / op::sqrt(h2);
  F c_o = normal.cos_o * inv_h;
  F c_i = normal.cos_i * inv_h;
  F slack = zero - (F(kRounding) * (F(1.f) + index.given)) * inv_h;
  auto crosses = (normal.h.z * inv_h > slack) & (c_o > slack) & (c_i > slack);
  c_i = op::select(c_i > F(kLimit), c_i, F(kLimit));
  auto cos = cosines(op::select(c_o > F(kLimit), c_o, F(kLimit)), index);
  auto reflects = wi_z >= zero;
  cos.g = op::select(reflects, cos.g, index.eta * c_i);
  auto f = fresnel(cos, index);
  return {op::select(reflects, F(1.f), F(-1.f)),
          op::select(reflects, f.reflected, op::select(crosses, f.transmitted, zero)),
          op::select(reflects, F(1.f), refraction_over_reflection(cos, h2, index.given))};
}

/// The BSDF of a pair of directions and the density that sample_dielectric has for it, Walter et al. 2007, eq. 20-21.
template <class F, class Masking, class Shape = Vec2<F>, class Lobes = lanes::Lobes<F>>
VNDF_INLINE Evaluation<F> evaluate_dielectric(const Vec3<F>& wo_given, const Vec3<F>& wi_given, const Shape& shape,
                                              F eta, const Masking& masking, const Lobes& lobes = {}) {
  auto below = wo_given.z < F(0.f);
  Vec3<F> wo = mirrored(below, wo_given), wi = mirrored(below, wi_given);
  auto index = index_seen(below, eta);
  auto normal = pair_normal(wo, wi, index);
  auto at = crossing_of(wi.z, normal, index);
  auto view = seen_view(wo, shape);
  F pdf = at_most_delta((pair_pdf(ndf_terms(normal.h, shape), view) * at.share) * at.jacobian);
  auto refracts = possible(index), matched = index_matched(index);
  auto leaves = both_above(wo.z, op::abs(wi.z), view.area) & (at.share > F(0.f)) & refracts & !matched;
  // Lights are often all on the views' side. Samples hardly ever are.
  F weight = dielectric_weight(at.side, op::any(at.side < F(0.f)), view, wi.z, index, lobes, masking,
                               shadowing_of(at.side, wi, narrowed(shape), masking));
  F f_cos = pdf * weight;
  if (lobes.given) pdf = at_most_delta(pdf * given_over_share(at, lobes.reflection()));
  return {op::select(leaves, f_cos, F(0.f)), op::select(leaves, pdf, F(0.f))};
}

}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
