// What gives a distribution its shape: the matrix A that stretches the ellipsoid to a sphere, and the three things that
// the mathematics asks of it. Plain GGX is Vec2 {alpha_x, alpha_y}: A = diag(alpha_x, alpha_y, 1). The ellipsoid NDF
// (Walter et al. 2015) has any A with |A| > 0.
//
// Neither a factor nor an orthogonal matrix on the left of A changes the distribution, so every A can be had with
// A n = n: Q A / |A n|, with Q turning A n to z. Then A n is the z axis of the hemisphere configuration, as in plain
// GGX, the cosine of Walter's lune angle is Vh.z, and everything between eq. 5 and eq. 6 of Heitz 2018 carries over.
// What is new is that Vh can be below the horizon for a view above it, and the other way round.
//
// The products A v are sums that can cancel, for views near the horizon of the leaning ellipsoid, or along the narrow
// axis of a turned one; small alpha magnifies what is lost then. Hence A is given in two parts, T = Split<F>, where it
// meets what the caller gives. The way back, A^T Nh, is as well conditioned as that of plain GGX and takes A as floats,
// T = F: a shape is `narrowed` for it.
//
// Frames: Walter's disk is Heitz's turned, (x_a, y_a) = (t2, -t1). Here it is Heitz's everywhere.
#pragma once

#include <vndf/lanes/disk.h>

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

template <class F>
struct Vec3 {
  F x, y, z;
};

