// Two random numbers to a point of the unit disk (Heitz 2018, section 4.2), and the chord through it.
#pragma once

#include <vndf/lanes/sincos2pi.h>
#include <vndf/lanes/vec.h>

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

/// A point of the unit disk: (t1, t2) = r (cos, sin), with e = 1 - r^2, its distance from the rim, known beforehand.
template <class F>
struct DiskPoint {
  F r2, e;
  Angle<F> phi;
};

/// Keeps e above 0 on the rim itself, where the chord's end would otherwise vanish together with the height above it.
/// Far below any e that random numbers have, and its square root below the rounding of what is made of it.
constexpr float kRim = 0x1p-100f;

/// Eq. 9-10: r^2 = u1, phi = 2 pi u2.
template <class F>
VNDF_INLINE DiskPoint<F> polar_map(Vec2<F> u) {
  return {u.x, (F(1.f) - u.x) + F(kRim), sincos2pi(u.y)};
}

/// Where in the square u lies. With a = 2 u1 - 1 and b = 2 u2 - 1, r is the larger of |a| and |b|, and x the smaller
/// over r.
///
/// rim = 1 - r comes first: 1 - |a| is 2 min(u, 1 - u), which is exact for every float. a itself is not.
template <class F>
struct Wedge {
  F a, b;            // for their signs
  Mask<F> along_t1;  // |a| > |b|
  F rim, r, x;
};
template <class F>
VNDF_INLINE Wedge<F> wedge_of(Vec2<F> u) {
  F x = from_nearer_end(u.x), y = from_nearer_end(u.y);
  Int<F> bits_x = op::bits(x), bits_y = op::bits(y);
  F nearer = op::from_bits(op::min(bits_x, bits_y));
  F farther = op::from_bits(op::max(bits_x, bits_y));
  F rim = nearer + nearer;
  F r = F(1.f) - rim;
  F smaller = F(1.f) - (farther + farther);
  return {u.x - F(0.5f), u.y - F(0.5f), x < y, rim, r, smaller / (r + F(kRim))};  // x = 0 at the centre
}

/// The angle from the wedge's axis, by 1 - cos and the sine.
template <class F>
struct WedgeAngle {
  F versine, sin;
};
/// pi/4 x. Minimax polynomials in x^2, to 3.0e-8 and 2.8e-8 relative.
template <class F>
VNDF_INLINE WedgeAngle<F> angle_in_wedge(F x) {
  F y = x * x;
  F y2 = y * y;
  return {y * F(0x1.3bd3ccp-2f) - y2 * ((F(0x1.03c1b0p-6f) + y * F(-0x1.55b2b6p-12f)) + y2 * F(0x1.d4f7eep-19f)),
          x * ((F(0x1.921fb6p-1f) + y * F(-0x1.4abbcep-4f)) + y2 * (F(0x1.465ba2p-9f) + y * F(-0x1.2c3460p-15f)))};
}

/// Shirley and Chiu 1997, Walter 2015 eq. 34-37: the square's concentric rings become the disk's. The four wedges
/// differ by signs and by which coordinate is the larger.
template <class F>
VNDF_INLINE DiskPoint<F> concentric_map(const Wedge<F>& w) {
  auto from_axis = angle_in_wedge(w.x);
  F cos = F(1.f) - from_axis.versine;
  F sin = from_axis.sin;
  return {w.r * w.r,
          (w.rim * (F(1.f) + w.r)) + F(kRim),
          {op::with_sign_of(op::select(w.along_t1, cos, sin), w.a),
           op::with_sign_of(op::select(w.along_t1, sin, cos), w.b)}};
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
/// top = d (w - t2), bottom = d (w + t2), across = 2 d t1, and tilt = bottom - top = 2 d t2.
///
/// With the factor d, the two distances are e and d^2, in the order that the sign of t2 says. Neither is a difference
/// of two near numbers, nor is tilt. What follows needs directions only, so it carries the factor along. It also
/// carries a power of two that keeps the larger of e and r d near 1, since at t = (+-1, 0) all of the chord vanishes.
template <class F>
struct Chord {
  F top, bottom, across, tilt;
};

/// w^2 = e + t2^2 and d^2 = e + 2 |t2| d are sums of positive terms. r d = r |t2| + sqrt(r^2 w^2) spares the root of
/// r^2.
template <class F>
VNDF_INLINE Chord<F> chord(const DiskPoint<F>& t) {
  F abs_sin = op::abs(t.phi.sin);
  F rt2 = t.r2 * abs_sin;
  F rd = rt2 + op::sqrt(t.r2 * (t.e + rt2 * abs_sin));
  Int<F> exponent = op::max(op::bits(rd), op::bits(t.e)) & Int<F>(0x7f800000);
  F scale = op::from_bits(Int<F>(0x7f000000) - exponent);
  F e = t.e * scale;
  F rd_2 = rd * (scale + scale);
  F tilt = t.phi.sin * rd_2;
  F d2 = e + op::abs(tilt);
  auto below = tilt < F(0.f);
  return {op::select(below, d2, e), op::select(below, e, d2), t.phi.cos * rd_2, tilt};
}

}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
