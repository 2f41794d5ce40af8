// Sine and cosine of 2 pi u.
#pragma once

#include <vndf/lanes/split.h>

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

/// A direction in the plane.
template <class F>
struct Angle {
  F cos, sin;
};

/// (-cos, sin)(2 pi a) for a in [0, 1/2], the sine with its sign bit clear.
///
/// m = a (1/2 - a) vanishes exactly where the sine does and a - 1/4 where the cosine does, and (a - 1/4)^2 = 1/16 - m:
/// each is its zero times a polynomial in m whose coefficients are all positive. That keeps the relative accuracy
/// everywhere, without quadrants.
template <class F>
VNDF_INLINE Angle<F> minus_cos_and_sin(F a) {
  F m = a * (F(0.5f) - a);
  F m2 = m * m;
  // Minimax in relative error with the coefficients rounded to float one after the other: 6.1e-9 and 1.2e-9. 4 pi is
  // added in two parts, since its rounding alone would be half an ulp. Estrin's order halves the chain of dependent
  // operations, which is what bounds the kernels.
  F cos = (F(0x1p+2f) + m * F(0x1.fffff2p+4f)) +
          m2 * ((F(0x1.10b308p+6f) + m * F(0x1.0a9dd8p+6f)) + m2 * F(0x1.3d489ep+5f));
  F sin = F(12.5f) + ((F(0x1.0fdaa6p-4f) + m * F(0x1.921fb0p+5f)) +
                      m2 * ((F(0x1.1d90fcp+6f) + m * F(0x1.a2fc90p+5f)) + m2 * F(0x1.8bd6d8p+4f)));
  return {(a - F(0.25f)) * cos, m * sin};
}

/// (cos, sin)(2 pi u) for u in [0, 1]: a half turn on, with a = |1/2 - u|, which is exact for every multiple of 2^-25.
template <class F>
VNDF_INLINE Angle<F> sincos2pi(F u) {
  F h = F(0.5f) - u;
  auto turned = minus_cos_and_sin(op::abs(h));
  return {turned.cos, op::with_sign_of(turned.sin, h)};
}

/// (cos, sin)(theta), theta in radians, to 0.4 eps for |theta| <= pi, and (1, 0) at 0: what a shape's axes lose, small
/// alpha magnifies.
///
/// Whole quarter turns are taken off with pi/2 in two parts, of which the first makes exact products; adding and
/// subtracting 1.5 x 2^23 rounds to integers. What is left is x + x_low, at most pi/4. Of its cosine 1 - x^2 / 2 is
/// taken with its rounding error; what follows is minimax, as is the sine.
template <class F>
VNDF_INLINE Angle<Split<F>> angle_of(F theta) {
  constexpr float kRounder = 0x1.8p23f;
  F shifted = theta * F(0x1.45f306p-1f) + F(kRounder);
  F quarters = shifted - F(kRounder);
  F y = theta - quarters * F(0x1.92p0f);
  F rest = quarters * F(0x1.fb5444p-12f);
  F x = y - rest;
  F x_low = (y - x) - rest;

  F q = x * x;
  F half = q * F(0.5f);
  F one = F(1.f) - half;
  F error = ((F(1.f) - one) - half) - x * x_low;
  auto c = split(one);
  c.low = c.low + (error + (q * q) * (F(0x1.55554ap-5f) + q * (F(-0x1.6c0c1ap-10f) + q * F(0x1.99e0eep-16f))));
  F xq = x * q;
  auto s = split(x);
  s.low = (s.low + x_low * one) + (xq * F(-0x1.55554p-3f) + (xq * q) * (F(0x1.1105bcp-7f) + q * F(-0x1.98dc1cp-13f)));

  Int<F> n = op::bits(shifted);
  Int<F> first = op::shift_left<31>(n), second = op::shift_left<30>(n);
  auto odd = op::from_bits(first | Int<F>(0x3f800000)) < F(0.f);
  Int<F> cos_sign = (first ^ second) & Int<F>(INT32_MIN), sin_sign = second & Int<F>(INT32_MIN);
  auto of_quarter = [&](Int<F> sign, F even, F other) {
    return op::from_bits(op::bits(op::select(odd, other, even)) ^ sign);
  };
  return {{of_quarter(cos_sign, c.high, s.high), of_quarter(cos_sign, c.low, s.low)},
          {of_quarter(sin_sign, s.high, c.high), of_quarter(sin_sign, s.low, c.low)}};
}

}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
