// Angles of a shape, in radians, and rotations about n.
#pragma once

#include <vndf/lanes/sincos2pi.h>
#include <vndf/lanes/split.h>
#include <vndf/lanes/vec.h>

#include <type_traits>

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

/// A rotation by n quarter turns, of which the two lowest bits count: (x, y), (-y, x), (-x, -y) or (y, -x).
template <class F>
struct QuarterTurns {
  Mask<F> odd;
  Int<F> sign_x, sign_y;

  VNDF_INLINE explicit QuarterTurns(Int<F> n) {
    Int<F> sign(INT32_MIN), first = op::shift_left<31>(n), second = op::shift_left<30>(n);
    odd = op::from_bits(first | Int<F>(0x3f800000)) < F(0.f);
    sign_x = (first ^ second) & sign;
    sign_y = second & sign;
  }

  VNDF_INLINE F x(F x, F y) const { return op::from_bits(op::bits(op::select(odd, y, x)) ^ sign_x); }
  VNDF_INLINE F y(F x, F y) const { return op::from_bits(op::bits(op::select(odd, x, y)) ^ sign_y); }
};

/// theta = x + x_low + quarter turns, with |x| <= pi/4 and a little more. The number of turns is in the lowest bits of
/// `turns`.
template <class F>
struct ReducedAngle {
  F x, x_low, turns;
};

/// Adding and subtracting 1.5 x 2^23 rounds to integers; pi/2 is taken off in two parts, of which the first makes exact
/// products for |theta| < 10.
template <class F>
VNDF_INLINE ReducedAngle<F> reduce_angle(F theta) {
  constexpr float kRounder = 0x1.8p23f;
  F turns = theta * F(0x1.45f306p-1f) + F(kRounder);
  F n = turns - F(kRounder);
  F y = theta - n * F(0x1.921fb8p0f);
  F rest = n * F(-0x1.5dde97p-23f);
  F x = y - rest;
  return {x, (y - x) - rest, turns};
}

/// At most pi/4, and a little more: the cosine is 1 - x^2 / 2 + cos_rest, the sine x + sin_rest.
template <class F>
struct SmallAngle {
  F x, sin_rest, cos_rest;
};

/// A rotation by theta, to 0.4 eps of the direction for |theta| <= pi, exact for 0. Small alpha magnifies what the axes
/// of a shape lose.
template <class F>
struct Rotation {
  SmallAngle<F> small;
  QuarterTurns<F> turns;
};

/// By minimax polynomials.
template <class F>
VNDF_INLINE Rotation<F> rotation_of(const ReducedAngle<F>& theta) {
  F x = theta.x;
  F q = x * x;
  F q2 = q * q;
  F sine = (x * q) * (F(-0x1.55554p-3f) + q * (F(0x1.1105bcp-7f) + q * F(-0x1.98dc1cp-13f)));
  F cosine = q2 * ((F(0x1.55554ap-5f) + q * F(-0x1.6c0c1ap-10f)) + q2 * F(0x1.99e0eep-16f));
  SmallAngle<F> small = {x, theta.x_low + sine, cosine - theta.x_low * x};
  return {small, QuarterTurns<F>(op::bits(theta.turns))};
}
template <class F>
VNDF_INLINE Rotation<F> rotation_of(F theta) {
  return rotation_of(reduce_angle(theta));
}

/// With 1 - cos, to float.
template <class F>
struct Versed {
  F x, sin_rest, versine;
};
template <class F>
VNDF_INLINE Versed<F> versed(const SmallAngle<F>& a) {
  return {a.x, a.sin_rest, (a.x * a.x) * F(0.5f) - a.cos_rest};
}
template <class F>
VNDF_INLINE Angle<F> narrowed(const Versed<F>& a) {
  return {F(1.f) - a.versine, a.x + a.sin_rest};
}

/// (cos, sin)(theta) in T: a float, or a double.
template <class T, class F>
VNDF_INLINE Angle<T> angle_of(const Rotation<F>& r) {
  const auto& [small, turns] = r;
  if constexpr (std::is_same_v<T, F>) {
    auto angle = narrowed(versed(small));
    return {turns.x(angle.cos, angle.sin), turns.y(angle.cos, angle.sin)};
  } else {
    T x = op::widen(small.x), less = (x * x) * T(0.5);
    auto sum = [&](F large, F rest, F of_cos) {
      return (op::widen(large) - less * op::widen(of_cos)) + op::widen(rest);
    };
    F one(1.f), zero(0.f);
    return {sum(turns.x(one, small.x), turns.x(small.cos_rest, small.sin_rest), turns.x(one, zero)),
            sum(turns.y(one, small.x), turns.y(small.cos_rest, small.sin_rest), turns.y(one, zero))};
  }
}
template <class T, class F>
VNDF_INLINE Angle<T> angle_of(F theta) {
  return angle_of<T>(rotation_of(theta));
}

/// Rz v, Walter et al. 2015, eq. 3.
template <class F>
VNDF_INLINE Vec3<F> turn(const Vec3<F>& v, const Angle<F>& z) {
  return {z.cos * v.x - z.sin * v.y, z.sin * v.x + z.cos * v.y, v.z};
}
/// The same to 2.5 eps, and to 0.6 where the sums cancel: the large products are exact, and are taken from v itself.
template <class F>
VNDF_INLINE Vec3<F> turn(const Vec3<F>& v, const Versed<F>& z) {
  F less = z.versine;
  auto x = split(v.x), y = split(v.y), s = split(z.x);
  s.low = s.low + z.sin_rest;
  return {(v.x - s.high * y.high) - (less * v.x + (s.high * y.low + s.low * v.y)),
          (v.y + s.high * x.high) - (less * v.y - (s.high * x.low + s.low * v.x)), v.z};
}
template <class F>
VNDF_INLINE Vec3<F> turn(const Vec3<F>& v, const Rotation<F>& z) {
  return turn(Vec3<F>{z.turns.x(v.x, v.y), z.turns.y(v.x, v.y), v.z}, versed(z.small));
}
/// Rz^T v.
template <class F>
VNDF_INLINE Vec3<F> turn_back(const Vec3<F>& v, const Angle<F>& z) {
  return {z.cos * v.x + z.sin * v.y, z.cos * v.y - z.sin * v.x, v.z};
}

/// The x axis: where azimuths begin, and how a frame is turned, unless something says otherwise.
struct XAxis {};
template <class F>
VNDF_INLINE Vec3<F> turn_back(const Vec3<F>& v, XAxis) {
  return v;
}

}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
