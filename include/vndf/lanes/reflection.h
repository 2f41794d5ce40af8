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

/// What the shading step needs to know of the view: |A wo|, and `area` = |A wo| + k (A wo).z, twice the projected area
/// of the normals that are sampled; k = 1 if not bounded.
template <class F>
struct ViewSize {
  F length, area;
};

/// A visible normal in the hemisphere configuration, of any length, nh = c Nh, and 2 A wo.nh = 2 c |A^T Nh| wo.wm.
/// From the disk, the latter is through the height that the reprojection takes its root of, not as a sum of products.
template <class F>
struct Facet {
  Vec3<F> nh;
  F twice_cos;
};
/// From a cap, Nh is along the sum of two unit vectors, one of which is that of A wo: 2 A wo.nh = |nh|^2 / per_cos.
template <class F>
struct CapFacet {
  Vec3<F> nh;
  F per_cos;
};

template <class F>
VNDF_INLINE Facet<F> sample_on_chord(const HemisphereView<F>& view, F length, const Chord<F>& t) {
  auto point = reproject(view, t);
  return {point.nh, (point.cos + point.cos) * length};
}

/// Of all visible normals: |A wo| and, upright shapes leaving z as it is, wo.z.
template <bool upright, class F>
VNDF_INLINE ViewSize<F> visible_size(const CapView<F>& view, F h_z) {
  F length = view.length * unscale(view);
  if constexpr (upright)
    return {length, length + h_z};
  else
    return {length, view.plus * unscale(view)};
}
template <class F>
VNDF_INLINE ViewSize<F> bounded_size(const CapView<F>& view, F h_z, const Bound<F>& bound) {
  F length = view.length * unscale(view);
  return {length, length + bound.k * op::abs(h_z)};
}

template <class F>
VNDF_INLINE CapFacet<F> facet_of(const CapNormal<F>& normal, const CapView<F>& view) {
  return {normal.nh, normal.per_cos * view.scale};
}

/// The normal in the ellipsoid configuration, not normalised: p = c A^T Nh = c |A^T Nh| wm, and `along` = 2 wo.p /
/// |p|^2.
template <class F>
struct Normal {
  Vec3<F> p;
  F p2, inv_p2, along;
};

template <class F>
struct Inverses {
  F inv_p2, along;
};
template <class F>
VNDF_INLINE Inverses<F> inverses(const Facet<F>& facet, F p2) {
  F inv_p2 = F(1.f) / p2;
  return {inv_p2, facet.twice_cos * inv_p2};
}
template <class F>
VNDF_INLINE Inverses<F> inverses(const CapFacet<F>& facet, F p2) {
  F inv_p2 = F(1.f) / p2;
  return {inv_p2, (dot(facet.nh, facet.nh) * inv_p2) / facet.per_cos};
}

/// A^T Nh up to its length, and wo.p.
template <class F>
struct SeenNormal {
  LongNormal<F> normal;
  F wo_p;
};
template <class F, class Shape = Vec2<F>>
VNDF_INLINE SeenNormal<F> seen_normal(const Vec3<F>& wo, const Vec3<F>& nh, const Shape& shape) {
  auto normal = stretch_normal(nh, shape);
  return {normal, dot(wo, normal.p)};
}

/// The facet knows the cosine to full relative accuracy, which weights at grazing angles need. But of the exact normal:
/// where rounding has moved p (far, for steep problems), a wi made of the two would not be as long as wo. There, that
/// of p itself is right.
template <class F, template <class> class Facet>
VNDF_INLINE Normal<F> normal_of(const Facet<F>& facet, const SeenNormal<F>& seen) {
  constexpr float kRounding = 0x1p-22f;  // of 4 (wo.wm)^2
  const auto& [p, p2] = seen.normal;
  auto inverse = inverses(facet, p2);
  F of_p = (seen.wo_p + seen.wo_p) * inverse.inv_p2;
  F off = op::abs(inverse.along * inverse.along - of_p * of_p) * p2;
  return {p, p2, inverse.inv_p2, op::select(off < F(kRounding), inverse.along, of_p)};
}
template <class F, template <class> class Facet, class Shape = Vec2<F>>
VNDF_INLINE Normal<F> normal_of(const Vec3<F>& wo, const Facet<F>& facet, const Shape& shape) {
  return normal_of(facet, seen_normal(wo, facet.nh, shape));
}

/// Without the excess over 1 that only rounding can give a cosine of unit vectors: callers take sqrt(1 - c^2).
template <class F>
VNDF_INLINE F at_most_one_cosine(F c) {
  return op::select((c > F(1.f)) & (c < F(1.f + 0x1p-20f)), F(1.f), c);
}

/// A unit normal, the one of sample_normals to the last bit, and the cosine to the view.
template <class F>
struct UnitNormal {
  Vec3<F> wm;
  F cos;
};

template <class F, class Theta = XAxis>
VNDF_INLINE UnitNormal<F> unit_normal(const Normal<F>& normal, const Theta& theta_z = {}) {
  F inv = F(1.f) / op::sqrt(normal.p2);
  Vec3<F> p = turn_back(normal.p, theta_z);
  return {{p.x * inv, p.y * inv, p.z * inv}, at_most_one_cosine((normal.along * F(0.5f)) * (normal.p2 * inv))};
}

