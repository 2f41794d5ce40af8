// Reflection at a visible normal: direction, density and weight in one pass from the hemisphere configuration, and the
// same density and the BRDF for a given pair of directions.
//
// All of it needs two lengths of the view: a = |A wo|, and `area`, twice the projected area of the normals that are
// sampled: a + (A wo).z for all visible ones, and (A wo).z is wo.z unless the shape leans. Views are unit vectors above
// the horizon or on it; below, directions are written, with density and weight 0.
#pragma once

#include <vndf/lanes/ggx.h>
#include <vndf/lanes/spherical_cap.h>

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

/// A visible normal in the hemisphere configuration, of any length: nh = c Nh. And what the shading step needs to know
/// of how it was sampled.
template <class F>
struct Facet {
  Vec3<F> nh;
  F norm2;      // c^2
  F twice_cos;  // 2 A wo.nh = 2 c |A^T Nh| wo.wm
  F length;     // |A wo|
  F area;       // |A wo| + k (A wo).z, twice the projected area of the normals that are sampled; k = 1 if not bounded
};

/// nh.z with the addend of map_from_hemisphere, before its length is taken, so that the two agree.
template <class F>
VNDF_INLINE Vec3<F> with_direction(Vec3<F> nh) {
  return {nh.x, nh.y, nh.z + F(0x1p-62f)};
}

/// A normal from the disk, and 2 A wo.nh through the height that the reprojection takes its root of, not as a sum of
/// products.
template <class F>
struct ChordFacet {
  Vec3<F> nh;
  F twice_cos;
};

template <class F>
VNDF_INLINE ChordFacet<F> sample_on_chord(const HemisphereView<F>& view, F length, const Chord<F>& t) {
  F cos;
  Vec3<F> nh = with_direction(reproject(view, t, squish(view, t), cos));
  return {nh, (cos + cos) * length};
}
template <class F>
VNDF_INLINE Facet<F> facet_of(const ChordFacet<F>& facet, F length, F area) {
  return {facet.nh, dot(facet.nh, facet.nh), facet.twice_cos, length, area};
}

/// The visible cap, the height of which is the area that its normals project to, and |A wo|. Leaning shapes are masked
/// by their areas alone.
template <class F>
struct CapToReflect {
  CapAtView<F> at;
  F length;
};
template <class F>
VNDF_INLINE CapToReflect<F> visible_cap_to_reflect(const Vec3<F>& wo, const Vec2<F>& alpha) {
  auto view = map_to_cap(stretch(wo, alpha), F(1.f));
  return {{view.x, view.y, visible_cap(view)}, view.length};
}
template <class F, class Shape>
VNDF_INLINE CapAtView<F> visible_cap_to_reflect(const Vec3<F>& wo, const Shape& shape) {
  Vec3<F> h = stretch(wo, shape);
  auto view = map_to_cap(h, F(1.f));
  return {view.x, view.y, visible_cap(view, h.z)};
}

/// Eto and Tokuyoshi 2023: the part of the cap whose reflections can be above the horizon. `rest` is what the third
/// component of the sum lacks.
template <class F>
struct BoundedCapToReflect {
  CapToReflect<F> bounded;
  F rest;
};
template <class F>
VNDF_INLINE BoundedCapToReflect<F> bounded_cap_to_reflect(const Vec3<F>& wo, const Vec2<F>& alpha) {
  auto view = map_to_cap(stretch(wo, alpha), F(1.f));
  auto bound = reflection_bound(wo, alpha);
  return {{{view.x, view.y, bounded_cap(view, bound)}, view.length}, bound.one_minus_k * view.abs_z};
}

/// `r2`, e and phi are the disk point, see on_cap.
template <class F>
VNDF_INLINE Vec3<F> sample_on_cap(const CapAtView<F>& view, F r2, F e, const Angle<F>& phi) {
  return with_direction(on_cap(view, r2, e, phi));
}
template <class F>
VNDF_INLINE Vec3<F> sample_on_cap(const CapToReflect<F>& view, F r2, F e, const Angle<F>& phi) {
  return sample_on_cap(view.at, r2, e, phi);
}
template <class F>
VNDF_INLINE Vec3<F> sample_on_cap(const BoundedCapToReflect<F>& view, F r2, F e, const Angle<F>& phi) {
  Vec3<F> nh = on_cap(view.bounded.at, r2, e, phi);
  nh.z = nh.z + view.rest;
  return with_direction(nh);
}

/// A normal from the cap is the sum of two vectors as long as A wo, one of which is A wo: 2 A wo.nh = |nh|^2.
template <class F>
VNDF_INLINE Facet<F> facet_of(const Vec3<F>& nh, const CapAtView<F>& view, F length = F(0.f)) {
  F norm2 = dot(nh, nh);
  return {nh, norm2, norm2, length, view.cap.height};
}
template <class F>
VNDF_INLINE Facet<F> facet_of(const Vec3<F>& nh, const CapToReflect<F>& view) {
  return facet_of(nh, view.at, view.length);
}
template <class F>
VNDF_INLINE Facet<F> facet_of(const Vec3<F>& nh, const BoundedCapToReflect<F>& view) {
  return facet_of(nh, view.bounded);
}

