// The exact results that ratios are measured with (reference/exact.h) are those of the plain oracles: of the listings
// in quadruple precision, and of the papers' formulas for densities, weights and shapes.
#include <gtest/gtest.h>

#include "ellipsoid/model.h"
#include "ratio/rows.h"
#include "ratio/surfaces.h"
#include "reference/exact.h"
#include "reference/oracle.h"

namespace vndf::ratio {
namespace {

using exact::Vec;
using reference::square_root;
using R = long double;

constexpr std::size_t kCount = 64;

/// The largest component of the difference.
double distance(const Vec& a, double x, double y, double z) {
  return std::max(
      {std::fabs(double(a.x - Quad(x))), std::fabs(double(a.y - Quad(y))), std::fabs(double(a.z - Quad(z)))});
}

TEST(Exact, NormalsAreThoseOfTheListings) {
  for (const HardCase& row : rows(Views::any))
    for (Warp warp : kWarps) {
      auto in = reference::generate(row, warp, kCount, 21);
      for (std::size_t i = 0; i < kCount; ++i) {
        const float wo[3] = {in.wo_x[i], in.wo_y[i], in.wo_z[i]}, alpha[2] = {in.alpha_x[i], in.alpha_y[i]};
        const float u[2] = {in.u_x[i], in.u_y[i]};
        auto listing = reference::oracle_normal_quad(warp, wo, alpha, u);
        auto normal = exact::sample_normal(warp, {wo[0], wo[1], wo[2]}, exact::plain(alpha[0], alpha[1]), u[0], u[1]);
        // The listing itself cancels where neither it nor its bound says much.
        if (!normal.defined || !(listing.uncertainty < 1e-9)) continue;
        EXPECT_LE(distance(normal.wm, listing.x, listing.y, listing.z), 1e-15 + listing.uncertainty)
            << row.name << " " << kWarpNames[int(warp)] << " " << i;
      }
    }
}

TEST(Exact, NormalsOfEllipsoidsAreWalters) {
  auto row = reference::hard_cases().front();
  for (Warp warp : kWarps) {
    auto in = reference::generate(row, warp, kCount, 22);
    for (std::size_t i = 0; i < kCount; ++i) {
      reference::Random random(23, i);
      std::array<float, 5> shape{in.alpha_x[i], in.alpha_y[i]};
      Tilted::add_angles(random, shape.data());
      ellipsoid::Parameters p{shape[0], shape[1], shape[2], shape[3], shape[4]};
      auto a = ellipsoid::matrix<Quad>(p);
      shading::Vec3<Quad> psi{in.wo_x[i], in.wo_y[i], in.wo_z[i]};
      Quad u1 = in.u_x[i], u2 = in.u_y[i];
      auto m = warp == Warp::spherical_cap ? ellipsoid::sample_cap(psi, a, u1, u2)
                                           : ellipsoid::sample_version_3(psi, a, ellipsoid::disk_point(warp, u1, u2));
      auto surface = exact::ellipsoid(shape[0], shape[1], shape[2], shape[3], shape[4]);
      auto normal = exact::sample_normal(warp, {psi.x, psi.y, psi.z}, surface, u1, u2);
      EXPECT_LE(distance(normal.wm, double(m.x), double(m.y), double(m.z)), 1e-15) << kWarpNames[int(warp)] << " " << i;

      Vec wo{psi.x, psi.y, psi.z};
      double pdf = double(exact::pdf_normals(wo, normal.wm, surface));
      EXPECT_NEAR(double(ellipsoid::normal_pdf(psi, m, a)), pdf, 1e-12 * pdf);
      auto sample = exact::sample_reflection(warp, false, wo, surface, u1, u2);
      EXPECT_NEAR(double(sample.pdf), pdf / (4 * double(normal.cos)), 1e-12 * double(sample.pdf));
      // Walter et al. 2015, eq. 50 and 4: f wi.z = D G1(wo) G1(wi) / (4 wo.z).
      shading::Vec3<Quad> wi{sample.wi.x, sample.wi.y, sample.wi.z};
      if (wi.z <= 0) continue;
      Quad f = ellipsoid::ndf(m, a) * ellipsoid::g1(psi, a) * ellipsoid::g1(wi, a) / (4 * psi.z);
      EXPECT_NEAR(double(sample.weight.separable * sample.pdf / f), 1, 1e-12);
    }
  }
}

TEST(Exact, DensitiesAndWeightsOfGgxAreHeitzs) {
  auto in = reference::generate(reference::hard_cases().front(), Warp::polar, 1024, 24);
  for (std::size_t i = 0; i < in.size(); ++i)
    for (bool bounded : {false, true}) {
      shading::Vec3<R> v{in.wo_x[i], in.wo_y[i], in.wo_z[i]};
      shading::Alpha<R> alpha{in.alpha_x[i], in.alpha_y[i]};
      Vec wo{in.wo_x[i], in.wo_y[i], in.wo_z[i]};
      auto surface = exact::plain(in.alpha_x[i], in.alpha_y[i]);
      auto s = exact::sample_reflection(Warp::polar, bounded, wo, surface, in.u_x[i], in.u_y[i]);
      if (s.wi.z <= 1e-3) continue;
      shading::Vec3<R> m{R(s.normal.wm.x), R(s.normal.wm.y), R(s.normal.wm.z)}, l{R(s.wi.x), R(s.wi.y), R(s.wi.z)};
      R share = bounded ? shading::bounded_share(v, alpha) : R(1), pdf = shading::reflection_pdf(v, m, alpha) / share;
      EXPECT_NEAR(double(R(s.pdf) / pdf), 1, 1e-12);
      EXPECT_NEAR(double(R(s.weight.correlated * s.pdf) / shading::brdf_cos(v, l, alpha, false)), 1, 1e-12);
      EXPECT_NEAR(double(R(s.weight.separable * s.pdf) / shading::brdf_cos(v, l, alpha, true)), 1, 1e-12);
      // What was sampled is what is evaluated.
      auto e = exact::evaluate_reflection(bounded, wo, s.wi, surface);
      EXPECT_NEAR(double(e.pdf / s.pdf), 1, 1e-6);  // wo is a unit vector to 2^-24
      EXPECT_NEAR(double(e.f_cos.correlated / (s.weight.correlated * s.pdf)), 1, 1e-6);
    }
}

TEST(Exact, DielectricsAreSampledAsTheyAreEvaluated) {
  auto in = reference::generate(reference::hard_cases().front(), Warp::concentric, 1024, 25);
  for (std::size_t i = 0; i < in.size(); ++i)
    for (bool reflects : {false, true})
      for (double eta : {1.5, 0.7, 1.01}) {
        // In Quad the view can be a unit vector.
        Vec wo{in.wo_x[i], in.wo_y[i], i % 2 ? in.wo_z[i] : -in.wo_z[i]};
        Quad norm = length(wo);
        wo = {wo.x / norm, wo.y / norm, wo.z / norm};
        auto surface = exact::plain(in.alpha_x[i], in.alpha_y[i]);
        auto s = exact::sample_dielectric(Warp::concentric, reflects, wo, surface, eta, in.u_x[i], in.u_y[i]);
        bool leaves = (s.wi.z > 0) == (reflects == (wo.z > 0)) && s.pdf > 0;
        if (!leaves) continue;
        EXPECT_NEAR(double(length(s.wi)), 1, 1e-15);
        auto e = exact::evaluate_dielectric(wo, s.wi, surface, eta);
        EXPECT_NEAR(double(e.pdf / s.pdf), 1, 1e-9);
        EXPECT_NEAR(double(e.f_cos.separable / (s.weight.separable * s.pdf)), 1, 1e-9);
        // The share is Fresnel's by the angle, what is not reflected is transmitted, and the rest of the density that
        // of the normal over 4 wo.wm or times the Jacobian of Walter et al. 2007, eq. 17.
        Quad sign = wo.z < 0 ? -1 : 1, n = wo.z < 0 ? 1 / Quad(eta) : Quad(eta), c = s.normal.cos;
        R share = shading::fresnel(R(c), R(n));
        Quad normals = exact::pdf_normals({sign * wo.x, sign * wo.y, sign * wo.z}, s.normal.wm, surface);
        Quad cos_t = square_root(1 - (1 - c * c) / (n * n)), h = c - n * cos_t;
        Quad expected = reflects ? share * normals / (4 * c) : (1 - share) * normals * n * n * cos_t / (h * h);
        EXPECT_NEAR(double(s.pdf / expected), 1, 1e-9) << reflects << " " << eta;
      }
}

}  // namespace
}  // namespace vndf::ratio
