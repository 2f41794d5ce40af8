// Dupuy and Benyoub 2023: visible hemisphere normals as half vectors of the view and a uniform point c of a spherical
// cap. Eto and Tokuyoshi 2023: a smaller cap, for reflection.
//
// Nh = c + Vh cancels where c is nearly opposite to the view: for a floor seen straight ahead, that is where u2 is
// near 1. So c's azimuth counts from there, from the point opposite to the view, and the sum is taken in its frame,
// r along -(x, y) and t across, where sin_c - sin_e is a quotient (sin_c^2 - sin_e^2) / (sin_c + sin_e) whose numerator
// factors. Everything is multiplied by the denominator, which leaves a polynomial and one root.
#pragma once

#include <vndf/lanes/hemisphere.h>

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

/// A point of the cap, as far as the random numbers say. u2 grows from the pole of the cap to its rim; phi counts from
/// the direction opposite to the view, counter-clockwise.
template <class F>
struct CapPoint {
  F u2, v;  // v = 1 - u2
  Deviation<F> phi;
};

/// Dupuy and Benyoub 2023, Listing 3: u1 = phi / 2 pi.
template <class F>
VNDF_INLINE CapPoint<F> cap_map(Vec2<F> u) {
  return {u.y, F(1.f) - u.y, deviation2pi(u.x)};
}
/// Lambert's equal-area map of the disk's point of eq. 9-10 of Heitz 2018.
template <class F>
VNDF_INLINE CapPoint<F> polar_cap_map(Vec2<F> u) {
  return {u.x, F(1.f) - u.x, deviation2pi(u.y)};
}
/// Of the concentric map's point. In the wedge around +t1 the versine is the polynomial's.
template <class F>
VNDF_INLINE CapPoint<F> concentric_cap_map(const Wedge<F>& w) {
  auto from_axis = angle_in_wedge(w.x);
  F cos = F(1.f) - from_axis.versine;
  F along = op::select(w.along_t1, cos, from_axis.sin);
  F across = op::select(w.along_t1, from_axis.sin + F(kTinySine), cos);
  F versine = F(1.f) - op::with_sign_of(along, w.a);
  return {w.r * w.r,
          w.rim * (F(1.f) + w.r),
          {op::select(w.along_t1, op::select(w.a > F(0.f), from_axis.versine, versine), versine),
           op::with_sign_of(across, F(0.f) - w.b)}};
}

/// The view in the hemisphere configuration, A V, with its largest component scaled to 2^16 by a power of two.
/// (1 + z) : (1 - z) is plus : minus, with plus + minus = 2 |A V| and plus minus = r2, neither a difference.
template <class F>
struct CapView {
  F x, y, z, r2;  // r2 = x^2 + y^2
  F length;
  F plus, minus;
  F scale;  // the power of two
};
/// The factor that takes lengths back to those of A V.
template <class F>
VNDF_INLINE F unscale(const CapView<F>& view) {
  return op::from_bits(Int<F>(0x7f000000) - op::bits(view.scale));
}

/// Section 3.2 of Heitz 2018, eq. 5, from h = A V. Where the tangent is under 2^-56 the azimuth is `azimuth`: nothing
/// that a normal is made of is small there.
template <class F, class Azimuth = XAxis>
VNDF_INLINE CapView<F> cap_view(const Vec3<F>& h, Azimuth azimuth = {}) {
  constexpr std::int32_t kScale = 16, kBias = 127, kExponent = 23;
  constexpr float kSmallest = 0x1p-40f;
  Int<F> abs_x = op::bits(op::abs(h.x)), abs_y = op::bits(op::abs(h.y)), bits_z = op::bits(op::abs(h.z));
  Int<F> larger = op::max(abs_x, abs_y);
  Int<F> exponent = op::max(op::max(larger, bits_z), Int<F>((kScale + 1) << kExponent)) & Int<F>(0x7f800000);
  F scale = op::from_bits(op::minus(Int<F>(std::int32_t(std::uint32_t(2 * kBias + kScale) << kExponent)), exponent));
  F x = h.x * scale, y = h.y * scale, z = h.z * scale;
  auto none = op::from_bits(larger) * scale < F(kSmallest);
  if constexpr (std::is_same_v<Azimuth, XAxis>) {
    x = op::select(none, F(kSmallest), x);
  } else {
    x = op::select(none, azimuth.cos * F(kSmallest), x);
    y = op::select(none, azimuth.sin * F(kSmallest), y);
  }
  F abs_z = op::abs(z);
  F r2 = x * x + y * y;
  F length = op::sqrt(r2 + abs_z * abs_z);
  F large = length + abs_z;
  F small = r2 / large;
  auto below = z < F(0.f);
  return {x, y, z, r2, length, op::select(below, small, large), op::select(below, large, small), scale};
}