/// Facets of the three warps, what sample_reflection below takes: `t` is chord(polar_map(u)) or
/// chord(concentric_map(u)).
template <class F, class Shape = Vec2<F>>
VNDF_INLINE Facet<F> facet_on_chord(const Vec3<F>& wo, const Shape& shape, const Chord<F>& t) {
  Vec3<F> h = stretch(wo, shape);
  F length;
  auto view = scale_view(h, azimuth_of(shape), length);
  auto elevation = elevation_of(view);
  F area = kUpright<Shape> ? length + wo.z : lune_area(length, h.z, elevation.one_plus_z);
  return facet_of(sample_on_chord(hemisphere_view(view, elevation), length, t), length, area);
}
template <class F, class Shape = Vec2<F>>
VNDF_INLINE Facet<F> facet_on_cap(const Vec3<F>& wo, const Shape& shape, Vec2<F> u) {
  auto view = visible_cap_to_reflect(wo, for_cap(shape));
  return facet_of(sample_on_cap(view, u.y, F(1.f) - u.y, sincos2pi(u.x)), view);
}
/// Eto and Tokuyoshi 2023.
template <class F>
VNDF_INLINE Facet<F> facet_on_bounded_cap(const Vec3<F>& wo, const Vec2<F>& alpha, Vec2<F> u) {
  auto view = bounded_cap_to_reflect(wo, alpha);
  return facet_of(sample_on_cap(view, u.y, F(1.f) - u.y, sincos2pi(u.x)), view);
}

/// The normal in the ellipsoid configuration, not normalised: p = c A^T Nh = c |A^T Nh| wm.
template <class F>
struct Normal {
  Vec3<F> p;
  F p2, inv_p2;  // |p|^2
};

template <class F, class Shape = Vec2<F>>
VNDF_INLINE Normal<F> normal_of(const Facet<F>& facet, const Shape& shape) {
  Vec3<F> p = stretch_back(facet.nh, shape);
  F p2 = dot(p, p);
  return {p, p2, F(1.f) / p2};
}

/// A unit normal, the one of sample_normals to the last bit, and the cosine to the view.
template <class F>
struct UnitNormal {
  Vec3<F> wm;
  F cos;
};

template <class F, class Theta = XAxis>
VNDF_INLINE UnitNormal<F> unit_normal(const Facet<F>& facet, const Normal<F>& normal, const Theta& theta_z = {}) {
  F inv = F(1.f) / op::sqrt(normal.p2);
  Vec3<F> p = turn_back(normal.p, theta_z);
  return {{p.x * inv, p.y * inv, p.z * inv}, (facet.twice_cos * F(0.5f)) * inv};
}

/// Heitz 2018, eq. 16: wi = 2 (wo.wm) wm - wo, without a square root.
template <class F>
VNDF_INLINE Vec3<F> reflect(const Vec3<F>& wo, const Facet<F>& facet, const Normal<F>& normal) {
  F t = facet.twice_cos * normal.inv_p2;
  return {t * normal.p.x - wo.x, t * normal.p.y - wo.y, t * normal.p.z - wo.z};
}

/// The density of the reflected direction, eq. 17, is D(wm) / (2 area) with D = |A^T Nh|^4 / (pi |A|). This is
/// 1 / (2 pi density); for the sake of the range each factor of |A| is taken together with one |A^T Nh|^2.
template <class F, class Shape = Vec2<F>>
VNDF_INLINE F spread(const Facet<F>& facet, const Normal<F>& normal, const Shape& shape) {
  Vec2<F> a = diagonal(shape);
  F g = facet.norm2 * normal.inv_p2;
  return op::abs((a.x * g) * (a.y * g)) * facet.area;
}

/// A weight without the excess over 1 that only rounding can give it.
template <class F>
VNDF_INLINE F at_most_one(F weight) {
  return op::select(weight > F(1.f), F(1.f), weight);
}

/// The weight G2(wo, wi) / G1(wo) and, if the sampling is bounded, times the share of the visible area that it leaves.
/// `Light` is what it takes from the light's direction, here the length |A wi|. length_o = |A wo|.
struct ByLengths {
  template <class F>
  using Light = F;
  template <class F, class Shape = Vec2<F>>
  static VNDF_INLINE F light(const Vec3<F>& wi, const Shape& shape) {
    return stretched_length(wi, shape);
  }
};
struct HeightCorrelated : ByLengths {
  template <class F>
  static VNDF_INLINE F weight(F wo_z, F length_o, F area, F wi_z, F length_i) {
    return at_most_one((wi_z * area) / (wi_z * length_o + length_i * wo_z));
  }
};
struct Separable : ByLengths {
  template <class F>
  static VNDF_INLINE F weight(F wo_z, F length_o, F area, F wi_z, F length_i) {
    return at_most_one(((wi_z + wi_z) * area) / ((wi_z + length_i) * (wo_z + length_o)));
  }
};

