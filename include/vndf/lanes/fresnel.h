// Indices of refraction, and Fresnel's equations.
//
// eta is the index on the other side of the surface over the one on the view's. c = wo.wm, and g = eta cos of the angle
// of refraction: g^2 = eta^2 - 1 + c^2.
#pragma once

#include <vndf/lanes/many.h>

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

/// eta, the index on the other side over the one on the view's, and eta - 1 with the digits that 1 / eta loses; and the
/// index that was given, the one below the surface over the one above.
template <class F>
struct Index {
  F eta, minus_1, given;
};
/// Views from below see the inverse.
template <class F>
VNDF_INLINE Index<F> index_seen(Mask<F> from_below, F given) {
  F inv = F(1.f) / given;
  F minus_1 = given - F(1.f);
  return {op::select(from_below, inv, given), op::select(from_below, F(0.f) - minus_1 * inv, minus_1), given};
}
template <class F>
VNDF_INLINE F squared_minus_1(const Index<F>& index) {
  return index.minus_1 * (index.eta + F(1.f));
}

/// Where eta differs from 1 by less, the surface is index-matched: light passes straight on, as a delta.
constexpr float kIndexMatched = 0x1p-16f;
template <class F>
VNDF_INLINE Mask<F> index_matched(const Index<F>& index) {
  return op::abs(index.minus_1) < F(kIndexMatched);
}
/// 0, negative numbers, infinity and NaN are not possible.
template <class F>
VNDF_INLINE Mask<F> possible(const Index<F>& index) {
  return (index.eta > F(0x1p-20f)) & (index.eta < F(0x1p20f));
}

/// Small eta, whose squares and inverses magnify what is rounded beside them.
template <class F>
VNDF_INLINE Mask<F> is_small(const Index<F>& index) {
  return index.eta < F(0.5f);
}

/// c, kept from 0, and g: 0 where reflection is total.
template <class F>
struct Cosines {
  F c, g;
};

template <class F>
VNDF_INLINE F root_of_positive(F a) {
  return op::sqrt(op::select(a > F(0.f), a, F(0.f)));
}
template <class F>
VNDF_INLINE Cosines<F> cosines(F cos, const Index<F>& index) {
  F c = cos + F(0x1p-62f);
  return {c, root_of_positive(squared_minus_1(index) + c * c)};
}

/// Fresnel's equations for unpolarised light.
template <class F>
struct Fresnel {
  F reflected, transmitted;  // shares; their sum is 1 but for rounding
  F bend;                    // c - g: wm's share in eta wi = (c - g) wm - wo
};

/// Walter et al. 2007, eq. 22. Every difference is taken of eta alone, so eta near 1 costs no digits, and neither does
/// the small one of the two shares: c - g = (1 - eta^2) / (c + g), and eta^2 c - g = (eta^2 - 1) b / (eta^2 c + g),
/// where b = (eta^2 + 1) c^2 - 1 = (eta^2 + 1) g^2 - eta^4 vanishes at Brewster's angle alone. The former loses digits
/// where eta is small, the latter where it is large.
template <class F>
VNDF_INLINE Fresnel<F> fresnel(const Cosines<F>& cos, const Index<F>& index) {
  const auto& [c, g] = cos;
  F eta2 = index.eta * index.eta;
  F more = squared_minus_1(index);
  auto denser = more > F(0.f);
  F brewster = (eta2 + F(1.f)) * op::select(denser, c * c, g * g) - op::select(denser, F(1.f), eta2 * eta2);
  auto passes = g > F(0.f);  // no total reflection
  F s = F(1.f) / (c + g);
  F p = F(1.f) / (eta2 * c + g);
  F s2 = s * s;
  F p2 = p * p;
  F rs = more * s2;
  F rp = (more * p2) * brewster;
  F cg = c * g;
  return {op::select(passes, (rs * rs + rp * rp) * F(0.5f), F(1.f)),
          op::select(passes, (cg + cg) * (s2 + eta2 * p2), F(0.f)), F(0.f) - more * s};
}

}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
