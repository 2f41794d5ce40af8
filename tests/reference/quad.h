// Quadruple precision where there is one, else long double; the functions of either, and of float and double.
#pragma once

#include <cmath>

#if VNDF_FLOAT128
// As <quadmath.h> declares them; Clang does not find that header.
extern "C" {
__float128 sqrtq(__float128) noexcept;
void sincosq(__float128, __float128*, __float128*) noexcept;
__float128 expq(__float128) noexcept;
__float128 lgammaq(__float128) noexcept;
}
#endif

namespace vndf::reference {

template <class R>
R square_root(R x) {
  return std::sqrt(x);
}
template <class R>
void sin_cos(R x, R& sin, R& cos) {
  sin = std::sin(x);
  cos = std::cos(x);
}
/// Euler's function.
template <class R>
R beta(R x, R y) {
  return std::exp(std::lgamma(x) + std::lgamma(y) - std::lgamma(x + y));
}

#if VNDF_FLOAT128
using Quad = __float128;
inline Quad square_root(Quad x) {
  return sqrtq(x);
}
inline void sin_cos(Quad x, Quad& sin, Quad& cos) {
  sincosq(x, &sin, &cos);
}
inline Quad beta(Quad x, Quad y) {
  return expq(lgammaq(x) + lgammaq(y) - lgammaq(x + y));
}
#else
using Quad = long double;
#endif

/// Pi to 128 bits, as the sum of two long doubles.
template <class R>
constexpr R kPi = R(0x1.921fb54442d1846ap+1L) + R(-0x7.6733ae8fe47c65d8p-67L);

}  // namespace vndf::reference
