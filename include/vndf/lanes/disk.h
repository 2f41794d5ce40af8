// Two random numbers to a point of the unit disk (Heitz 2018, section 4.2), and the chord through it.
#pragma once

#include <vndf/lanes/sincos2pi.h>

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

template <class F>
struct Vec2 {
  F x, y;
};

/// A point of the unit disk: (t1, t2) = r (cos, sin), with e = 1 - r^2, its distance from the rim, known beforehand.
template <class F>
struct DiskPoint {
  F r2, e;
  Angle<F> phi;
};

/// Keeps e above 0 on the rim itself, where the chord's end would otherwise vanish together with the height above it.
/// Far below the rounding of any other e, and its square root below that of the result.
constexpr float kRim = 0x1p-52f;

/// Eq. 9-10: r^2 = u1, phi = 2 pi u2.
template <class F>
VNDF_INLINE DiskPoint<F> polar_map(Vec2<F> u) {
  return {u.x, (F(1.f) - u.x) + F(kRim), sincos2pi(u.y)};
}

/// Where in the square: a = 2 u1 - 1, b = 2 u2 - 1, r the larger of |a|, |b|, and x the quotient of the smaller and r.
template <class F>
struct Wedge {
  F a, b, r, x;
};
template <class F>
VNDF_INLINE Wedge<F> wedge_of(Vec2<F> u) {
  F a = (u.x + u.x) - F(1.f);
  F b = (u.y + u.y) - F(1.f);
  Int<F> abs_a = op::bits(op::abs(a));
  Int<F> abs_b = op::bits(op::abs(b));
  F r = op::from_bits(op::max(abs_a, abs_b));
  F smaller = op::from_bits(op::min(abs_a, abs_b));
  return {a, b, r, smaller / (r + F(kRim))};  // x = 0 at the centre
}

/// Shirley and Chiu 1997, Walter 2015 eq. 34-37: the square's concentric rings become the disk's.
///
/// The four wedges differ by signs and by which coordinate is the larger; the angle from the wedge's axis is pi/4 x.
/// Its sine and cosine are minimax polynomials in x^2, to 2.8e-8 and 4.4e-10. a, b and 1 - r are exact for every
/// multiple of 2^-24.
template <class F>
VNDF_INLINE DiskPoint<F> concentric_map(const Wedge<F>& w) {
  F x = w.x;
  F y = x * x;
  F y2 = y * y;
  F cos = (F(0x1p+0f) + y * F(-0x1.3bd3ccp-2f)) +
          y2 * ((F(0x1.03c1b0p-6f) + y * F(-0x1.55b2b6p-12f)) + y2 * F(0x1.d4f7eep-19f));
  F sin = x * ((F(0x1.921fb6p-1f) + y * F(-0x1.4abbcep-4f)) + y2 * (F(0x1.465ba2p-9f) + y * F(-0x1.2c3460p-15f)));
  auto along_t1 = op::abs(w.a) > op::abs(w.b);
  return {
      w.r * w.r,
      ((F(1.f) - w.r) * (F(1.f) + w.r)) + F(kRim),
      {op::with_sign_of(op::select(along_t1, cos, sin), w.a), op::with_sign_of(op::select(along_t1, sin, cos), w.b)}};
}
template <class F>
VNDF_INLINE DiskPoint<F> concentric_map(Vec2<F> u) {
  return concentric_map(wedge_of(u));
}

/// (t1, t2).
template <class F>
VNDF_INLINE Vec2<F> cartesian(const DiskPoint<F>& t) {
  F r = op::sqrt(t.r2);
  return {r * t.phi.cos, r * t.phi.sin};
}

/// The vertical chord of the disk through (t1, t2), seen from that point. With w = sqrt(1 - t1^2) and d = w + |t2|:
/// top = d (w - t2), bottom = d (w + t2), across = 2 d t1.
///
/// The factor d makes the two distances e and d^2, in the order that the sign of t2 says, so neither is the difference
/// of two near numbers; what follows needs directions only and carries the factor along.
template <class F>
struct Chord {
  F top, bottom, across;
};

/// w^2 = e + t2^2 and d^2 = e + 2 |t2| d are sums of positive terms. r d = r |t2| + sqrt(r^2 w^2) spares the root of
/// r^2.
template <class F>
VNDF_INLINE Chord<F> chord(const DiskPoint<F>& t) {
  F abs_sin = op::abs(t.phi.sin);
  F rt2 = t.r2 * abs_sin;
  F rd = rt2 + op::sqrt(t.r2 * (t.e + rt2 * abs_sin));
  F rd_2 = rd + rd;
  F d2 = t.e + abs_sin * rd_2;
  auto below = t.phi.sin < F(0.f);
  return {op::select(below, d2, t.e), op::select(below, t.e, d2), t.phi.cos * rd_2};
}

}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