/// The value where light can go from wi to wo above the surface: wo.z >= 0 and wi.z > 0. Else 0.
template <class F>
VNDF_INLINE F where_above(F wo_z, F wi_z, F value) {
  return op::select((wo_z >= F(0.f)) & (wi_z > F(0.f)), value, F(0.f));
}

/// The density of a sampled direction, and what the light from there counts: f cos / pdf, without Fresnel's factor.
template <class F>
struct Weighed {
  F pdf, weight;
};

/// From a reflected direction's height, the lengths of its facet and its spread.
template <class Masking, class F>
VNDF_INLINE Weighed<F> weigh_reflection(F wo_z, F length, F area, F wi_z, F spread,
                                        const typename Masking::template Light<F>& light) {
  F weight = Masking::weight(wo_z, length, area, wi_z, light);
  return {where_above(wo_z, wi_z, F(kInv2Pi) / spread), where_above(wo_z, wi_z, weight)};
}

template <class F>
struct ReflectionSample {
  Vec3<F> wi;
  F pdf, weight;
};

/// From a facet: reflect, density, weight. The shape is the one that the facet was sampled with, narrowed, or for_cap.
template <class Masking, class F, class Shape = Vec2<F>>
VNDF_INLINE ReflectionSample<F> sample_reflection(const Vec3<F>& wo, const Shape& shape, const Facet<F>& facet) {
  auto normal = normal_of(facet, shape);
  Vec3<F> wi = reflect(wo, facet, normal);
  auto weighed = weigh_reflection<Masking>(wo.z, facet.length, facet.area, wi.z, spread(facet, normal, shape),
                                           Masking::light(wi, shape));
  return {wi, weighed.pdf, weighed.weight};
}

/// f cos without Fresnel's factor, and the density that sampling has for the pair.
template <class F>
struct Evaluation {
  F f_cos, pdf;
};

/// Of a pair of directions and a shape, what comes before the divisions.
template <class Masking, class F>
struct PairTerms {
  NdfTerms<F> ndf;
  F length, area;
  typename Masking::template Light<F> light;
};
/// From the view, the half vector of any length, and the light's.
template <class Masking, class F, class Shape = Vec2<F>>
VNDF_INLINE PairTerms<Masking, F> pair_terms(const Vec3<F>& wo, const Vec3<F>& h, const Shape& shape,
                                             const typename Masking::template Light<F>& light) {
  F length(0.f), area;
  if constexpr (kUpright<Shape>) {
    length = stretched_length(wo, narrowed(shape));
    area = length + wo.z;
  } else {
    // Lunes are masked by their areas alone.
    area = lune_area(stretch(wo, narrowed(shape)));
  }
  return {ndf_terms(h, shape), length, area, light};
}

/// h = wo + wi is taken as it is: one rounding for each component, none for its length.
template <class Masking, class F, class Shape = Vec2<F>>
VNDF_INLINE PairTerms<Masking, F> reflection_terms(const Vec3<F>& wo, const Vec3<F>& wi, const Shape& shape) {
  Vec3<F> h = {wo.x + wi.x, wo.y + wi.y, wo.z + wi.z};
  return pair_terms<Masking>(wo, h, shape, Masking::light(wi, narrowed(shape)));
}
/// The pair of bounded sampling.
template <class Masking, class F>
VNDF_INLINE PairTerms<Masking, F> reflection_terms_bounded(const Vec3<F>& wo, const Vec3<F>& wi, const Vec2<F>& alpha) {
  auto terms = reflection_terms<Masking>(wo, wi, alpha);
  terms.area = terms.length + reflection_bound(wo, alpha).k * wo.z;
  return terms;
}

/// D(h) / (2 area).
template <class Masking, class F>
VNDF_INLINE F pair_pdf(const PairTerms<Masking, F>& terms) {
  return ndf(terms.ndf) / (terms.area + terms.area);
}

/// f cos = pdf weight.
template <class Masking, class F>
VNDF_INLINE Evaluation<F> evaluate_pair(F wo_z, F wi_z, const PairTerms<Masking, F>& terms) {
  F pdf = pair_pdf(terms);
  F weight = Masking::weight(wo_z, terms.length, terms.area, wi_z, terms.light);
  return {where_above(wo_z, wi_z, pdf * weight), where_above(wo_z, wi_z, pdf)};
}

template <class Masking, class F, class Shape = Vec2<F>>
VNDF_INLINE Evaluation<F> evaluate_reflection(const Vec3<F>& wo, const Vec3<F>& wi, const Shape& shape) {
  return evaluate_pair(wo.z, wi.z, reflection_terms<Masking>(wo, wi, shape));
}
template <class Masking, class F>
VNDF_INLINE Evaluation<F> evaluate_reflection_bounded(const Vec3<F>& wo, const Vec3<F>& wi, const Vec2<F>& alpha) {
  return evaluate_pair(wo.z, wi.z, reflection_terms_bounded<Masking>(wo, wi, alpha));
}

}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
