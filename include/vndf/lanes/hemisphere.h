// The stages of Heitz 2018 between the disk and the normal: the hemisphere configuration (section 3.2), the squish and
// the reprojection (sections 4.2 and 4.3), the way back (section 3.4).
#pragma once

#include <vndf/lanes/shape.h>
#include <type_traits>

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

/// A V, scaled by an exact power of two that keeps r2 near 2^28.
template <class F>
struct ScaledView {
  F x, y, z;
  F r2;  // x^2 + y^2
  F length;
};

/// The elevation of the view in the hemisphere configuration, Vh = A V / |A V|.
template <class F>
struct Elevation {
  F inv_length;  // 1 / |A V| in the scale of the view: sqrt(1 - Vh.z^2) = sqrt(r2) inv_length
  F z;           // Vh.z
  // Each to full relative accuracy, the small one of them too.
  F one_plus_z;
  F one_minus_z;
};

/// Vh as an azimuth, the direction of (x, y), and an elevation.
template <class F>
struct HemisphereView {
  F x, y, r2;
  F inv_length, z, one_plus_z, one_minus_z;
};
template <class F>
VNDF_INLINE HemisphereView<F> hemisphere_view(const ScaledView<F>& v, const Elevation<F>& e) {
  return {v.x, v.y, v.r2, e.inv_length, e.z, e.one_plus_z, e.one_minus_z};
}

/// Section 3.2, eq. 5, from h = A V, up to the length of h.
///
/// Scaling by a power of two is exact, takes views of any length and lets near-normal views, whose azimuth components
/// would square to nothing, keep them. A tangent under 2^-46 is taken as 2^-46, which changes no normal by more than
/// that over alpha. Azimuth components under 2^-110 are taken as the direction where azimuths begin. `norm` is |A V|,
/// which the densities need.
constexpr float kSmallestAzimuth = 0x1p-110f;
template <class F, class Azimuth = XAxis>
VNDF_INLINE ScaledView<F> scale_view(const Vec3<F>& h, Azimuth azimuth, F& norm) {
  constexpr std::int32_t kScale = 14, kBias = 127, kExponent = 23;
  constexpr float kLongest = 0x1p60f;
  Int<F> larger = op::max(op::bits(op::abs(h.x)), op::bits(op::abs(h.y)));
  Int<F> exponent = op::max(larger, Int<F>(std::int32_t(0x08800000))) & Int<F>(0x7f800000);  // from kSmallestAzimuth
  F scale = op::from_bits(op::minus(Int<F>(std::int32_t(std::uint32_t(2 * kBias + kScale) << kExponent)), exponent));
  auto none = op::from_bits(larger) < F(kSmallestAzimuth);
  F x, y;
  if constexpr (std::is_same_v<Azimuth, XAxis>) {
    x = op::select(none, F(kSmallestAzimuth), h.x) * scale;
    y = h.y * scale;
  } else {
    x = op::select(none, azimuth.cos * F(kSmallestAzimuth), h.x) * scale;
    y = op::select(none, azimuth.sin * F(kSmallestAzimuth), h.y) * scale;
  }
  F true_z = op::abs(h.z * scale);
  auto steep = true_z > F(kLongest);
  F abs_z = op::select(steep, F(kLongest), true_z);
  F r2 = x * x + y * y;
  F length = op::sqrt(r2 + abs_z * abs_z);
  norm = op::select(steep, op::abs(h.z), length * op::from_bits(exponent - Int<F>(kScale << kExponent)));
  return {x, y, op::with_sign_of(abs_z, h.z), r2, length};
}

/// The rest of eq. 5: 1 - |z| = r2 / (length (length + |z| length)), without a difference.
template <class F>
VNDF_INLINE Elevation<F> elevation_of(const ScaledView<F>& v) {
  F abs_z = op::abs(v.z);
  F sum = v.length + abs_z;
  F inv = F(1.f) / (v.length * sum);
  F inv_length = sum * inv;
  F cos = abs_z * inv_length;
  F large = F(1.f) + cos;
  F small = v.r2 * inv;
  auto below = v.z < F(0.f);
  return {inv_length, op::with_sign_of(cos, v.z), op::select(below, small, large), op::select(below, large, small)};
}

