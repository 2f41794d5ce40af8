#include "reference/oracle.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reference/vec.h"

namespace vndf::reference {
namespace {

using Extended = long double;
static_assert(std::numeric_limits<Extended>::digits >= 64, "the oracle needs more digits than double has");

/// The rounding error of one operation near 1.
template <class R>
constexpr R kRounding = std::numeric_limits<R>::epsilon() / 2;

#if VNDF_FLOAT128
template <>
constexpr Quad kRounding<Quad> = Quad(0x1p-113);
#endif

template <class R>
R absolute(R x) {
  return x < 0 ? -x : x;
}
template <class R>
R positive(R x) {
  return x > 0 ? x : R(0);
}
/// The error of sqrt(x) when x, at least 0, is off by d.
template <class R>
R error_of_root(R root, R d) {
  return root * root > d ? d / root : square_root(d);
}

template <class R>
struct Vec2 {
  R x, y;
};
/// Heitz 2018, eq. 9-10.
template <class R>
Vec2<R> polar(const float u[2]) {
  R r = square_root(R(u[0]));
  R sin, cos;
  sin_cos(2 * kPi<R> * R(u[1]), sin, cos);
  return {r * cos, r * sin};
}

/// Walter et al. 2015, eq. 34-37.
template <class R>
Vec2<R> concentric(const float u[2]) {
  R a = 2 * R(u[0]) - 1;
  R b = 2 * R(u[1]) - 1;
  if (a == 0 && b == 0) return {0, 0};
  R sin, cos;
  if (absolute(a) > absolute(b)) {
    sin_cos(kPi<R> * b / (4 * a), sin, cos);
    return {a * cos, a * sin};
  }
  sin_cos(kPi<R> * a / (4 * b), sin, cos);
  return {b * sin, b * cos};
}

/// Heitz 2018, eq. 5.
template <class R>
Vec3<R> hemisphere_view(const float wo[3], const float alpha[2]) {
  Vec3<R> h{R(alpha[0]) * R(wo[0]), R(alpha[1]) * R(wo[1]), R(wo[2])};
  R norm = length(h);
  return {h.x / norm, h.y / norm, h.z / norm};
}

/// Heitz 2018, eq. 6, for an Nh whose error is `horizontal` in the plane and `vertical` along z.
template <class R>
OracleNormal ellipsoid_normal(const Vec3<R>& nh, const float alpha[2], R horizontal, R vertical) {
  Vec3<R> ne{R(alpha[0]) * nh.x, R(alpha[1]) * nh.y, positive(nh.z)};
  R norm = length(ne);
  R off = absolute(R(std::max(std::fabs(alpha[0]), std::fabs(alpha[1])))) * horizontal + vertical;
  return {double(ne.x / norm), double(ne.y / norm), double(ne.z / norm), double(off / norm + 4 * kRounding<R>)};
}

/// Listing 1 from Section 4.1 on. The errors of its steps are carried along to first order, in units of the rounding.
template <class R>
OracleNormal listing_1(const float wo[3], const float alpha[2], const Vec2<R>& t) {
  constexpr R q = kRounding<R>;
  // Section 3.2
  Vec3<R> vh = hemisphere_view<R>(wo, alpha);
  // Section 4.1
  R lensq = vh.x * vh.x + vh.y * vh.y;
  R rho = square_root(lensq);
  Vec3<R> t1_axis = lensq > 0 ? Vec3<R>{-vh.y / rho, vh.x / rho, 0} : Vec3<R>{0, 1, 0};
  Vec3<R> t2_axis = cross(vh, t1_axis);
  // Section 4.2
  R s = (1 + vh.z) / 2;
  R w = square_root(positive(1 - t.x * t.x));
  R t2 = (1 - s) * w + s * t.y;
  R off_t2 = (1 - s) * error_of_root(w, 16 * q) + 16 * q;
  // Section 4.3
  R v = square_root(positive(1 - t.x * t.x - t2 * t2));
  R off_v = error_of_root(v, 16 * q + 2 * absolute(t2) * off_t2);
  Vec3<R> nh{t.x * t1_axis.x + t2 * t2_axis.x + v * vh.x, t.x * t1_axis.y + t2 * t2_axis.y + v * vh.y,
             t2 * t2_axis.z + v * vh.z};
  // Section 3.4
  R vertical = rho * (off_t2 + 4 * q * absolute(t2)) + absolute(vh.z) * (off_v + 4 * q * v);
  return ellipsoid_normal(nh, alpha, off_t2 + rho * off_v + 16 * q, vertical);
}

/// Dupuy and Benyoub 2023, Listing 3, with azimuths counted from the one opposite to the view's.
template <class R>
OracleNormal spherical_cap(const float wo[3], const float alpha[2], const float u[2]) {
  constexpr R q = kRounding<R>;
  Vec3<R> vh = hemisphere_view<R>(wo, alpha);
  R rho = square_root(vh.x * vh.x + vh.y * vh.y);
  Vec2<R> away = rho > 0 ? Vec2<R>{-vh.x / rho, -vh.y / rho} : Vec2<R>{-1, 0};
  R sin_phi, cos_phi;
  sin_cos(2 * kPi<R> * R(u[0]), sin_phi, cos_phi);
  R z = (1 - R(u[1])) * (1 + vh.z) - vh.z;
  R sin_theta = square_root(positive(1 - z * z));
  Vec3<R> c{sin_theta * (cos_phi * away.x - sin_phi * away.y), sin_theta * (cos_phi * away.y + sin_phi * away.x), z};
  Vec3<R> nh{c.x + vh.x, c.y + vh.y, c.z + vh.z};
  R horizontal = error_of_root(sin_theta, 16 * q) + 16 * q * (sin_theta + rho);
  return ellipsoid_normal(nh, alpha, horizontal, 8 * q);
}

template <class R>
OracleNormal evaluate(Warp warp, const float wo[3], const float alpha[2], const float u[2]) {
  switch (warp) {
    case Warp::polar:
      return listing_1(wo, alpha, polar<R>(u));
    case Warp::concentric:
      return listing_1(wo, alpha, concentric<R>(u));
    default:
      return spherical_cap<R>(wo, alpha, u);
  }
}

}  // namespace

OracleNormal oracle_normal_long_double(Warp warp, const float wo[3], const float alpha[2], const float u[2]) {
  return evaluate<Extended>(warp, wo, alpha, u);
}

OracleNormal oracle_normal_quad(Warp warp, const float wo[3], const float alpha[2], const float u[2]) {
  return evaluate<Quad>(warp, wo, alpha, u);
}

OracleNormal oracle_normal(Warp warp, const float wo[3], const float alpha[2], const float u[2]) {
  // A 256th of the rounding error of a float, and less for small alpha, where the error of the slope is looked at.
  double enough = 0x1p-32 * std::min(1., 1024. * std::min(std::fabs(alpha[0]), std::fabs(alpha[1])));
  OracleNormal normal = oracle_normal_long_double(warp, wo, alpha, u);
  return normal.uncertainty <= enough ? normal : oracle_normal_quad(warp, wo, alpha, u);
}

Conditioning conditioning(Warp warp, const float wo[3], const float alpha[2], const float u[2]) {
  float inputs[7] = {wo[0], wo[1], wo[2], alpha[0], alpha[1], u[0], u[1]};
  OracleNormal exact = oracle_normal(warp, wo, alpha, u);
  Conditioning result{};
  for (int i = 0; i < 7; ++i) {
    float kept = inputs[i];
    double moved = 0;
    for (float towards : {-HUGE_VALF, HUGE_VALF}) {
      inputs[i] = std::nextafter(kept, towards);
      OracleNormal other = oracle_normal(warp, inputs, inputs + 3, inputs + 5);
      moved = std::max(moved, std::hypot(other.x - exact.x, other.y - exact.y, other.z - exact.z) / 2);
    }
    inputs[i] = kept;
    (i < 5 ? result.view : result.u) += moved;
  }
  return result;
}

OracleNormals oracle_normals(Warp warp, const Inputs& in) {
  OracleNormals out;
  out.x.resize(in.size());
  out.y.resize(in.size());
  out.z.resize(in.size());
  for (std::size_t i = 0; i < in.size(); ++i) {
    const float wo[3] = {in.wo_x[i], in.wo_y[i], in.wo_z[i]};
    const float alpha[2] = {in.alpha_x[i], in.alpha_y[i]};
    const float u[2] = {in.u_x[i], in.u_y[i]};
    OracleNormal normal = oracle_normal(warp, wo, alpha, u);
    out.x[i] = normal.x;
    out.y[i] = normal.y;
    out.z[i] = normal.z;
    out.uncertainty = std::max(out.uncertainty, normal.uncertainty);
  }
  return out;
}

OracleDisk oracle_disk(DiskMap map, const float u[2]) {
  Vec2<Extended> t = map == DiskMap::polar ? polar<Extended>(u) : concentric<Extended>(u);
  Extended r2 = t.x * t.x + t.y * t.y;
  return {double(t.x), double(t.y), double(square_root(r2)), double(1 - r2)};
}

}  // namespace vndf::reference
