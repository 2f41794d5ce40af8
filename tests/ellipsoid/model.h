// The ellipsoid NDF in the plain formulas of Walter et al. 2015, with the matrix A itself and in any arithmetic: on
// purpose not in the form that the library derives from them.
#pragma once

#include <cmath>
#include <string>

#include <vndf/ellipsoid.h>

#include "shading/inputs.h"

namespace vndf::ellipsoid {

using namespace shading;
using reference::Quad;
using reference::sin_cos;
using reference::square_root;

/// A matrix by its columns.
template <class R>
struct M3 {
  Vec3<R> c1, c2, c3;
};
template <class R>
Vec3<R> operator*(const M3<R>& m, const Vec3<R>& v) {
  return v.x * m.c1 + v.y * m.c2 + v.z * m.c3;
}
template <class R>
M3<R> operator*(const M3<R>& a, const M3<R>& b) {
  return {a * b.c1, a * b.c2, a * b.c3};
}
template <class R>
Vec3<R> transposed_times(const M3<R>& m, const Vec3<R>& v) {
  return {dot(m.c1, v), dot(m.c2, v), dot(m.c3, v)};
}
template <class R>
R determinant(const M3<R>& m) {
  return dot(m.c1, cross(m.c2, m.c3));
}
/// A^-T v: its columns are the cross products of those of A, over |A|.
template <class R>
Vec3<R> inverse_transposed_times(const M3<R>& m, const Vec3<R>& v) {
  M3<R> cofactors{cross(m.c2, m.c3), cross(m.c3, m.c1), cross(m.c1, m.c2)};
  return (1 / determinant(m)) * (cofactors * v);
}

/// The five parameters, as floats.
struct Parameters {
  float alpha_x, alpha_y, theta_x, theta_y, theta_z;

  Ellipsoid ellipsoid() const { return {{alpha_x, alpha_y}, theta_x, theta_y, theta_z}; }
};

/// Eq. 3.
template <class R>
M3<R> rotation(R theta_x, R theta_y, R theta_z) {
  R s, c;
  sin_cos(theta_x, s, c);
  M3<R> x{{1, 0, 0}, {0, c, s}, {0, -s, c}};
  sin_cos(theta_y, s, c);
  M3<R> y{{c, 0, -s}, {0, 1, 0}, {s, 0, c}};
  sin_cos(theta_z, s, c);
  M3<R> z{{c, s, 0}, {-s, c, 0}, {0, 0, 1}};
  return x * (y * z);
}
/// Eq. 2.
template <class R>
M3<R> matrix(const Parameters& p) {
  M3<R> s{{R(p.alpha_x), 0, 0}, {0, R(p.alpha_y), 0}, {0, 0, 1}};
  return s * rotation<R>(R(p.theta_x), R(p.theta_y), R(p.theta_z));
}

/// Eq. 1.
template <class R>
R ndf(const Vec3<R>& m, const M3<R>& a) {
  Vec3<R> k = inverse_transposed_times(a, m);
  R k2 = dot(k, k);
  return m.z >= 0 ? 1 / (kPi<R> * determinant(a) * square_root(dot(a.c3, a.c3)) * k2 * k2) : R(0);
}
/// Eq. 26 and 28 for C_e = 1.
template <class R>
R ellipsoid_area(const Vec3<R>& u, const M3<R>& a) {
  Vec3<R> h = a * u;
  return kPi<R> * square_root(dot(h, h)) / determinant(a);
}
template <class R>
R lune_area(const Vec3<R>& u, const M3<R>& a) {
  Vec3<R> h = a * u, n = a.c3;
  R lengths = square_root(dot(h, h)) * square_root(dot(n, n));
  return kPi<R> * (lengths + dot(h, n)) / (2 * determinant(a) * square_root(dot(n, n)));
}
/// Eq. 6.
template <class R>
R g1(const Vec3<R>& u, const M3<R>& a) {
  Vec3<R> h = a * u, n = a.c3;
  R nn = dot(n, n);
  R g = 2 * nn * (u.z < 0 ? -u.z : u.z) / (square_root(dot(h, h)) * square_root(nn) + dot(h, n));
  return g < 1 ? g : R(1);
}
/// Eq. 33.
template <class R>
R normal_pdf(const Vec3<R>& psi, const Vec3<R>& m, const M3<R>& a) {
  R cos = dot(psi, m);
  return cos > 0 ? ellipsoid_area(Vec3<R>{0, 0, 1}, a) / lune_area(psi, a) * ndf(m, a) * cos : R(0);
}

/// A point of the unit disk in Heitz's frame: his eq. 9-10, or eq. 34-37.
template <class R>
struct Point {
  R t1, t2;
};
template <class R>
Point<R> disk_point(Warp warp, R u1, R u2) {
  R s, c;
  if (warp == Warp::polar) {
    R r = square_root(u1);
    sin_cos(2 * kPi<R> * u2, s, c);
    return {r * c, r * s};
  }
  R a = 2 * u1 - 1, b = 2 * u2 - 1;
  if (a == 0 && b == 0) return {0, 0};
  if (a * a > b * b) {
    sin_cos(kPi<R> * b / (4 * a), s, c);
    return {a * c, a * s};
  }
  sin_cos(kPi<R> * a / (4 * b), s, c);
  return {b * s, b * c};
}

/// Version 3, eq. 38-46; Walter's (x_a, y_a) is Heitz's (t2, -t1).
template <class R>
Vec3<R> sample_version_3(const Vec3<R>& psi, const M3<R>& a, const Point<R>& t) {
  Vec3<R> h = a * psi, n = a.c3;
  Vec3<R> e3 = unit(h);
  R s = (1 + dot(e3, unit(n))) / 2;
  R x_a = t.t2, y_a = -t.t1;
  auto root = [](R x) { return square_root(x > 0 ? x : R(0)); };
  R x_b = s * x_a + (1 - s) * root(1 - y_a * y_a);
  R z_b = root(1 - x_b * x_b - y_a * y_a);
  Vec3<R> e2 = unit(cross(h, n));
  Vec3<R> e1 = cross(e2, e3);
  return unit(transposed_times(a, x_b * e1 + y_a * e2 + z_b * e3));
}

/// Q A / |A n|: the x axis is the normal of A y and A n.
template <class R>
M3<R> upright(const M3<R>& a) {
  Vec3<R> x = unit(cross(a.c2, a.c3)), z = unit(a.c3);
  M3<R> axes{x, cross(z, x), z};
  R inv = 1 / square_root(dot(a.c3, a.c3));
  return {inv * transposed_times(axes, a.c1), inv * transposed_times(axes, a.c2), {0, 0, 1}};
}
/// Dupuy and Benyoub 2023, Listing 3, with A in place of diag(alpha_x, alpha_y, 1) and azimuths about A n counted from
/// the one opposite to the view's, which is not along n.
template <class R>
Vec3<R> sample_cap(const Vec3<R>& psi, const M3<R>& a, R u1, R u2) {
  M3<R> b = upright(a);
  Vec3<R> vh = unit(b * psi);
  Vec3<R> away = unit(Vec3<R>{-vh.x, -vh.y, 0}), z_axis{0, 0, 1};
  R s, c;
  sin_cos(2 * kPi<R> * u1, s, c);
  R z = (1 - u2) * (1 + vh.z) - vh.z;
  R sin_theta = square_root(1 - z * z > 0 ? 1 - z * z : R(0));
  return unit(transposed_times(b, sin_theta * (c * away + s * cross(z_axis, away)) + z * z_axis + vh));
}

}  // namespace vndf::ellipsoid
