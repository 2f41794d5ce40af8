// Reflection at a visible normal: direction, density and weight in one pass from the hemisphere configuration, and the
// same density and the BRDF for a given pair of directions.
//
// All of it needs two lengths of the view: a = |A wo|, and `area`, twice the projected area of the normals that are
// sampled: a + (A wo).z for all visible ones, and (A wo).z is wo.z unless the shape leans. Views are unit vectors above
// the horizon or on it; below, directions are written, with density and weight 0.
#pragma once

#include <vndf/lanes/ggx.h>
#include <vndf/lanes/spherical_cap.h>

#include <type_traits>

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

/// The visible cap, the height of which is the area that its normals project to, and |A wo|.
template <class F>
struct CapToReflect {
  CapAtView<F> at;
  F length;
};
template <class F, class Shape = Vec2<F>>
VNDF_INLINE CapToReflect<F> visible_cap_to_reflect(const Vec3<F>& wo, const Shape& shape) {
  Vec3<F> h = stretch(wo, shape);
  auto view = map_to_cap(h, F(1.f));
  Cap<F> cap;
  if constexpr (kUpright<Shape>)
    cap = visible_cap(view);
  else
    cap = visible_cap(view, h.z);
  return {{view.x, view.y, cap}, view.length};
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

/// A normal from the cap. It is the sum of two vectors as long as A wo, one of which is A wo: 2 A wo.nh = |nh|^2.
template <class F>
struct CapFacet {
  Vec3<F> nh;
  F length;
  F area;
};

/// `r2`, e and phi are the disk point, see on_cap.
template <class F>
VNDF_INLINE CapFacet<F> sample_on_cap(const CapToReflect<F>& view, F r2, F e, const Angle<F>& phi) {
  return {with_direction(on_cap(view.at, r2, e, phi)), view.length, view.at.cap.height};
}
template <class F>
VNDF_INLINE CapFacet<F> sample_on_cap(const BoundedCapToReflect<F>& view, F r2, F e, const Angle<F>& phi) {
  Vec3<F> nh = on_cap(view.bounded.at, r2, e, phi);
  nh.z = nh.z + view.rest;
  return {with_direction(nh), view.bounded.length, view.bounded.at.cap.height};
}
template <class F>
VNDF_INLINE Facet<F> facet_of(const CapFacet<F>& facet) {
  F norm2 = dot(facet.nh, facet.nh);
  return {facet.nh, norm2, norm2, facet.length, facet.area};
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

template <class F>
VNDF_INLINE UnitNormal<F> unit_normal(const Facet<F>& facet, const Normal<F>& normal) {
  F inv = F(1.f) / op::sqrt(normal.p2);
  return {{normal.p.x * inv, normal.p.y * inv, normal.p.z * inv}, (facet.twice_cos * F(0.5f)) * inv};
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
  return (op::abs(a.x * g) * op::abs(a.y * g)) * facet.area;
}

/// A weight without the excess over 1 that only rounding can give it.
template <class F>
VNDF_INLINE F at_most_one(F weight) {
  return op::select(weight > F(1.f), F(1.f), weight);
}

/// The weight G2(wo, wi) / G1(wo) and, if the sampling is bounded, times the share of the visible area that it leaves.
/// length_o = |A wo|, length_i = |A wi|.
struct ByLengths {};
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

template <class Masking, class F, class Shape = Vec2<F>>
VNDF_INLINE F reflection_weight(F wo_z, F length, F area, const Vec3<F>& wi, const Shape& shape) {
  if constexpr (std::is_base_of_v<ByLengths, Masking>)
    return Masking::weight(wo_z, length, area, wi.z, stretched_length(wi, shape));
  else
    return Masking::weight(wo_z, area, wi.z, stretch(wi, shape));
}

/// The value where light can go from wi to wo above the surface: wo.z >= 0 and wi.z > 0. Else 0.
template <class F>
VNDF_INLINE F where_above(F wo_z, F wi_z, F value) {
  return op::select(wo_z < F(0.f), F(0.f), op::select(wi_z > F(0.f), value, F(0.f)));
}

/// A sampled direction, its density, and what the light from there counts: f cos / pdf, without Fresnel's factor.
template <class F>
struct ReflectionSample {
  Vec3<F> wi;
  F pdf, weight;
};

/// From a reflected direction, the lengths of its facet and its spread.
template <class Masking, class F, class Shape = Vec2<F>>
VNDF_INLINE ReflectionSample<F> weigh_reflection(F wo_z, const Shape& shape, F length, F area, const Vec3<F>& wi,
                                                 F spread) {
  F weight = reflection_weight<Masking>(wo_z, length, area, wi, shape);
  return {wi, where_above(wo_z, wi.z, F(kInv2Pi) / spread), where_above(wo_z, wi.z, weight)};
}

/// From a facet: reflect, density, weight.
template <class Masking, class F, class Shape = Vec2<F>>
VNDF_INLINE ReflectionSample<F> sample_reflection(const Vec3<F>& wo, const Shape& shape, const Facet<F>& facet) {
  auto normal = normal_of(facet, shape);
  return weigh_reflection<Masking>(wo.z, shape, facet.length, facet.area, reflect(wo, facet, normal),
                                   spread(facet, normal, shape));
}

/// f cos without Fresnel's factor, and the density that sampling has for the pair.
template <class F>
struct Evaluation {
  F f_cos, pdf;
};

/// D(h) / (2 area), and f cos = pdf weight. h = wo + wi is taken as it is: one rounding for each component, none for
/// its length.
template <class Masking, class F, class Shape = Vec2<F>>
VNDF_INLINE Evaluation<F> evaluate_reflection(const Vec3<F>& wo, const Vec3<F>& wi, const Shape& shape, F length,
                                              F area) {
  F pdf = ndf<F>({wo.x + wi.x, wo.y + wi.y, wo.z + wi.z}, shape) / (area + area);
  F weight = reflection_weight<Masking>(wo.z, length, area, wi, narrowed(shape));
  return {where_above(wo.z, wi.z, pdf * weight), where_above(wo.z, wi.z, pdf)};
}

template <class Masking, class F, class Shape = Vec2<F>>
VNDF_INLINE Evaluation<F> evaluate_reflection(const Vec3<F>& wo, const Vec3<F>& wi, const Shape& shape) {
  if constexpr (kUpright<Shape>) {
    F length = stretched_length(wo, narrowed(shape));
    return evaluate_reflection<Masking>(wo, wi, shape, length, length + wo.z);
  } else {
    // Lunes are masked by their areas alone.
    return evaluate_reflection<Masking>(wo, wi, shape, F(0.f), lune_area(stretch(wo, narrowed(shape))));
  }
}

/// The pair of bounded sampling.
template <class Masking, class F>
VNDF_INLINE Evaluation<F> evaluate_reflection_bounded(const Vec3<F>& wo, const Vec3<F>& wi, const Vec2<F>& alpha) {
  F length = stretched_length(wo, alpha);
  return evaluate_reflection<Masking>(wo, wi, alpha, length, length + reflection_bound(wo, alpha).k * wo.z);
}

}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