template <class F>
VNDF_INLINE F dot(const Vec3<F>& a, const Vec3<F>& b) {
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}
template <class F>
VNDF_INLINE Vec3<F> cross(const Vec3<F>& a, const Vec3<F>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// A = diag(alpha_x, alpha_y, 1) Rz: GGX whose axes are turned about n.
template <class F, class T = Split<F>>
struct Turned {
  Angle<T> theta_z;
  Vec2<F> alpha;
};

/// A = ((xx, xy, 0), (yx, yy, 0), (zx, zy, 1)): any ellipsoid.
template <class F, class T = Split<F>>
struct Tilted {
  T xx, xy, yx, yy, zx, zy;
  Vec2<F> det;  // two factors of |A| as large as the two alpha
};

// Functions of a shape take Vec2 where nothing says which, so that {alpha_x, alpha_y} is a shape.

/// Whether (A v).z is v.z.
template <class Shape>
constexpr bool kUpright = true;
template <class F, class T>
constexpr bool kUpright<Tilted<F, T>> = false;

/// A with elements of type T.
template <class T, class F, class S>
VNDF_INLINE Turned<F, T> as(const Turned<F, S>& a) {
  return {{as<T>(a.theta_z.cos), as<T>(a.theta_z.sin)}, a.alpha};
}
template <class T, class F, class S>
VNDF_INLINE Tilted<F, T> as(const Tilted<F, S>& a) {
  return {as<T>(a.xx), as<T>(a.xy), as<T>(a.yx), as<T>(a.yy), as<T>(a.zx), as<T>(a.zy), a.det};
}

template <class F>
VNDF_INLINE Vec2<F> narrowed(const Vec2<F>& alpha) {
  return alpha;
}
template <class F, class T, template <class, class> class Shape>
VNDF_INLINE Shape<F, F> narrowed(const Shape<F, T>& a) {
  return as<F>(a);
}

/// Rz v, Walter et al. 2015, eq. 3.
template <class F, class T>
VNDF_INLINE Vec3<F> turn(const Vec3<F>& v, const Angle<T>& z) {
  return {difference_of_products(z.cos, v.x, z.sin, v.y), sum_of_products(z.sin, v.x, z.cos, v.y), v.z};
}

/// A v, Heitz 2018, eq. 5.
template <class F>
VNDF_INLINE Vec3<F> stretch(const Vec3<F>& v, const Vec2<F>& alpha) {
  return {alpha.x * v.x, alpha.y * v.y, v.z};
}
template <class F, class T>
VNDF_INLINE Vec3<F> stretch(const Vec3<F>& v, const Turned<F, T>& a) {
  return stretch(turn(v, a.theta_z), a.alpha);
}
template <class F, class T>
VNDF_INLINE Vec3<F> stretch(const Vec3<F>& v, const Tilted<F, T>& a) {
  return {sum_of_products(a.xx, v.x, a.xy, v.y), sum_of_products(a.yx, v.x, a.yy, v.y),
          sum_of_products(a.zx, v.x, a.zy, v.y, v.z)};
}

/// A^T v, eq. 6.
template <class F>
VNDF_INLINE Vec3<F> stretch_back(const Vec3<F>& v, const Vec2<F>& alpha) {
  return stretch(v, alpha);
}
template <class F>
VNDF_INLINE Vec3<F> stretch_back(const Vec3<F>& v, const Turned<F, F>& a) {
  Vec3<F> p = stretch(v, a.alpha);
  return {a.theta_z.cos * p.x + a.theta_z.sin * p.y, a.theta_z.cos * p.y - a.theta_z.sin * p.x, p.z};
}
template <class F>
VNDF_INLINE Vec3<F> stretch_back(const Vec3<F>& v, const Tilted<F, F>& a) {
  return {(a.xx * v.x + a.yx * v.y) + a.zx * v.z, (a.xy * v.x + a.yy * v.y) + a.zy * v.z, v.z};
}

/// Two factors of |A|.
template <class F>
VNDF_INLINE Vec2<F> factors_of_determinant(const Vec2<F>& alpha) {
  return alpha;
}
template <class F, class T>
VNDF_INLINE Vec2<F> factors_of_determinant(const Turned<F, T>& a) {
  return a.alpha;
}
template <class F, class T>
VNDF_INLINE Vec2<F> factors_of_determinant(const Tilted<F, T>& a) {
  return a.det;
}

/// a A^-T v for |A| = a b.
template <class F>
struct Unstretched {
  Vec3<F> v;
  F a, a_over_b;
};

/// The roughness that densities are evaluated with: at least 2^-60, which keeps a mirror's finite.
template <class F>
VNDF_INLINE F evaluated_alpha(F alpha) {
  constexpr float kMirror = 0x1p-60f;
  F abs = op::abs(alpha);
  return op::select(abs < F(kMirror), F(kMirror), abs);
}

template <class F>
VNDF_INLINE Unstretched<F> unstretch(const Vec3<F>& v, const Vec2<F>& alpha) {
  F alpha_x = evaluated_alpha(alpha.x);
  F ratio = alpha_x / evaluated_alpha(alpha.y);
  return {{v.x, v.y * ratio, v.z * alpha_x}, alpha_x, ratio};
}
template <class F, class T>
VNDF_INLINE Unstretched<F> unstretch(const Vec3<F>& v, const Turned<F, T>& a) {
  return unstretch(turn(v, a.theta_z), a.alpha);
}
/// A^-T v = diag(1 / a, 1 / b, 1) v', the vector of plain GGX whose alpha is (a, b).
template <class F, class T>
VNDF_INLINE Unstretched<F> unstretch(const Vec3<F>& v, const Tilted<F, T>& a) {
  using W = Wide<F>;
  auto m = as<W>(a);
  W z = as<W>(v.z), det_x = as<W>(a.det.x), det_y = as<W>(a.det.y);
  W x = as<W>(v.x) - m.zx * z, y = as<W>(v.y) - m.zy * z;
  W inv = W(1) / (det_x * det_y);
  return unstretch<F>(
      {op::narrow((m.yy * x - m.yx * y) * (inv * det_x)), op::narrow((m.xx * y - m.xy * x) * (inv * det_y)), v.z},
      a.det);
}

/// S Rz(theta_z), Walter et al. 2015, eq. 2-3 with theta_x = theta_y = 0.
template <class F>
VNDF_INLINE Turned<F> turned_shape(const Vec2<F>& alpha, F theta_z) {
  return {angle_of(theta_z), alpha};
}

/// Q A / |A n| for the columns a1, a2, a3 = A n of A.
///
/// What is left of a1 and a2 when their share of a3 is taken off is a1 x a3 and a2 x a3 turned by a quarter about a3. Q
/// turns t = a3 / |a3| to z by the shortest way, and by a half turn about x before where t is below the horizon. For
/// theta = 0 the result is A, exactly.
template <class F>
struct Reduced {
  Wide<F> xx, xy, yx, yy, zx, zy;
};
template <class F, class W = Wide<F>>
VNDF_INLINE Reduced<F> reduce(const Vec3<W>& a1, const Vec3<W>& a2, const Vec3<W>& a3) {
  W inv = W(1) / op::sqrt(dot(a3, a3));
  W inv2 = inv * inv;
  // The half turn mirrors y and z.
  W sign = op::with_sign_of(W(1), a3.z);
  Vec3<W> t = {a3.x * inv, (a3.y * sign) * inv, (a3.z * sign) * inv};
  Vec3<W> c1 = cross(a1, a3);
  Vec3<W> c2 = cross(a2, a3);
  W s = sign / (W(1) + t.z);
  W lean1 = c1.z * s;
  W lean2 = c2.z * s;
  return {(t.y * lean1 - c1.y * sign) * inv2,
          (t.y * lean2 - c2.y * sign) * inv2,
          (c1.x - t.x * lean1) * inv2,
          (c2.x - t.x * lean2) * inv2,
          dot(a1, a3) * inv2,
          dot(a2, a3) * inv2};
}
template <class F>
VNDF_INLINE Tilted<F> tilted_shape(const Reduced<F>& a, const Vec2<F>& det) {
  return {split<F>(a.xx), split<F>(a.xy), split<F>(a.yx), split<F>(a.yy), split<F>(a.zx), split<F>(a.zy), det};
}

/// S Rx(theta_x) Ry(theta_y) Rz(theta_z), eq. 2-3.
template <class F>
VNDF_INLINE Tilted<F> tilted_shape(const Vec2<F>& alpha, F theta_x, F theta_y, F theta_z) {
  using W = Wide<F>;
  auto wide = [](const Angle<Split<F>>& angle) { return Angle<W>{as<W>(angle.cos), as<W>(angle.sin)}; };
  auto x = wide(angle_of(theta_x)), y = wide(angle_of(theta_y)), z = wide(angle_of(theta_z));
  W alpha_x = op::widen(alpha.x), alpha_y = op::widen(alpha.y);
  W sc = x.sin * y.sin;
  W cs = x.cos * y.sin;
  Vec3<W> a1 = {alpha_x * (y.cos * z.cos), alpha_y * (x.cos * z.sin + sc * z.cos), x.sin * z.sin - cs * z.cos};
  Vec3<W> a2 = {W(0) - alpha_x * (y.cos * z.sin), alpha_y * (x.cos * z.cos - sc * z.sin), x.sin * z.cos + cs * z.sin};
  Vec3<W> a3 = {alpha_x * y.sin, W(0) - alpha_y * (x.sin * y.cos), x.cos * y.cos};
  F inv = op::narrow(W(1) / op::sqrt(dot(a3, a3)));
  return tilted_shape<F>(reduce<F>(a1, a2, a3), {alpha.x * inv, (alpha.y * inv) * inv});
}

}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
