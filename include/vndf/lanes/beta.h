// Euler's beta function, for the masking of refraction by height-correlated Smith.
#pragma once

#include <vndf/lanes/many.h>

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

/// 2 atanh(z) = ln((1 + z) / (1 - z)) for z from 0 to 1/3; a minimax polynomial, to 8e-9 relative.
template <class F>
VNDF_INLINE F twice_atanh(F z) {
  F q = z * z;
  F q2 = q * q;
  return z * (((F(0x1p1f) + q * F(0x1.5554ep-1f)) + q2 * (F(0x1.99dae6p-2f) + q * F(0x1.1e510cp-2f))) +
              (q2 * q2) * F(0x1.208bcap-2f));
}

/// ln(a) for a from 1 to 2^120: of the power of 2, and of a number between sqrt(1/2) and sqrt(2).
template <class F>
VNDF_INLINE F log_above_1(F a) {
  constexpr float kLn2 = 0x1.62e43p-1f, kRounder = 0x1p23f;
  Int<F> above = op::minus(op::bits(a), op::bits(F(0x1.6a09e6p-1f)));
  Int<F> power = op::shift_right<23>(above);
  F n = op::from_bits(power | op::bits(F(kRounder))) - F(kRounder);
  F m = op::from_bits(op::minus(op::bits(a), op::shift_left<23>(power)));
  F z = (m - F(1.f)) / (m + F(1.f));
  return n * F(kLn2) + twice_atanh(z);
}

/// exp(-a) for a from -1 to 80; of a larger one that of 80. A minimax polynomial, to 2e-8 relative.
template <class F>
VNDF_INLINE F exp_of_minus(F a) {
  constexpr float kRounder = 0x1.8p23f;
  a = op::select(a < F(80.f), a, F(80.f));
  F turns = a * F(0x1.715476p0f) + F(kRounder);
  F n = turns - F(kRounder);
  F r = (n * F(0x1.62e4p-1f) - a) + n * F(0x1.7f7d1cp-20f);
  F r2 = r * r;
  F low = (F(0x1p0f) + r) + r2 * (F(0x1.fffffap-2f) + r * F(0x1.5553fep-3f));
  F high = (F(0x1.5558bcp-5f) + r * F(0x1.1273ecp-7f)) + r2 * F(0x1.6ab28cp-10f);
  F p = low + (r2 * r2) * high;
  return op::from_bits(op::minus(op::bits(p), op::shift_left<23>(op::bits(turns))));
}

/// x B(x, y) for x = 1 + a, y = 1 + b, with a and b from 0 to 2^60: in (0, 1], 1 where b = 0.
///
/// With X = x + 2, Y = y + 2 and S = X + Y, which begin at 3, Stirling's formula has a short correction c:
///   B(x, y) = B(X, Y) (S - 4)(S - 3)(S - 2)(S - 1) / (x (x + 1) y (y + 1)),
///   B(X, Y) = sqrt(2 pi / Y) (X / S)^(X - 1/2) (Y / S)^Y e^(c(X) + c(Y) - c(S)).
/// Of the powers, X Y^3 / S^4 goes to the quotients: the rest is exp(-(a + 3/2) ln(S / X) - b ln(S / Y)).
///
/// Relative error at most 45 x 2^-24 for results from 0.01 (36.5 measured), and 30 x 2^-24 (1 - ln) from 1e-30 (19.9
/// measured; tests/shading/options_test.cpp). None is below 2^-118.
template <class F>
VNDF_INLINE F x_beta(F a, F b) {
  F x = a + F(3.f), y = b + F(3.f);
  F s = x + y;
  F inv_x = F(1.f) / x, inv_y = F(1.f) / y, inv_s = F(1.f) / s;
  // ln(s / larger) and ln(larger / smaller)
  auto x_larger = x > y;
  F larger = op::select(x_larger, x, y), smaller = op::select(x_larger, y, x);
  F of_larger = twice_atanh(smaller / (larger + s));
  F of_smaller = of_larger + log_above_1(larger / smaller);
  F log_x = op::select(x_larger, of_larger, of_smaller), log_y = op::select(x_larger, of_smaller, of_larger);
  auto stirling = [](F inv) {
    F q = inv * inv;
    return inv * (F(0x1.55555p-4f) + q * (F(-0x1.6ba7d2p-9f) + q * F(0x1.73e73p-11f)));
  };
  F exponent = ((a + F(1.5f)) * log_x + b * log_y) - ((stirling(inv_x) + stirling(inv_y)) - stirling(inv_s));
  F shifted = (((s - F(4.f)) * inv_s) * ((s - F(3.f)) * inv_s)) * (((s - F(2.f)) * inv_s) * ((s - F(1.f)) * inv_s));
  F rest = (x / (a + F(2.f))) * ((y * y) / ((b + F(1.f)) * (b + F(2.f))));
  return ((shifted * rest) * op::sqrt(y * F(0x1.921fb6p2f))) * exp_of_minus(exponent);
}

}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
