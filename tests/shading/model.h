// The microfacet model in the papers' plain formulas, in any arithmetic: what the library's results are compared with.
// On purpose not in the forms that the library derives.
#pragma once

#include <cmath>

#include "reference/vec.h"

namespace vndf::shading {

using reference::cross;
using reference::distance;
using reference::dot;
using reference::kPi;
using reference::length;
using reference::unit;
using reference::Vec3;

template <class R>
struct Alpha {
  R x, y;
};

/// A v and A^-1 v.
template <class R>
Vec3<R> stretch(const Vec3<R>& v, const Alpha<R>& alpha) {
  return {alpha.x * v.x, alpha.y * v.y, v.z};
}
template <class R>
Vec3<R> unstretch(const Vec3<R>& v, const Alpha<R>& alpha) {
  return {v.x / alpha.x, v.y / alpha.y, v.z};
}

/// Heitz 2018, eq. 1.
template <class R>
R ndf(const Vec3<R>& m, const Alpha<R>& alpha) {
  R k = m.x * m.x / (alpha.x * alpha.x) + m.y * m.y / (alpha.y * alpha.y) + m.z * m.z;
  return 1 / (kPi<R> * alpha.x * alpha.y * k * k);
}
/// Eq. 2.
template <class R>
R lambda(const Vec3<R>& v, const Alpha<R>& alpha) {
  R t = (alpha.x * alpha.x * v.x * v.x + alpha.y * alpha.y * v.y * v.y) / (v.z * v.z);
  return (-1 + std::sqrt(1 + t)) / 2;
}
template <class R>
R g1(const Vec3<R>& v, const Alpha<R>& alpha) {
  return v.z > 0 ? 1 / (1 + lambda(v, alpha)) : R(0);
}
template <class R>
R g2(const Vec3<R>& v, const Vec3<R>& l, const Alpha<R>& alpha, bool separable) {
  if (separable) return g1(v, alpha) * g1(l, alpha);
  return v.z > 0 && l.z > 0 ? 1 / (1 + lambda(v, alpha) + lambda(l, alpha)) : R(0);
}
/// Eq. 3, views above the horizon.
template <class R>
R visible_normal_pdf(const Vec3<R>& v, const Vec3<R>& m, const Alpha<R>& alpha) {
  R cos = dot(v, m);
  return cos > 0 ? g1(v, alpha) * cos * ndf(m, alpha) / v.z : R(0);
}
template <class R>
Vec3<R> reflect(const Vec3<R>& v, const Vec3<R>& m) {
  return 2 * dot(v, m) * m + R(-1) * v;
}

/// Eto and Tokuyoshi 2023: the share of the visible area that bounded sampling keeps, (1 + k Vh.z) / (1 + Vh.z).
template <class R>
R bounded_share(const Vec3<R>& v, const Alpha<R>& alpha) {
  R a = std::fmin(R(1), std::fmin(alpha.x, alpha.y));
  R s = 1 + std::sqrt(v.x * v.x + v.y * v.y);
  R k = (1 - a * a) * s * s / (s * s + a * a * v.z * v.z);
  R z = unit(stretch(v, alpha)).z;
  return (1 + k * z) / (1 + z);
}
/// Eq. 17, by 4 (v.m), and 18.
template <class R>
R reflection_pdf(const Vec3<R>& v, const Vec3<R>& m, const Alpha<R>& alpha) {
  return visible_normal_pdf(v, m, alpha) / (4 * dot(v, m));
}
template <class R>
R brdf_cos(const Vec3<R>& v, const Vec3<R>& l, const Alpha<R>& alpha, bool separable) {
  return ndf(unit(v + l), alpha) * g2(v, l, alpha, separable) / (4 * v.z);
}

/// Fresnel's reflectance for unpolarised light, by the angles.
template <class R>
R fresnel(R cos, R eta) {
  R sin2 = (1 - cos * cos) / (eta * eta);
  if (sin2 >= 1) return 1;
  R cos_t = std::sqrt(1 - sin2);
  R s = (cos - eta * cos_t) / (cos + eta * cos_t), p = (eta * cos - cos_t) / (eta * cos + cos_t);
  return (s * s + p * p) / 2;
}

}  // namespace vndf::shading
