// Masking of the view and shadowing of the light: Smith's G, and the lunes of leaning ellipsoids.
//
// Smith's functions are rational in v.z and a = |A v|, with A = diag(alpha_x, alpha_y, 1):
// 1 + Lambda(v) = (a + v.z) / (2 v.z), and (a + v.z) / 2 is the projected area of what v sees.
//
// A masking has `shadowing(wi, shape)`, what it needs of the light's direction; `weight`, which is G2(wo, wi) / G1(wo);
// and `weight_of_side`, the same for dielectrics, where wi may be across the surface.
#pragma once

#include <vndf/lanes/beta.h>
#include <vndf/lanes/shape.h>
#include <vndf/vndf.h>

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

/// |A v|.
template <class F, class Shape = Vec2<F>>
VNDF_INLINE F stretched_length(const Vec3<F>& v, const Shape& shape) {
  Vec3<F> h = stretch(v, shape);
  return op::sqrt(dot(h, h));
}

/// |A v| + (A v).z, in proportion to the projected area of the normals that v sees (Walter et al. 2015, eq. 28), for
/// any v. Below the horizon it is |((A v).x, (A v).y)|^2 / (|A v| - (A v).z).
template <class F>
VNDF_INLINE F lune_area(const Vec3<F>& h) {
  F l2 = h.x * h.x + h.y * h.y;
  F sum = op::sqrt(l2 + h.z * h.z) + op::abs(h.z);
  return op::select(h.z < F(0.f), l2 / sum, sum);
}

/// The same from |A v| and the elevation of A v: 1 + z where that is a small number.
template <class F>
VNDF_INLINE F lune_area(F length, F h_z, F one_plus_z) {
  return op::select(h_z < F(0.f), length * one_plus_z, length + h_z);
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

/// What the shading step needs to know of the view: wo.z, |A wo|, and `area` = |A wo| + k (A wo).z, twice the projected
/// area of the normals that are sampled; k = 1 if not bounded.
template <class F>
struct SeenView {
  F z, length, area;
};

/// A weight without the excess over 1 that only rounding can give it; 1 where view and light graze so much that both
/// terms of the quotient vanish.
template <class F>
VNDF_INLINE F at_most_one(F weight) {
  return op::select(weight <= F(1.f), weight, F(1.f));
}

/// Lambda of a direction, from |A v|.
template <class F>
VNDF_INLINE F smith_lambda(F v_z, F length) {
  F lambda = (length - v_z) / (v_z + v_z);
  return op::select(lambda > F(0.f), lambda, F(0.f));
}

/// Smith's: G1(wo) G1(wi) if separable, else height-correlated, 1 / (1 + Lambda(wo) + Lambda(wi)), Heitz 2014, eq. 99.
/// If the sampling is bounded, the weight is times the share of the visible area that it leaves.
struct Smith {
  static constexpr bool kEven = true;  // what it needs of a direction is that of the opposite one

  Masking masking;
  AcrossMasking across = AcrossMasking::separable;

  /// |A wi|.
  template <class F>
  using Shadowing = F;
  template <class F, class Shape>
  static VNDF_INLINE F shadowing(const Vec3<F>& wi, const Shape& shape) {
    return stretched_length(wi, shape);
  }

  /// As quotients, so that where a lane takes the one or the other, one division takes both.
  template <class F>
  struct Quotient {
    F numerator, denominator;
  };
  template <class F>
  VNDF_INLINE Quotient<F> quotient(const SeenView<F>& view, F wi_z, F length_i) const {
    if (masking == Masking::separable) return {(wi_z + wi_z) * view.area, (wi_z + length_i) * (view.z + view.length)};
    return correlated(view, wi_z, length_i);
  }
  template <class F>
  VNDF_INLINE F weight(const SeenView<F>& view, F wi_z, F length_i) const {
    auto q = quotient(view, wi_z, length_i);
    return at_most_one(q.numerator / q.denominator);
  }

  /// Of all visible normals. Across the surface, G is that of wi mirrored to the view's side. Where `any_crosses` is
  /// false every lane reflects; the beta function costs more than all the rest.
  template <class F>
  VNDF_INLINE F weight_of_side(Mask<F> reflects, bool any_crosses, const SeenView<F>& view, F wi_z, F length_i) const {
    F mirrored_z = F(0.f) - wi_z;
    if (across == AcrossMasking::height_correlated) {
      F above = weight(view, wi_z, length_i);
      if (!any_crosses) return above;
      F beta = x_beta(smith_lambda(view.z, view.length), smith_lambda(mirrored_z, length_i));
      return op::select(reflects, above, at_most_one(beta));
    }
    auto above = quotient(view, wi_z, length_i);
    Quotient<F> g1 = {mirrored_z + mirrored_z, mirrored_z + length_i};
    auto below = across == AcrossMasking::as_reflection ? correlated(view, mirrored_z, length_i) : g1;
    return at_most_one(op::select(reflects, above.numerator, below.numerator) /
                       op::select(reflects, above.denominator, below.denominator));
  }

  /// (1 + Lambda(wo)) / (1 + Lambda(wo) + Lambda(wi)), Heitz 2014, eq. 99.
  template <class F>
  static VNDF_INLINE Quotient<F> correlated(const SeenView<F>& view, F wi_z, F length_i) {
    return {wi_z * view.area, wi_z * view.length + length_i * view.z};
  }
};
constexpr Smith kHeightCorrelated{Masking::height_correlated};
constexpr Smith kSeparable{Masking::separable};

/// The lunes of an ellipsoid (Walter et al. 2015).
///
/// G = G1(wo) G1(wi), eq. 5, with G1(v) = min(1, 2 v.z / (|A v| + (A v).z)), eq. 6. Leaning ellipsoids can show less
/// than the surface that they stand for; the minimum keeps G1 plausible.
struct Lunes {
  static constexpr bool kEven = false;

  /// G1(wi) as a quotient of two positive numbers.
  template <class F>
  struct Shadowing {
    F numerator, denominator;
  };
  template <class F, class Shape>
  static VNDF_INLINE Shadowing<F> shadowing(const Vec3<F>& wi, const Shape& shape) {
    Vec3<F> h = stretch(wi, shape);
    F l2 = h.x * h.x + h.y * h.y;
    F sum = op::sqrt(l2 + h.z * h.z) + op::abs(h.z);
    auto below = h.z < F(0.f);  // where |h| + h.z = l2 / sum
    F whole = wi.z + wi.z;
    whole = op::select(below, whole * sum, whole);
    F area = op::select(below, l2, sum);
    return {op::from_bits(op::min(op::bits(whole), op::bits(area))), area};
  }

  /// Eq. 50: G1(wo) G1(wi) area / (2 wo.z), which is min(1, area / (2 wo.z)) G1(wi). Each is a quotient of a smaller
  /// number and a larger one, and one division takes both, so that it exceeds 1 by no rounding. The minimum and the
  /// maximum are those of bits, for positive numbers; what the others give is not used.
  template <class F>
  static VNDF_INLINE F weight(const SeenView<F>& view, F, const Shadowing<F>& light) {
    F larger = op::from_bits(op::max(op::bits(view.area), op::bits(view.z + view.z)));
    return at_most_one((view.area * light.numerator) / (larger * light.denominator));
  }
  /// Eq. 7: across the surface it is that of the direction that is mirrored to the view's side.
  template <class F>
  static VNDF_INLINE F weight_of_side(Mask<F>, bool, const SeenView<F>& view, F wi_z, const Shadowing<F>& light) {
    return weight(view, wi_z, light);
  }
};
constexpr Lunes kLunes;

}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
