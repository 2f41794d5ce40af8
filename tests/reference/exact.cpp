#include "reference/exact.h"

namespace vndf::exact {
namespace {

using reference::sin_cos;
using reference::square_root;
constexpr Quad kPi = reference::kPi<Quad>;
/// Both components of (A wo).xy below this: the azimuth is that of the x axis.
constexpr Quad kNoAzimuth = Quad(0x1p-110);
/// Where c + Vh is no longer than this, c is -Vh and every normal is right.
constexpr Quad kNoSum = Quad(0x1p-30);
/// No function gives a larger density.
constexpr Quad kLargestPdf = Quad(0x1p60);

Quad absolute(Quad x) {
  return x < 0 ? -x : x;
}
Quad smaller(Quad x, Quad y) {
  return x < y ? x : y;
}
Quad root(Quad x) {
  return x > 0 ? square_root(x) : Quad(0);
}

Vec mirrored(bool below, const Vec& v) {
  return below ? Quad(-1) * v : v;
}

Vec times(const Surface& a, const Vec& v) {
  return {dot(a.row[0], v), dot(a.row[1], v), dot(a.row[2], v)};
}
Vec transposed_times(const Surface& a, const Vec& v) {
  return v.x * a.row[0] + v.y * a.row[1] + v.z * a.row[2];
}
/// A^-T v.
Vec inverse_transposed_times(const Surface& a, const Vec& v) {
  return (1 / a.determinant) *
         Vec{dot(cross(a.row[1], a.row[2]), v), dot(cross(a.row[2], a.row[0]), v), dot(cross(a.row[0], a.row[1]), v)};
}

/// A vector of the hemisphere configuration by its azimuth and its height.
struct View {
  Quad x, y;  // unit: the azimuth
  Quad rho, z;
  Quad one_plus_z, one_minus_z;  // the small one as rho^2 over the other
};
View view_of(const Vec& h) {
  Quad rho = root(h.x * h.x + h.y * h.y), norm = length(h);
  bool none = absolute(h.x) < kNoAzimuth && absolute(h.y) < kNoAzimuth;
  View v{none ? Quad(1) : h.x / rho, none ? Quad(0) : h.y / rho, rho / norm, h.z / norm, 0, 0};
  v.one_plus_z = 1 + v.z;
  v.one_minus_z = 1 - v.z;
  if (v.z < 0) v.one_plus_z = v.rho * v.rho / v.one_minus_z;
  if (v.z > 0) v.one_minus_z = v.rho * v.rho / v.one_plus_z;
  return v;
}

/// A point of the disk, with e = 1 - t1^2 - t2^2 and its azimuth.
struct Point {
  Quad t1, t2, r2, e;
  Quad sin, cos;
};
/// u is taken to [-1/2, 1/2], where the sine of what is nearly a whole turn has its digits.
void sin_cos_of_turn(Quad u, Quad& sin, Quad& cos) {
  sin_cos(2 * kPi * (u > Quad(0.5) ? u - 1 : u), sin, cos);
}
/// Heitz 2018, eq. 9-10.
Point polar(Quad u1, Quad u2) {
  Point t{};
  sin_cos_of_turn(u2, t.sin, t.cos);
  Quad r = square_root(u1);
  return {r * t.cos, r * t.sin, u1, 1 - u1, t.sin, t.cos};
}
/// Walter et al. 2015, eq. 34-37.
Point concentric(Quad u1, Quad u2) {
  Quad a = 2 * u1 - 1, b = 2 * u2 - 1;
  if (a == 0 && b == 0) return {0, 0, 0, 1, 0, 1};
  bool wide = absolute(a) > absolute(b);
  Quad r = wide ? a : b, sin, cos;
  sin_cos(wide ? kPi * b / (4 * a) : kPi / 2 - kPi * a / (4 * b), sin, cos);
  Quad sign = r < 0 ? -1 : 1;
  return {r * cos, r * sin, r * r, (1 - r) * (1 + r), sign * sin, sign * cos};
}
Point disk_point(Warp warp, Quad u1, Quad u2) {
  return warp == Warp::polar ? polar(u1, u2) : concentric(u1, u2);
}

/// Heitz 2018, Listing 1 from section 4.1 on.
Vec normal_on_disk(const View& view, const Point& t) {
  Vec vh{view.rho * view.x, view.rho * view.y, view.z};
  Vec t1_axis{-view.y, view.x, 0};
  Vec t2_axis{-view.z * view.x, -view.z * view.y, view.rho};
  // w is sqrt(1 - t1^2), and w - t2 and, with s = (1 + z) / 2, w - t2' = s (w - t2) are what is small at the rim.
  Quad s = view.one_plus_z / 2, w = square_root(t.e + t.t2 * t.t2);
  Quad t2 = view.one_minus_z / 2 * w + s * t.t2;
  Quad gap = t.t2 > 0 ? t.e / (w + t.t2) : w - t.t2;
  Quad v = root(s * gap * (w + t2));
  return t.t1 * t1_axis + t2 * t2_axis + v * vh;
}

/// Dupuy and Benyoub 2023, Listing 3, c + Vh for the cap c.z >= -k Vh.z. Azimuths of c begin opposite the view.
///
/// In the axes of that azimuth. With d the height of c over the rim the components are sin_c cos(phi) - sin_v and
/// sin_c sin(phi), where sin_c - sin_v = (Vh.z^2 - c.z^2) / (sin_c + sin_v) and cos(phi) = 1 - (1 - cos(phi)).
Vec normal_on_cap(const View& view, Quad k, Quad r2, Quad e, Quad sin, Quad cos) {
  Quad one_plus_kz = k == 1 ? view.one_plus_z : 1 + k * view.z;
  Quad one_minus_kz = k == 1 ? view.one_minus_z : 1 - k * view.z;
  Quad d = e * one_plus_kz;
  Quad sin_c = square_root(r2 * one_plus_kz * (one_minus_kz + d));
  Quad z = d + (1 - k) * view.z;
  Quad sum = sin_c + view.rho;
  Quad less = sum > 0 ? ((1 + k) * view.z - d) * z / sum : Quad(0);
  Quad versine = cos > 0 ? sin * sin / (1 + cos) : 1 - cos;
  Quad along = less - sin_c * versine, across = sin_c * sin;
  return {-view.x * along + view.y * across, -view.y * along - view.x * across, z};
}

/// A surface as it is seen from wo.
struct Seen {
  View view;
  Quad length;  ///< |A wo|
  Quad area;    ///< |A wo| + (A wo).z: Walter et al. 2015, eq. 28; for plain GGX 2 wo.z / G1(wo), Heitz 2018, eq. 2
  Quad k;       ///< the bound of Eto and Tokuyoshi 2023, eq. 5, or 1
  Quad kept;    ///< what is kept of the area if k is not 1
};
Quad bound(const Vec& wo, const Surface& surface) {
  Quad a = smaller(1, surface.smaller_alpha), s = 1 + root(wo.x * wo.x + wo.y * wo.y);
  return (1 - a * a) * s * s / (s * s + a * a * wo.z * wo.z);
}
Seen seen(bool bounded, const Vec& wo, const Surface& surface) {
  Vec h = times(surface, wo);
  Seen s{view_of(h), length(h), 0, 1, 1};
  s.area = s.length * s.view.one_plus_z;
  if (bounded) {
    s.k = bound(wo, surface);
    s.kept = (1 + s.k * s.view.z) / s.view.one_plus_z;
  }
  return s;
}

/// A normal by Nh, and D, Walter et al. 2015, eq. 1, for plain GGX Heitz 2018, eq. 1: A^-T wm = Nh / |A^T Nh|.
struct Facet {
  Normal normal;
  Quad ndf;
  Quad length;  ///< |A^T Nh| of a unit Nh
};
Quad ndf(Quad k2, const Surface& surface) {
  return 1 / (kPi * surface.determinant * k2 * k2);
}
Facet facet_of(Vec nh, const Vec& wo, const Surface& surface) {
  if (nh.z < 0) nh.z = 0;
  Vec p = transposed_times(surface, nh);
  Quad nh2 = dot(nh, nh), p2 = dot(p, p);
  if (!(nh2 > kNoSum * kNoSum)) return {{{0, 0, 1}, wo.z, false}, 0, 1};
  Vec wm = (1 / square_root(p2)) * p;
  return {{wm, dot(wo, wm), true}, ndf(nh2 / p2, surface), square_root(p2 / nh2)};
}
Facet sample(Warp warp, const Seen& from, const Vec& wo, const Surface& surface, Quad u1, Quad u2) {
  if (!(from.view.one_plus_z > 0)) return {{{0, 0, 1}, wo.z, false}, 0, 1};
  if (warp == Warp::spherical_cap) {
    Quad sin, cos;
    sin_cos_of_turn(u1, sin, cos);
    return facet_of(normal_on_cap(from.view, from.k, u2, 1 - u2, sin, cos), wo, surface);
  }
  Point t = disk_point(warp, u1, u2);
  Vec nh = from.k == 1 ? normal_on_disk(from.view, t) : normal_on_cap(from.view, from.k, t.r2, t.e, t.sin, t.cos);
  return facet_of(nh, wo, surface);
}
/// D of the direction of m.
Quad ndf(const Vec& m, const Surface& surface) {
  Vec k = inverse_transposed_times(surface, m);
  return ndf(dot(k, k) / dot(m, m), surface);
}

/// Heitz 2018, eq. 2, for either side of the surface.
Quad lambda(const Vec& v, const Surface& surface) {
  Vec h = times(surface, v);
  return (square_root(1 + (h.x * h.x + h.y * h.y) / (v.z * v.z)) - 1) / 2;
}
/// G2(wo, wi) / G1(wo), Heitz 2018, eq. 19, with both multiplied by wo.z (1 + Lambda(wo)), which horizontal views have
/// too; or Walter et al. 2015, eq. 50. Below the surface it goes on to negative values.
Masked weight(const Seen& from, const Vec& wo, const Vec& wi, const Surface& surface) {
  if (wi.z == 0) return {0, 0};
  Quad half = from.area / 2, sign = wi.z < 0 ? -1 : 1;
  if (surface.by_lunes) {
    Quad i = 2 * absolute(wi.z), w = half < wo.z ? half / wo.z : Quad(1);
    w = sign * w * smaller(1, i / seen(false, wi, surface).area);
    return {w, w};
  }
  Quad at_wi = lambda(wi, surface);
  return {sign * smaller(1, from.kept * half / (half + wo.z * at_wi)), sign * smaller(1, from.kept / (1 + at_wi))};
}
/// Across the surface G1(wi), Walter et al. 2007, eq. 23, or Walter et al. 2015, eq. 7; or what reflection has; or
/// Heitz et al. 2016. Radiance has the square of the index, which is eta from the side of the view.
Masked dielectric_weight(bool reflects, const Seen& from, const Vec& wo, const Vec& wi, const Surface& surface,
                         Quad eta, const Lobes& lobes) {
  if (reflects) return weight(from, wo, wi, surface);
  Masked w = weight(from, wo, mirrored(true, wi), surface);
  Quad across = lobes.across == AcrossMasking::as_reflection ? w.correlated : w.separable;
  if (lobes.across == AcrossMasking::height_correlated) {
    Quad x = 1 + lambda(wo, surface), y = 1 + lambda(wi, surface);
    across = wi.z < 0 ? x * reference::beta(x, y) : -x * reference::beta(x, y);
  }
  if (lobes.radiance) across /= eta * eta;
  return {across, across};
}
/// Heitz 2018, eq. 3 and 17.
Quad normal_pdf(Quad ndf, Quad cos, const Seen& from) {
  return cos > 0 ? 2 * cos * ndf / from.area : Quad(0);
}
Quad reflection_pdf(Quad ndf, const Seen& from) {
  return ndf / (2 * from.area * from.kept);
}
Quad capped(Quad pdf) {
  return smaller(pdf, kLargestPdf);
}
Evaluation evaluation(Quad pdf, const Masked& weight) {
  pdf = capped(pdf);
  return {pdf, {pdf * weight.correlated, pdf * weight.separable}};
}

/// What `more` of wi.z does to a weight at this side.
template <class WeightOf>
Masked slack(WeightOf weight_of, const Vec& wi, Quad more, const Masked& weight) {
  Masked moved = weight_of({wi.x, wi.y, wi.z + more});
  return {absolute(moved.correlated - weight.correlated), absolute(moved.separable - weight.separable)};
}
constexpr Quad kNextToHorizontal = Quad(0x1p-42), kHalfAUnit = Quad(0x1p-25);
constexpr Quad kNextToTheRim = Quad(0x1p-46), kNextToNoCosine = Quad(0x1p-62);

/// Both shares, by the cosines of either side; cos_t = 0 where reflection is total.
struct Fresnel {
  Quad reflected, transmitted;
};
Fresnel fresnel(Quad cos, Quad cos_t, Quad eta) {
  if (cos_t <= 0) return {1, 0};
  Quad s = cos + eta * cos_t, p = eta * cos + cos_t;
  Quad rs = (cos - eta * cos_t) / s, rp = (eta * cos - cos_t) / p;
  return {(rs * rs + rp * rp) / 2, 2 * eta * cos * cos_t * (1 / (s * s) + 1 / (p * p))};
}
/// Snell's law.
Quad refracted_cos(Quad cos, Quad eta) {
  return root(1 - (1 - cos * cos) / (eta * eta));
}

/// Walter et al. 2007, eq. 17, with the index of wo's side 1.
Quad refraction_jacobian(Quad cos_o, Quad cos_i, Quad eta) {
  if (cos_i == 0) return 0;
  Quad sum = cos_o + eta * cos_i;
  return eta * eta * absolute(cos_i) / (sum * sum);
}

}  // namespace

Surface plain(Quad alpha_x, Quad alpha_y) {
  return {{{alpha_x, 0, 0}, {0, alpha_y, 0}, {0, 0, 1}}, alpha_x * alpha_y, smaller(alpha_x, alpha_y), false};
}

Surface ellipsoid(Quad alpha_x, Quad alpha_y, Quad theta_x, Quad theta_y, Quad theta_z) {
  Quad s, c, sy, cy, sz, cz;
  sin_cos(theta_x, s, c);
  sin_cos(theta_y, sy, cy);
  sin_cos(theta_z, sz, cz);
  // The columns of diag(alpha_x, alpha_y, 1) Rx Ry.
  Vec a1{alpha_x * cy, alpha_y * s * sy, -c * sy}, a2{0, alpha_y * c, s}, a3{alpha_x * sy, -alpha_y * s * cy, c * cy};
  Vec x = unit(cross(a2, a3)), z = unit(a3), y = cross(z, x);
  Quad n = length(a3);
  auto row = [&](const Vec& axis) {
    Quad r1 = dot(axis, a1), r2 = dot(axis, a2);
    return Vec{(r1 * cz + r2 * sz) / n, (r2 * cz - r1 * sz) / n, 0};
  };
  Surface a{{row(x), row(y), row(z)}, alpha_x * alpha_y / (n * n * n), smaller(alpha_x, alpha_y), true};
  a.row[2].z = 1;
  return a;
}

Normal sample_normal(Warp warp, const Vec& wo, const Surface& surface, Quad u1, Quad u2) {
  return sample(warp, seen(false, wo, surface), wo, surface, u1, u2).normal;
}

Sample sample_reflection(Warp warp, bool bounded, const Vec& wo, const Surface& surface, Quad u1, Quad u2) {
  Seen from = seen(bounded, wo, surface);
  Facet facet = sample(warp, from, wo, surface, u1, u2);
  Vec wi = 2 * facet.normal.cos * facet.normal.wm + Quad(-1) * wo;
  auto weight_of = [&](const Vec& light) { return weight(from, wo, light, surface); };
  Masked w = weight_of(wi);
  return {facet.normal, wi, capped(reflection_pdf(facet.ndf, from)), w,
          slack(weight_of, wi, bounded || surface.by_lunes ? kHalfAUnit : kNextToHorizontal, w)};
}

Sample sample_dielectric(Warp warp, bool reflects, const Vec& view, const Surface& surface, Quad index, Quad u1,
                         Quad u2, const Lobes& lobes) {
  bool below = view.z < 0;
  Vec wo = mirrored(below, view);
  Quad eta = below ? 1 / index : index;
  Seen from = seen(false, wo, surface);
  Facet facet = sample(warp, from, wo, surface, u1, u2);
  const Vec& wm = facet.normal.wm;
  Quad cos = facet.normal.cos;
  Quad cos_t = refracted_cos(cos, eta);
  // Walter et al. 2007, eq. 39 and 40.
  Vec wi = reflects ? 2 * cos * wm + Quad(-1) * wo : (cos / eta - cos_t) * wm + (-1 / eta) * wo;
  auto share_at = [&](Quad c) {
    Fresnel share = fresnel(c, refracted_cos(c, eta), eta);
    return reflects ? share.reflected : share.transmitted;
  };
  auto chosen_at = [&](Quad c) {
    return !lobes.given ? share_at(c) : reflects ? lobes.reflection : 1 - lobes.reflection;
  };
  auto pdf_at = [&](Quad c) {
    return chosen_at(c) * (reflects
                               ? reflection_pdf(facet.ndf, from)
                               : normal_pdf(facet.ndf, c, from) * refraction_jacobian(c, -refracted_cos(c, eta), eta));
  };
  Quad pdf = pdf_at(cos), by_fresnel = share_at(cos), chosen = chosen_at(cos);
  auto weight_of = [&](const Vec& light) {
    Masked w = dielectric_weight(reflects, from, wo, light, surface, eta, lobes);
    if (!lobes.given || chosen == 0) return w;
    return Masked{w.correlated * by_fresnel / chosen, w.separable * by_fresnel / chosen};
  };
  Masked w = weight_of(wi);
  return {facet.normal,
          mirrored(below, wi),
          capped(pdf),
          w,
          slack(weight_of, wi, (reflects ? 1 : -1) * (surface.by_lunes ? kHalfAUnit : kNextToHorizontal), w),
          absolute(pdf_at(cos + kNextToTheRim * from.length / facet.length + kNextToNoCosine) - pdf)};
}

Evaluation evaluate_reflection(bool bounded, const Vec& wo, const Vec& wi, const Surface& surface) {
  Seen from = seen(bounded, wo, surface);
  return evaluation(reflection_pdf(ndf(wo + wi, surface), from), weight(from, wo, wi, surface));
}

Evaluation evaluate_dielectric(const Vec& view, const Vec& light, const Surface& surface, Quad index,
                               const Lobes& lobes) {
  bool below = view.z < 0;
  Vec wo = mirrored(below, view), wi = mirrored(below, light);
  Quad eta = below ? 1 / index : index;
  bool reflects = wi.z >= 0;
  Vec h = wo + (reflects ? Quad(1) : eta) * wi;
  Vec m = unit(mirrored(h.z < 0, h));
  Seen from = seen(false, wo, surface);
  Quad cos_o = dot(wo, m), cos_i = dot(wi, m), share = 0, pdf = 0;
  if (reflects) {
    // Of unit vectors it is |h| / 2. Where they are nearly opposite, what their lengths are off can make it negative.
    Quad cos = cos_o > 0 ? cos_o : Quad(0);
    share = fresnel(cos, refracted_cos(cos, eta), eta).reflected;
    pdf = reflection_pdf(ndf(m, surface), from);
  } else if (cos_o > 0 && cos_i < 0) {
    share = fresnel(cos_o, -cos_i, eta).transmitted;
    pdf = normal_pdf(ndf(m, surface), cos_o, from) * refraction_jacobian(cos_o, cos_i, eta);
  }
  Evaluation value = evaluation(share * pdf, dielectric_weight(reflects, from, wo, wi, surface, eta, lobes));
  if (lobes.given) value.pdf = capped((reflects ? lobes.reflection : 1 - lobes.reflection) * pdf);
  return value;
}

Quad pdf_normals(const Vec& wo, const Vec& wm, const Surface& surface) {
  return capped(normal_pdf(ndf(wm, surface), dot(wo, wm), seen(false, wo, surface)));
}

}  // namespace vndf::exact
