// The stages of Heitz 2018 between the disk and the normal: the hemisphere configuration (section 3.2), the squish and
// the reprojection (sections 4.2 and 4.3), the way back (section 3.4).
#pragma once

#include <vndf/lanes/shape.h>
#include <type_traits>

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

/// A V, scaled by an exact power of two that keeps r2 near 2^40.
template <class F>
struct ScaledView {
  F x, y, z;
  F r2;  // x^2 + y^2
  F length;
};

/// The elevation of the view in the hemisphere configuration, Vh = A V / |A V|.
template <class F>
struct Elevation {
  F inv_length;   // 1 / |A V| in the scale of the view: sqrt(1 - Vh.z^2) = sqrt(r2) inv_length
  F z;            // Vh.z
  F one_plus_z;   // each to full relative accuracy, whichever of them is
  F one_minus_z;  // the small one
};

/// Vh with its azimuth, the direction of (x, y), and its elevation apart.
template <class F>
struct HemisphereView {
  F x, y, r2;
  F inv_length, z, one_plus_z, one_minus_z;
};
template <class F>
VNDF_INLINE HemisphereView<F> hemisphere_view(const ScaledView<F>& v, const Elevation<F>& e) {
  return {v.x, v.y, v.r2, e.inv_length, e.z, e.one_plus_z, e.one_minus_z};
}

/// Section 3.2, eq. 5, from h = A V, as far as the length.
///
/// Scaling by a power of two is exact, takes views of any length and lets near-normal views, whose azimuth components
/// would square to nothing, keep them. A tangent under 2^-32 is taken as 2^-32 and changes no normal by more than
/// 2^-32; azimuth components under 2^-100 are taken as the direction where azimuths begin. `norm` is |A V|, which the
/// densities need.
template <class F, class Azimuth = XAxis>
VNDF_INLINE ScaledView<F> scale_view(const Vec3<F>& h, Azimuth azimuth, F& norm) {
  constexpr float kSmallest = 0x1p-100f, kLongest = 0x1p52f;
  Int<F> larger = op::max(op::bits(op::abs(h.x)), op::bits(op::abs(h.y)));
  Int<F> exponent = op::max(larger, Int<F>(0x0d800000)) & Int<F>(0x7f800000);       // at least kSmallest
  F scale = op::from_bits(op::minus(Int<F>(std::int32_t(0x89000000u)), exponent));  // 2^20 / 2^exponent
  auto none = op::from_bits(larger) < F(kSmallest);
  F x, y;
  if constexpr (std::is_same_v<Azimuth, XAxis>) {
    x = op::select(none, F(kSmallest), h.x) * scale;
    y = h.y * scale;
  } else {
    x = op::select(none, azimuth.cos * F(kSmallest), h.x) * scale;
    y = op::select(none, azimuth.sin * F(kSmallest), h.y) * scale;
  }
  F abs_z = op::abs(h.z * scale);
  auto steep = abs_z > F(kLongest);
  abs_z = op::select(steep, F(kLongest), abs_z);
  F r2 = x * x + y * y;
  F length = op::sqrt(r2 + abs_z * abs_z);
  norm = op::select(steep, op::abs(h.z), length * op::from_bits(exponent - Int<F>(20 << 23)));  // length / scale
  return {x, y, op::with_sign_of(abs_z, h.z), r2, length};
}

/// The rest of it: 1 - |z| = r2 / (length (length + |z| length)), no difference taken.
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

/// What the squish leaves of the chord, with z the view's: lift = (1 + z) top, and the height of the normal above the
/// squished point, height2 = (2 d)^2 (1 - t1^2 - t2'^2).
template <class F>
struct Squished {
  F lift, height2;
};

/// Section 4.2, eq. 11: t2' = (1 - s) w + s t2, which is (bottom - z top) / 2 d.
///
/// 1 - t1^2 - t2'^2 = s e + ((1 - z^2) / 4) (w - t2)^2 is a sum of positive terms, and the points where it vanishes are
/// those of the rim.
template <class F>
VNDF_INLINE Squished<F> squish(const HemisphereView<F>& view, const Chord<F>& t) {
  F lift = view.one_plus_z * t.top;
  F drop = view.one_minus_z * t.top;
  return {lift, lift * ((t.bottom + t.bottom) + drop)};
}

/// Section 4.3, eq. 12-13: Nh = t1 T1 + t2' T2 + v Vh with v = sqrt(1 - t1^2 - t2'^2), T1 = (-Vh.y, Vh.x, 0) / |.| and
/// T2 = Vh x T1, up to a positive factor.
///
/// With rho = sqrt(1 - z^2) and everything times 2 d, v is close to rho top, and what it exceeds it by is
/// 2 lift bottom / (v + rho top). Written with that excess, neither the component towards the view, rho v - z t2', nor
/// the third one, rho t2' + z v, is a difference of what nearly cancels: the former is top - z bottom + rho excess, the
/// latter a quotient of sums of positive terms. The whole vector is scaled by the denominator. `cos` is Nh.Vh, which is
/// v, in the same scale.
template <class F>
VNDF_INLINE Vec3<F> reproject(const HemisphereView<F>& view, const Chord<F>& t, const Squished<F>& p, F& cos) {
  F height = op::sqrt(view.r2 * p.height2);
  F rho = view.r2 * view.inv_length;  // scaled like the height
  F denominator = height + rho * t.top;
  cos = denominator * height;
  F toward = denominator * (t.top - view.z * t.bottom) + (rho * p.lift) * (t.bottom + t.bottom);
  F across = denominator * t.across;
  return {toward * view.x - across * view.y, toward * view.y + across * view.x,
          (view.r2 * t.bottom) * (view.one_plus_z * p.lift + height * view.inv_length)};
}

template <class F>
VNDF_INLINE Vec3<F> reproject(const HemisphereView<F>& view, const Chord<F>& t, const Squished<F>& p) {
  F cos;
  return reproject(view, t, p, cos);
}

/// Section 3.4, eq. 6: Ne = A^T Nh / |A^T Nh|, for Nh of any length up to 2^60. And back from a frame that is turned.
///
/// The addend is far below the rounding of any Nh that has a direction; one that has none becomes +z.
template <class F, class Shape = Vec2<F>, class Theta = XAxis>
VNDF_INLINE Vec3<F> map_from_hemisphere(const Vec3<F>& nh, const Shape& shape, const Theta& theta_z = {}) {
  Vec3<F> p = stretch_back<F>({nh.x, nh.y, nh.z + F(0x1p-62f)}, shape);
  F inv = F(1.f) / op::sqrt(dot(p, p));
  p = turn_back(p, theta_z);  // beside the root, not behind it
  return {p.x * inv, p.y * inv, p.z * inv};
}

}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