/// Heitz 2018, eq. 16: wi = 2 (wo.wm) wm - wo, without a square root.
template <class F>
VNDF_INLINE Vec3<F> reflect(const Vec3<F>& wo, const Normal<F>& normal) {
  F t = normal.along;
  return {t * normal.p.x - wo.x, t * normal.p.y - wo.y, at_most_one_cosine(t * normal.p.z - wo.z)};
}

/// The density of the reflected direction, eq. 17, is D(wm) / (2 area) with D = |A^T Nh|^4 / (pi |A|). This is
/// 1 / (2 pi density); for the sake of the range each factor of |A| is taken together with one |A^T Nh|^2.
template <class F, class Shape = Vec2<F>>
VNDF_INLINE F spread(const Vec3<F>& nh, const Normal<F>& normal, F area, const Shape& shape) {
  Vec2<F> a = diagonal(shape);
  F g = dot(nh, nh) * normal.inv_p2;
  return op::abs((a.x * g) * (a.y * g)) * area;
}

/// A weight without the excess over 1 that only rounding can give it; 1 where view and light graze so much that both
/// terms of the quotient vanish.
template <class F>
VNDF_INLINE F at_most_one(F weight) {
  return op::select(weight <= F(1.f), weight, F(1.f));
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

/// Where light can go from wi to wo above the surface: wo.z >= 0, wi.z > 0, and there is a view.
template <class F>
VNDF_INLINE Mask<F> both_above(F wo_z, F wi_z, F area) {
  return (wo_z >= F(0.f)) & (wi_z > F(0.f)) & (area > F(0x1p-100f));
}

/// The density of a sampled direction, and what the light from there counts: f cos / pdf, without Fresnel's factor.
template <class F>
struct Weighed {
  F pdf, weight;
};

/// From a reflected direction's height, the size of its view and its spread.
template <class Masking, class F>
VNDF_INLINE Weighed<F> weigh_reflection(F wo_z, const ViewSize<F>& view, F wi_z, F spread,
                                        const typename Masking::template Light<F>& light) {
  F weight = Masking::weight(wo_z, view.length, view.area, wi_z, light);
  auto above = both_above(wo_z, wi_z, view.area);
  return {op::select(above, at_most_delta(F(kInv2Pi) / spread), F(0.f)), op::select(above, weight, F(0.f))};
}

template <class F>
struct ReflectionSample {
  Vec3<F> wi;
  F pdf, weight;
};

/// A facet, and the size of the view it was sampled for.
template <class F, template <class> class Facet>
struct FacetOfView {
  Facet<F> facet;
  ViewSize<F> view;
};

/// Facets of the three warps, what sample_reflection below takes: `t` is chord(polar_map(u)) or
/// chord(concentric_map(u)), c cap_map(u).
template <class F, class Shape = Vec2<F>>
VNDF_INLINE FacetOfView<F, Facet> facet_on_chord(const Vec3<F>& wo, const Shape& shape, const Chord<F>& t) {
  Vec3<F> h = stretch(wo, shape);
  F length;
  auto view = scale_view(h, azimuth_of(shape), length);
  auto elevation = elevation_of(view);
  F area = kUpright<Shape> ? length + wo.z : lune_area(length, h.z, elevation.one_plus_z);
  return {sample_on_chord(hemisphere_view(view, elevation), length, t), {length, area}};
}
template <class F, class Shape = Vec2<F>>
VNDF_INLINE FacetOfView<F, CapFacet> facet_on_cap(const Vec3<F>& wo, const Shape& shape, const CapPoint<F>& c) {
  Vec3<F> h = stretch(wo, shape);
  auto view = cap_view(h, azimuth_of(shape));
  return {facet_of(on_cap(view, c), view), visible_size<kUpright<Shape>>(view, h.z)};
}
/// Eto and Tokuyoshi 2023. `c` is one of the three maps' point of the cap.
template <class F>
VNDF_INLINE FacetOfView<F, CapFacet> facet_on_bounded_cap(const Vec3<F>& wo, const Vec2<F>& alpha,
                                                          const CapPoint<F>& c) {
  Vec3<F> h = stretch(wo, alpha);
  auto view = cap_view(h);
  auto bound = reflection_bound(wo, alpha);
  return {facet_of(on_bounded_cap(view, bound, c), view), bounded_size(view, h.z, bound)};
}

/// From a facet: reflect, density, weight. The shape is the one that the facet was sampled with, narrowed.
template <class Masking, class F, template <class> class Facet, class Shape = Vec2<F>>
VNDF_INLINE ReflectionSample<F> sample_reflection(const Vec3<F>& wo, const Shape& shape,
                                                  const FacetOfView<F, Facet>& at) {
  auto normal = normal_of(wo, at.facet, shape);
  Vec3<F> wi = reflect(wo, normal);
  auto weighed = weigh_reflection<Masking>(wo.z, at.view, wi.z, spread(at.facet.nh, normal, at.view.area, shape),
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
  return at_most_delta(ndf(terms.ndf) / (terms.area + terms.area));
}

/// f cos = pdf weight.
template <class Masking, class F>
VNDF_INLINE Evaluation<F> evaluate_pair(F wo_z, F wi_z, const PairTerms<Masking, F>& terms) {
  F pdf = pair_pdf(terms);
  F weight = Masking::weight(wo_z, terms.length, terms.area, wi_z, terms.light);
  auto above = both_above(wo_z, wi_z, terms.area);
  return {op::select(above, pdf * weight, F(0.f)), op::select(above, pdf, F(0.f))};
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