template <class F, class Azimuth = XAxis>
VNDF_INLINE HemisphereView<F> map_to_hemisphere(const Vec3<F>& h, Azimuth azimuth = {}) {
  F norm;
  auto view = scale_view(h, azimuth, norm);
  return hemisphere_view(view, elevation_of(view));
}

/// A visible normal in the hemisphere configuration, of any length, and its cosine to the view in the same scale.
template <class F>
struct ProjectedPoint {
  Vec3<F> nh;
  F cos;
};

/// The squish, section 4.2, eq. 11: t2' = (1 - s) w + s t2 with s = (1 + z) / 2, and the reprojection, section 4.3,
/// eq. 12-13: Nh = t1 T1 + t2' T2 + v Vh with v = sqrt(1 - t1^2 - t2'^2), T1 = (-Vh.y, Vh.x, 0) / |.| and T2 = Vh x T1,
/// up to a positive factor.
///
/// With rho = sqrt(1 - z^2) and everything times 2 d: t2' is bottom - z top, and v the root of (rho top)^2 + 2 (1 + z)
/// top bottom, a sum of positive terms. What v exceeds rho top by is then 2 (1 + z) top bottom / (v + rho top), and
/// written with that excess neither the component towards the view, rho v - z t2', nor the third one, rho t2' + z v, is
/// a difference of what nearly cancels: the former is (1 - z) top - z tilt + rho excess, the latter a quotient of sums
/// of positive terms. The whole vector is scaled by the denominator.
///
/// (1 + z) top is kept over 2^-92, so that v does not vanish at the rim for views near -z, and changes by at most 2^-46
/// for that.
template <class F>
VNDF_INLINE ProjectedPoint<F> reproject(const HemisphereView<F>& view, const Chord<F>& t) {
  F lift = (view.r2 * view.one_plus_z) * t.top + F(0x1p-64f);  // r2 (1 + z) top
  F rho = view.r2 * view.inv_length;                           // all times sqrt(r2), like the height
  F rho_top = rho * t.top;
  F excess = lift * (t.bottom + t.bottom);
  F height = op::sqrt(excess + rho_top * rho_top);
  F denominator = height + rho_top;
  F toward = denominator * (view.one_minus_z * t.top - view.z * t.tilt) + excess * view.inv_length;
  F across = denominator * t.across;
  return {{toward * view.x - across * view.y, toward * view.y + across * view.x,
           t.bottom * (view.one_plus_z * lift + rho * height)},
          denominator * height};
}

/// A normal in the ellipsoid configuration, of any length.
template <class F>
struct LongNormal {
  Vec3<F> p;
  F p2;  // |p|^2
};

/// Section 3.4, eq. 6, A^T Nh for Nh of any length up to 2^33. One that has no direction becomes +z.
template <class F, class Shape = Vec2<F>>
VNDF_INLINE LongNormal<F> stretch_normal(const Vec3<F>& nh, const Shape& shape) {
  Vec3<F> p = stretch_back(nh, shape);
  F p2 = dot(p, p);
  auto none = p2 < F(0x1p-126f);
  // Twice +z: what compilers know to be 1 they do not multiply by, and a denormal p.x would stay one where the caller
  // has them flushed.
  return {{p.x, p.y, op::select(none, F(2.f), p.z)}, op::select(none, F(4.f), p2)};
}

/// The rest of eq. 6, Ne = A^T Nh / |A^T Nh|, turned back from the frame that theta_z turned.
template <class F, class Shape = Vec2<F>, class Theta = XAxis>
VNDF_INLINE Vec3<F> map_from_hemisphere(const Vec3<F>& nh, const Shape& shape, const Theta& theta_z = {}) {
  auto normal = stretch_normal(nh, shape);
  F inv = F(1.f) / op::sqrt(normal.p2);
  Vec3<F> p = turn_back(normal.p, theta_z);  // beside the root, not behind it
  return {p.x * inv, p.y * inv, p.z * inv};
}

}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
