// Reflection at a visible normal: direction, density and weight in one pass from the hemisphere configuration, and the
// same density and the BRDF for a given pair of directions.
//
// All of it needs two lengths of the view: a = |A wo|, and `area`, twice the projected area of the normals that are
// sampled: a + (A wo).z for all visible ones, and (A wo).z is wo.z unless the shape leans. Views are unit vectors above
// the horizon or on it; below, directions are written, with density and weight 0.
#pragma once

#include <vndf/lanes/ndf.h>
#include <vndf/lanes/warps.h>

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

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
template <class F, class Facet>
VNDF_INLINE Normal<F> normal_of(const Facet& facet, const SeenNormal<F>& seen) {
  constexpr float kRounding = 0x1p-22f;  // of 4 (wo.wm)^2
  const auto& [p, p2] = seen.normal;
  auto inverse = inverses(facet, p2);
  F of_p = (seen.wo_p + seen.wo_p) * inverse.inv_p2;
  F off = op::abs(inverse.along * inverse.along - of_p * of_p) * p2;
  return {p, p2, inverse.inv_p2, op::select(off < F(kRounding), inverse.along, of_p)};
}
template <class F, class Facet, class Shape = Vec2<F>>
VNDF_INLINE Normal<F> normal_of(const Vec3<F>& wo, const Facet& facet, const Shape& shape) {
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

/// From a reflected direction's height, its view, and its spread.
template <class Masking, class F, class Shadowing>
VNDF_INLINE Weighed<F> weigh_reflection(const SeenView<F>& view, F wi_z, F spread, const Masking& masking,
                                        const Shadowing& shadowing) {
  F weight = masking.weight(view, wi_z, shadowing);
  auto above = both_above(view.z, wi_z, view.area);
  return {op::select(above, at_most_delta(F(kInv2Pi) / spread), F(0.f)), op::select(above, weight, F(0.f))};
}

/// A facet, and the view that it was sampled for.
template <class F, class Facet>
struct FacetOfView {
  Facet facet;
  SeenView<F> view;
};

/// The facet that the warp maps u to.
template <class Warp, class F, class Shape = Vec2<F>>
VNDF_INLINE auto sample_facet(const Vec3<F>& wo, const Shape& shape, Vec2<F> u) {
  Vec3<F> h = stretch(wo, shape);  // Heitz 2018, 3.2, eq. 5
  if constexpr (Warp::kOnDisk) {
    auto t = chord(Warp::disk_point(u));  // 4.2, eq. 9-10
    F length;
    auto scaled = scale_view(h, azimuth_of(shape), length);
    auto elevation = elevation_of(scaled);
    F area = kUpright<Shape> ? length + wo.z : lune_area(length, h.z, elevation.one_plus_z);
    auto point = reproject(hemisphere_view(scaled, elevation), t);  // 4.2-4.3, eq. 11-13
    return FacetOfView<F, Facet<F>>{{point.nh, (point.cos + point.cos) * length}, {wo.z, length, area}};
  } else {
    auto view = cap_view(h, azimuth_of(shape));
    F length = view.length * unscale(view);
    if constexpr (Warp::kBounded) {
      auto bound = reflection_bound(wo, shape);
      auto normal = on_bounded_cap(view, bound, Warp::cap_point(u));
      return FacetOfView<F, CapFacet<F>>{facet_of(normal, view), {wo.z, length, length + bound.k * op::abs(h.z)}};
    } else {
      auto normal = on_cap(view, Warp::cap_point(u));
      F area = kUpright<Shape> ? length + h.z : view.plus * unscale(view);
      return FacetOfView<F, CapFacet<F>>{facet_of(normal, view), {wo.z, length, area}};
    }
  }
}

template <class F>
struct ReflectionSample {
  Vec3<F> wi;
  F pdf, weight;
  Normal<F> normal;  // unit_normal(normal) is wm, and its cosine to the view
};

/// Reflection at the visible normal that the warp maps u to, Bounded<Warp> at the smaller cap's. `masking` is
/// kHeightCorrelated, kSeparable or, for ellipsoids, kLunes.
///
/// Source: Heitz 2018, eq. 16, 17 and 19.
template <class Warp, class Masking, class F, class Shape = Vec2<F>>
VNDF_INLINE ReflectionSample<F> sample_reflection(const Vec3<F>& wo, const Shape& shape, Vec2<F> u,
                                                  const Masking& masking) {
  const auto& floats = narrowed(shape);
  auto [facet, view] = sample_facet<Warp>(wo, shape, u);
  auto normal = normal_of(wo, facet, floats);  // eq. 6
  Vec3<F> wi = reflect(wo, normal);            // eq. 16
  auto weighed = weigh_reflection(view, wi.z, spread(facet.nh, normal, view.area, floats), masking,
                                  masking.shadowing(wi, floats));  // eq. 17, 19
  return {wi, weighed.pdf, weighed.weight, normal};
}

/// f cos without Fresnel's factor, and the density that sampling has for the pair.
template <class F>
struct Evaluation {
  F f_cos, pdf;
};

/// The view of a given pair.
template <class F, class Shape>
VNDF_INLINE SeenView<F> seen_view(const Vec3<F>& wo, const Shape& shape) {
  if constexpr (kUpright<Shape>) {
    F length = stretched_length(wo, narrowed(shape));
    return {wo.z, length, length + wo.z};
  } else {
    // Lunes are masked by their areas alone.
    return {wo.z, F(0.f), lune_area(stretch(wo, narrowed(shape)))};
  }
}

/// D(h) / (2 area).
template <class F>
VNDF_INLINE F pair_pdf(const NdfTerms<F>& ndf_terms, const SeenView<F>& view) {
  return at_most_delta(ndf(ndf_terms) / (view.area + view.area));
}

/// The cosine of two unit vectors to what lies between them is half the length of their sum.
template <class F>
VNDF_INLINE F half_cosine(const Vec3<F>& wo, const Vec3<F>& wi) {
  Vec3<F> h = {wo.x + wi.x, wo.y + wi.y, wo.z + wi.z};
  return at_most_one_cosine(op::sqrt(dot(h, h)) * F(0.5f));
}

/// f cos = pdf weight. h = wo + wi is taken as it is: one rounding for each component, none for its length.
template <class F, class Masking, class Shape>
VNDF_INLINE Evaluation<F> evaluate_seen(const Vec3<F>& wo, const Vec3<F>& wi, const Shape& shape,
                                        const SeenView<F>& view, const Masking& masking) {
  auto terms = ndf_terms(Vec3<F>{wo.x + wi.x, wo.y + wi.y, wo.z + wi.z}, shape);
  F pdf = pair_pdf(terms, view);
  F weight = masking.weight(view, wi.z, masking.shadowing(wi, narrowed(shape)));
  auto above = both_above(view.z, wi.z, view.area);
  return {op::select(above, pdf * weight, F(0.f)), op::select(above, pdf, F(0.f))};
}

/// The BRDF of a pair of directions, eq. 15 of Heitz 2018, and the density that sample_reflection has for it, eq. 17.
template <class F, class Masking, class Shape = Vec2<F>>
VNDF_INLINE Evaluation<F> evaluate_reflection(const Vec3<F>& wo, const Vec3<F>& wi, const Shape& shape,
                                              const Masking& masking) {
  return evaluate_seen(wo, wi, shape, seen_view(wo, shape), masking);
}
/// The same of bounded sampling, Eto and Tokuyoshi 2023, eq. 8.
template <class F, class Masking>
VNDF_INLINE Evaluation<F> evaluate_reflection_bounded(const Vec3<F>& wo, const Vec3<F>& wi, const Vec2<F>& alpha,
                                                      const Masking& masking) {
  auto view = seen_view(wo, alpha);
  view.area = view.length + reflection_bound(wo, alpha).k * wo.z;
  return evaluate_seen(wo, wi, alpha, view, masking);
}

}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
