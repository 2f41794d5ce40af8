// Reflection and refraction at a visible normal of a rough dielectric (Walter et al. 2007).
//
// eta is the index on the other side of the surface over the one on the view's. c = wo.wm, and g = eta cos of the angle
// of refraction: g^2 = eta^2 - 1 + c^2.
#pragma once

#include <vndf/lanes/reflection.h>

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

/// Fresnel's equations for unpolarised light.
template <class F>
struct Fresnel {
  F reflected, transmitted;  // shares; their sum is 1 but for rounding
  F c, g;
  F bend;  // c - g: wm's share in eta wi = (c - g) wm - wo
};

/// Walter et al. 2007, eq. 22. Every difference is taken of eta alone: c - g = (1 - eta^2) / (c + g), and eta^2 c - g =
/// (eta^2 - 1) ((eta^2 + 1) c^2 - 1) / (eta^2 c + g), so eta near 1 costs no digits, and neither does the small one of
/// the two shares.
template <class F>
VNDF_INLINE Fresnel<F> fresnel(F cos, F eta) {
  F c = cos + F(0x1p-62f);
  F eta2 = eta * eta;
  F more = (eta - F(1.f)) * (eta + F(1.f));  // eta^2 - 1
  F c2 = c * c;
  F g2 = more + c2;
  auto total = g2 > F(0.f);  // no total reflection
  F g = op::sqrt(op::select(total, g2, F(0.f)));
  F s = F(1.f) / (c + g);
  F p = F(1.f) / (eta2 * c + g);
  F s2 = s * s;
  F p2 = p * p;
  F rs = more * s2;
  F rp = (more * p2) * (((eta2 + F(1.f)) * c2) - F(1.f));
  F cg = c * g;
  return {op::select(total, (rs * rs + rp * rp) * F(0.5f), F(1.f)),
          op::select(total, (cg + cg) * (s2 + eta2 * p2), F(0.f)), c, g, F(0.f) - more * s};
}

/// The density of a refracted direction over that of the reflected one, both without Fresnel's factor: 4 c times
/// |d wm / d wi| = eta g / (c - g)^2 (eq. 17 of Walter et al. 2007, with the index of the view's side 1).
template <class F>
VNDF_INLINE F refraction_over_reflection(const Fresnel<F>& fresnel, F eta) {
  F j = (fresnel.c * fresnel.g) * eta;
  return (j + j + j + j) / (fresnel.bend * fresnel.bend);
}

/// The weight of refraction, G1(wi), the masking of the two sides being independent. `length_i` = |A wi|.
template <class F>
VNDF_INLINE F refraction_weight(F wi_z, F length_i) {
  return at_most_one((wi_z + wi_z) / (wi_z + length_i));
}

/// The weight of a direction on the view's side or across, where G is that of wi turned to the view's side, Walter et
/// al. 2015, eq. 7. Lunes do not tell the sides apart: theirs is the one of reflection for either.
template <class Masking, class F, class Shape = Vec2<F>>
VNDF_INLINE F dielectric_weight(Mask<F> reflects, F wo_z, F length, F area, const Vec3<F>& wi, const Shape& shape) {
  if constexpr (std::is_base_of_v<ByLengths, Masking>) {
    F length_i = Masking::light(wi, shape);
    return op::select(reflects, Masking::weight(wo_z, length, area, wi.z, length_i),
                      refraction_weight(F(0.f) - wi.z, length_i));
  } else {
    Vec3<F> up = {op::select(reflects, wi.x, F(0.f) - wi.x), op::select(reflects, wi.y, F(0.f) - wi.y),
                  op::select(reflects, wi.z, F(0.f) - wi.z)};
    return Masking::weight(wo_z, length, area, up.z, Masking::light(up, shape));
  }
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

template <class F>
struct DielectricSample {
  Vec3<F> wi;
  F pdf, weight;
  F side;  // 1: reflected, -1: refracted
};

/// For a view that has been turned to the upper hemisphere, with its facet and eta: reflection where u is below
/// Fresnel's share of it, else refraction, eta wi = (c - g) wm - wo.
template <class Masking, class F, class Shape = Vec2<F>>
VNDF_INLINE DielectricSample<F> sample_dielectric(const Vec3<F>& wo, const Shape& shape, const Facet<F>& facet, F eta,
                                                  F u) {
  auto normal = normal_of(facet, shape);
  auto unit = unit_normal(facet, normal);
  auto f = fresnel(unit.cos, eta);
  auto reflects = u < op::select(f.transmitted > F(0.f), f.reflected, F(2.f));
  Vec3<F> up = reflect(wo, facet, normal);
  F inv_eta = F(1.f) / eta;
  Vec3<F> down = {(f.bend * unit.wm.x - wo.x) * inv_eta, (f.bend * unit.wm.y - wo.y) * inv_eta,
                  (f.bend * unit.wm.z - wo.z) * inv_eta};
  Vec3<F> wi = {op::select(reflects, up.x, down.x), op::select(reflects, up.y, down.y),
                op::select(reflects, up.z, down.z)};
  F height = op::select(reflects, wi.z, F(0.f) - wi.z);
  F pdf = F(kInv2Pi) / spread(facet, normal, shape);
  F weight = dielectric_weight<Masking>(reflects, wo.z, facet.length, facet.area, wi, shape);
  pdf = op::select(reflects, pdf * f.reflected, (pdf * f.transmitted) * refraction_over_reflection(f, eta));
  return {wi, where_above(wo.z, height, pdf), where_above(wo.z, height, weight), op::select(reflects, F(1.f), F(-1.f))};
}

/// For a pair whose view has been turned to the upper hemisphere. The normal is that of wo + wi, or of wo + eta wi
/// across the surface (eq. 13 and 16); the pair is impossible where either direction is at its back.
template <class Masking, class F, class Shape = Vec2<F>>
VNDF_INLINE Evaluation<F> evaluate_dielectric(const Vec3<F>& wo, const Vec3<F>& wi, const Shape& shape, F eta) {
  auto reflects = wi.z >= F(0.f);
  F e = op::select(reflects, F(1.f), eta);
  Vec3<F> h = {wo.x + e * wi.x, wo.y + e * wi.y, wo.z + e * wi.z};
  h = mirrored(h.z < F(0.f), h);
  F cos_o = dot(wo, h);
  F cos_i = dot(wi, h);
  auto f = fresnel(cos_o / op::sqrt(dot(h, h)), eta);
  F length = F(0.f), area;
  if constexpr (kUpright<Shape>) {
    length = stretched_length(wo, narrowed(shape));
    area = length + wo.z;
  } else {
    area = lune_area(stretch(wo, narrowed(shape)));
  }
  F pdf = ndf(h, shape) / (area + area);
  F reflected = pdf * f.reflected;
  F refracted = (pdf * f.transmitted) * refraction_over_reflection(f, eta);
  refracted = op::select(cos_o > F(0.f), op::select(cos_i < F(0.f), refracted, F(0.f)), F(0.f));
  F weight = dielectric_weight<Masking>(reflects, wo.z, length, area, wi, narrowed(shape));
  pdf = where_above(wo.z, op::abs(wi.z), op::select(reflects, reflected, refracted));
  return {op::select(pdf > F(0.f), pdf * weight, F(0.f)), pdf};
}

}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
