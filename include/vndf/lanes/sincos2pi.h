// Sine and cosine of 2 pi u.
#pragma once

#include <vndf/lanes/many.h>

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

/// A direction in the plane.
template <class F>
struct Angle {
  F cos, sin;
};

/// The distance from u to the nearer end of [0, 1]: exact for every float, which 1/2 - u is not.
template <class F>
VNDF_INLINE F from_nearer_end(F u) {
  return op::from_bits(op::min(op::bits(u), op::bits(F(1.f) - u)));
}

/// |sin(2 pi u)|, with a the distance to the nearer end: m = a (1/2 - a) vanishes exactly where the sine does; the
/// polynomial that is left has positive coefficients only, so the relative accuracy is the same everywhere, without
/// quadrants.
///
/// Minimax in relative error with the coefficients rounded to float one after the other: 1.2e-9. 4 pi is added in two
/// parts, since its rounding alone would be half an ulp. Estrin's order halves the chain of dependent operations.
template <class F>
VNDF_INLINE F abs_sin2pi(F m) {
  F m2 = m * m;
  F sin = F(12.5f) + ((F(0x1.0fdaa6p-4f) + m * F(0x1.921fb0p+5f)) +
                      m2 * ((F(0x1.1d90fcp+6f) + m * F(0x1.a2fc90p+5f)) + m2 * F(0x1.8bd6d8p+4f)));
  return m * sin;
}

/// (cos, sin)(2 pi u) for u in [0, 1]. The cosine vanishes with 1/4 - a, and (1/4 - a)^2 = 1/16 - m: 6.1e-9.
template <class F>
VNDF_INLINE Angle<F> sincos2pi(F u) {
  F a = from_nearer_end(u);
  F m = a * (F(0.5f) - a);
  F m2 = m * m;
  F cos = (F(0x1p+2f) + m * F(0x1.fffff2p+4f)) +
          m2 * ((F(0x1.10b308p+6f) + m * F(0x1.0a9dd8p+6f)) + m2 * F(0x1.3d489ep+5f));
  return {(F(0.25f) - a) * cos, op::with_sign_of(abs_sin2pi(m), F(0.5f) - u)};
}

/// Keeps the sine of a deviation above 0, so that a sum that vanishes with it keeps its direction. Far below what any
/// other sum notices.
constexpr float kTinySine = 0x1p-80f;

/// A direction in the plane by its distance from the first axis: 1 - cos and -sin, each to full relative accuracy.
template <class F>
struct Deviation {
  F versine, minus_sin;
};

/// Of 2 pi u for u in [0, 1]: 1 - cos(2 pi a) = 2 sin^2(pi a), with sin(pi a) / a to 5.6e-9.
template <class F>
VNDF_INLINE Deviation<F> deviation2pi(F u) {
  F a = from_nearer_end(u);
  F y = a * a;
  F half = a * (F(3.125f) + ((F(0x1.0fda90p-6f) + y * F(-0x1.4abbc2p+2f)) +
                             (y * y) * ((F(0x1.4668c6p+1f) + y * F(-0x1.324edap-1f)) + (y * y) * F(0x1.3dce24p-4f))));
  F sin = abs_sin2pi(a * (F(0.5f) - a)) + F(kTinySine);
  return {(half + half) * half, op::with_sign_of(sin, u - F(0.5f))};
}

}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