/// A visible normal from a cap, of any length, and `per_cos`, |nh|^2 / (2 A V.nh) for the scaled view.
template <class F>
struct CapNormal {
  Vec3<F> nh;
  F per_cos;
};

/// Keeps a normal from being shorter than 2^-63 where u2 is nearly 0 and the view is along the normal: its height would
/// vanish with r^2, though its direction does not. Tilts a normal of that view by at most 2^-38.
constexpr float kPole = 0x1p-78f;

/// c + Vh from its component towards the view's azimuth, its component across and its height.
template <class F>
VNDF_INLINE Vec3<F> along_view(const CapView<F>& view, F toward, F across, F z) {
  return {toward * view.x - across * view.y, toward * view.y + across * view.x, z};
}

/// The cap c.z >= -Vh.z, the directions that all visible normals reflect the view to (Dupuy and Benyoub 2023).
///
/// With G = minus + v plus and S = sqrt(u2 minus G), and the factor (S + minus) |A V|: the component towards the view
/// is (1 - cos phi) (u2 G + S) - v fall, that across -sin phi (u2 G + S), and the height v plus (S + minus).
///
/// fall = u2 plus - minus = 2 A V.z - v plus: the one form loses digits at the rim of the cap, the other at its pole.
template <class F>
VNDF_INLINE CapNormal<F> on_cap(const CapView<F>& view, const CapPoint<F>& c) {
  F v_plus = c.v * view.plus;
  F g = view.minus + v_plus;
  F u2_g = c.u2 * g;
  F s = op::sqrt(u2_g * view.minus);
  F w = u2_g + s;
  F fall = op::select(c.v < F(0.5f), (view.z + view.z) - v_plus, c.u2 * view.plus - view.minus);
  F toward = c.phi.versine * w - c.v * fall;
  F per_cos = (s + view.minus) + F(kPole);
  return {along_view(view, toward, c.phi.minus_sin * w, v_plus * per_cos), per_cos};
}

/// The bound of Eto and Tokuyoshi 2023, eq. 5, with alpha the smaller of the two and at most 1 (their eq. 6; Tokuyoshi
/// and Eto 2024): no direction above the horizon is reflected from a c below -k Vh.z. For wo.z >= 0.
///
/// 1 - k = alpha^2 (s^2 + z^2) / (s^2 + alpha^2 z^2), without a difference.
template <class F>
struct Bound {
  F k, one_minus_k;
};

template <class F>
VNDF_INLINE Bound<F> reflection_bound(Vec3<F> wo, Vec2<F> alpha) {
  Int<F> smaller = op::min(op::bits(op::abs(alpha.x)), op::bits(op::abs(alpha.y)));
  F a = op::from_bits(op::min(smaller, Int<F>(0x3f800000)));
  F s = F(1.f) + op::sqrt(wo.x * wo.x + wo.y * wo.y);
  F s2 = s * s;
  F z2 = wo.z * wo.z;
  F a2 = a * a;
  F inv = F(1.f) / (s2 + a2 * z2);
  return {(((F(1.f) - a) * (F(1.f) + a)) * s2) * inv, (a2 * (s2 + z2)) * inv};
}

/// The cap c.z >= -k Vh.z, for views with z >= 0.
///
/// With d = v (|A V| + k z) and R = sqrt(u2 (|A V|^2 - (k z)^2 + (|A V| + k z) d)), the root of |A V|^2 sin_c^2, and
/// the factor (R + r) |A V| r: the component towards the view is (1 - cos phi) R (R + r) - fall (d + (1 - k) z), that
/// across -sin phi R (R + r), the height (d + (1 - k) z) (R + r). Again there are two forms of a difference: fall =
/// u2 (|A V| + k z) - minus = (1 + k) z - d.
template <class F>
VNDF_INLINE CapNormal<F> on_bounded_cap(const CapView<F>& view, const Bound<F>& bound, const CapPoint<F>& c) {
  F abs_z = op::abs(view.z);
  F height = view.length + bound.k * abs_z;
  F rest = bound.one_minus_k * abs_z;
  F whole = (F(1.f) + bound.k) * abs_z;
  F radius2 = view.r2 + rest * whole;
  F d = c.v * height;
  F h_z = d + rest;
  F r2 = c.u2 * (radius2 + height * d);
  F rr = op::sqrt(r2 * view.r2);
  F w = r2 + rr;
  F fall = op::select(c.v < F(0.5f), whole - d, c.u2 * height - view.minus);
  F toward = c.phi.versine * w - fall * h_z;
  F per_cos = (rr + view.r2) + F(kPole);
  return {along_view(view, toward, c.phi.minus_sin * w, h_z * per_cos), per_cos};
}

}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
