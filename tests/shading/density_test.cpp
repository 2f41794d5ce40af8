// Whether samples have the densities they are given, and whether the densities are what the theory says.
//
// Significance: 0.01 for all chi-square tests of a file together, by Sidak's correction; seeds are fixed.
#include <algorithm>
#include <cstdio>
#include <string>

#include <gtest/gtest.h>

#include <vndf/lanes.h>

#include "reference/errors.h"
#include "reference/random.h"
#include "shading/grids.h"

namespace vndf::shading {
namespace {

using reference::keep_larger;
using reference::kEps;
using reference::Random;

struct Roughness {
  const char* name;
  float x, y;
};
constexpr Roughness kRoughness[] = {{"mirror_like", 1e-3f, 1e-3f}, {"glossy", 0.1f, 0.1f},
                                    {"rough", 0.6f, 0.6f},         {"roughest", 1.f, 1.f},
                                    {"brushed_x", 0.7f, 0.05f},    {"brushed_y", 0.01f, 0.9f}};
struct View {
  const char* name;
  float x, y, z;
};
constexpr View kViews[] = {{"normal", 0.f, 0.f, 1.f},
                           {"oblique", 0.6f, -0.36f, 0.71442284f},
                           {"flat", -0.7f, 0.66143783f, 0.27f},
                           {"grazing", -0.27f, 0.9625487f, 0.02f}};
constexpr View kBelow[] = {
    {"horizontal", 0.8f, 0.6f, 0.f}, {"below", -0.9f, 0.3f, -0.31622776f}, {"far_below", 0.3f, 0.4f, -0.8660254f}};

Vec3<double> vector(const View& v) {
  return {v.x, v.y, v.z};
}
Alpha<double> alpha_of(const Roughness& r) {
  return {r.x, r.y};
}
ellipsoid::M3<double> diagonal(const Roughness& r) {
  return {{r.x, 0, 0}, {0, r.y, 0}, {0, 0, 1}};
}

double integrate(const NormalGrid& grid, const std::vector<float>& values) {
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) sum += values[i] * grid.solid_angle[i];
  return sum;
}

// Eq. 3 is a density, above the horizon and below it. The midpoint rule is good to 3e-6 here, the density's kink where
// wo.wm = 0 being what it errs on.
TEST(Density, OfVisibleNormalsIntegratesToOne) {
  double worst = 0;
  for (const Roughness& r : kRoughness)
    for (const auto* views : {kViews, kBelow})
      for (int v = 0; v < (views == kViews ? 4 : 3); ++v) {
        const View& wo = views[v];
        NormalGrid grid(vector(wo), alpha_of(r), 700, 1400);
        std::vector<float> pdf(grid.m.size());
        pdf_normals(pdf.size(), {wo.x, wo.y, wo.z}, grid.m.in(), {r.x, r.y}, pdf.data());
        double error = std::fabs(integrate(grid, pdf) - 1);
        EXPECT_LE(error, 1e-5) << r.name << " " << wo.name;
        keep_larger(worst, error);
      }
  std::printf("the density of visible normals integrates to 1 within %.1e\n", worst);
}

// The weak white furnace test of Heitz 2014: without shadowing the BRDF reflects all light into the whole sphere. By d
// wi = 4 (wo.m) d m.
TEST(Density, PassesTheWeakWhiteFurnace) {
  for (const Roughness& r : kRoughness)
    for (const View& wo : kViews) {
      NormalGrid grid(vector(wo), alpha_of(r), 700, 1400);
      double sum = 0;
      lanes::Vec3<float> v{wo.x, wo.y, wo.z};
      lanes::Vec2<float> alpha{r.x, r.y};
      float g1 = lanes::smith_g1(v, alpha);
      EXPECT_NEAR(g1, shading::g1(vector(wo), alpha_of(r)), 4e-7);
      EXPECT_NEAR(lanes::smith_lambda(v, alpha), lambda(vector(wo), alpha_of(r)),
                  4e-7 * lambda(vector(wo), alpha_of(r)) + 1e-12);
      for (std::size_t i = 0; i < grid.m.size(); ++i) {
        double cos = dot(vector(wo), grid.m.at(i));
        if (cos <= 0) continue;
        float d = lanes::ndf<float>({grid.m.x[i], grid.m.y[i], grid.m.z[i]}, alpha);
        sum += g1 * double(d) / (4 * wo.z) * 4 * cos * grid.solid_angle[i];
      }
      EXPECT_NEAR(sum, 1, 1e-5) << r.name << " " << wo.name;
    }
}

/// What evaluate_reflection gives for the reflections at a grid of normals.
struct Reflections {
  NormalGrid normals;
  Directions wi;
  Values value;
  std::vector<double> solid_angle;

  Reflections(const View& view, const Roughness& r, const ReflectionOptions& options, NormalGrid grid)
      : normals(std::move(grid)), wi(normals.size()), value(normals.size()), solid_angle(normals.size()) {
    for (std::size_t i = 0; i < wi.size(); ++i) {
      double cos = dot(vector(view), normals.m.at(i));
      wi.set(i, reflect(vector(view), normals.m.at(i)));
      solid_angle[i] = cos > 0 ? 4 * cos * normals.solid_angle[i] : 0;
    }
    evaluate_reflection(wi.size(), {view.x, view.y, view.z}, wi.in(), {r.x, r.y}, value.out(), options);
  }
};

// wi, and the share of rejected samples, against the density that evaluate_reflection states for them.
TEST(ChiSquare, OfReflectedDirections) {
  constexpr std::size_t kSamples = std::size_t(1) << 18;
  // Fine enough for the jump at the horizon to cost less than the samples scatter.
  constexpr int kSub = 192, kSubTurns = 40;
  double tests = double(std::size(kRoughness) * std::size(kViews) * 6), least = 1;
  for (const Roughness& r : kRoughness)
    for (const View& view : kViews)
      for (bool bounded : {false, true}) {
        ReflectionOptions options;
        options.bounded = bounded;
        // Rounding wi to float smears directions by 2^-25, and normals by that over 2 wo.wm.
        if (r.x < 0.01f && view.z < 0.1f) continue;
        Reflections reflected(view, r, options, NormalGrid(diagonal(r), kSub, kSubTurns));
        std::vector<double> expected(kRings * kSectors + 1);
        double all = 0;
        for (std::size_t at = 0; at < reflected.wi.size(); ++at) {
          double share = reflected.value.pdf[at] * reflected.solid_angle[at];
          expected[reflected.normals.bin(at)] += share * kSamples;
          all += share;
        }
        // The midpoint rule sees the jump at the horizon to half a ring.
        EXPECT_LE(all, 1 + 1e-3) << r.name << " " << view.name << " " << bounded;
        expected.back() = std::max(0., 1 - all) * kSamples;
        for (int w = 0; w < 3; ++w) {
          const Numbers u(kSamples, 11 + std::uint64_t(w) + (bounded ? 3 : 0));
          Samples sample(kSamples);
          sample_reflection(kWarps[w], kSamples, {view.x, view.y, view.z}, {r.x, r.y}, u.pairs(), sample.reflection(),
                            options);
          std::vector<double> counts(expected.size());
          for (std::size_t i = 0; i < kSamples; ++i)
            if (sample.wi.z[i] > 0)
              ++counts[bin_of(unstretch(vector(view) + sample.wi.at(i), alpha_of(r)))];
            else
              ++counts.back();
          double p = p_value(counts, expected);
          least = std::min(least, p);
          EXPECT_GE(p, least_p_value(tests)) << kWarpNames[w] << " " << r.name << " " << view.name << " " << bounded;
        }
      }
  std::printf("least p of %g tests: %.3g\n", tests, least);
}

// No reflection at all that plain sampling can give above the horizon is out of bounded sampling's reach: its density
// integrates to what plain sampling accepts, times the share that it leaves of the area. And no direction above the
// horizon comes from below the bound: the derivation in lanes/spherical_cap.h, on random anisotropic surfaces.
TEST(Bounded, ReachesEveryReflectionAboveTheHorizon) {
  Random random(12);
  double closest = 1e9;
  for (int i = 0; i < 2000000; ++i) {
    Alpha<double> alpha{random.log_uniform(1e-3, 3), random.log_uniform(1e-3, 3)};
    auto wo = random_direction(random, random.below(2) ? random.uniform(0, 1) : random.log_uniform(1e-4, 1));
    auto wi = random_direction(random, random.below(2) ? random.uniform(0, 1) : random.log_uniform(1e-6, 1));
    if (random.below(4) == 0) {  // the corner of the bound: forward along the view, at the horizon
      double s = std::sqrt((1 - wi.z * wi.z) / (1 - wo.z * wo.z));
      wi = {wo.x * s, wo.y * s, wi.z};
    }
    Vec3<double> vh = unit(stretch(wo, alpha)), nh = unit(unstretch(wo + wi, alpha));
    double share = bounded_share(wo, alpha);
    double kz = share * (1 + vh.z) - 1;
    double cz = reflect(vh, nh).z;
    closest = std::min(closest, cz + kz);
    ASSERT_GE(cz, -kz - 1e-9) << wo.z << " " << wi.z << " " << alpha.x << " " << alpha.y;
  }
  std::printf("closest approach to the bound: %.2g\n", closest);
}

// f(wo, wi) = f(wi, wo).
TEST(Brdf, IsReciprocal) {
  constexpr std::size_t kCount = 1 << 18;
  Directions a(kCount), b(kCount);
  std::vector<float> ax(kCount), ay(kCount);
  for (std::size_t i = 0; i < kCount; ++i) {
    Random random(13, i);
    for (auto* d : {&a, &b}) d->set(i, random_direction(random, random.log_uniform(1e-3, 1)));
    ax[i] = float(random.log_uniform(1e-3, 1));
    ay[i] = float(random.log_uniform(1e-3, 1));
  }
  for (Masking masking : {Masking::height_correlated, Masking::separable}) {
    Values there(kCount), back(kCount);
    ReflectionOptions options{masking, false};
    evaluate_reflection(kCount, a.in(), b.in(), {ax.data(), ay.data()}, there.out(), options);
    evaluate_reflection(kCount, b.in(), a.in(), {ax.data(), ay.data()}, back.out(), options);
    double worst = 0;
    for (std::size_t i = 0; i < kCount; ++i) {
      double f = double(there.f_cos[i]) / b.z[i], g = double(back.f_cos[i]) / a.z[i];
      keep_larger(worst, std::fabs(f / g - 1) / kEps);
    }
    EXPECT_LE(worst, 40);
  }
}

// No more light leaves than comes.
TEST(Brdf, AlbedoIsAtMostOneAndTheMeanWeight) {
  constexpr std::size_t kSamples = std::size_t(1) << 18;
  const Numbers u(kSamples, 14);
  for (const Roughness& r : kRoughness)
    for (const View& view : kViews)
      for (Masking masking : {Masking::height_correlated, Masking::separable})
        for (bool bounded : {false, true}) {
          ReflectionOptions options{masking, bounded};
          Reflections grid(view, r, options, NormalGrid(vector(view), alpha_of(r), 400, 800));
          double albedo = 0;
          for (std::size_t i = 0; i < grid.wi.size(); ++i) albedo += grid.value.f_cos[i] * grid.solid_angle[i];
          EXPECT_LE(albedo, 1 + 1e-4);
          Samples sample(kSamples);
          sample_reflection(Warp::spherical_cap, kSamples, {view.x, view.y, view.z}, {r.x, r.y}, u.pairs(),
                            sample.reflection(), options);
          double sum = 0, squares = 0;
          for (float w : sample.weight) {
            sum += w;
            squares += double(w) * w;
          }
          double mean = sum / kSamples, sigma = std::sqrt(std::max(0., squares / kSamples - mean * mean) / kSamples);
          EXPECT_NEAR(mean, albedo, 4.7 * sigma + 2e-4) << r.name << " " << view.name << " " << bounded;
        }
}

// Engstad's proof in numbers: the Jacobians of the stages, by differences in extended precision. Each stage has the one
// the theory says, and the density times their product is 1.
namespace jacobian {

using R = long double;
using P2 = std::array<R, 2>;
constexpr R kStep = 1e-6L;

P2 squish(const P2& t, R z) {
  R s = (1 + z) / 2;
  return {t[0], (1 - s) * std::sqrt(1 - t[0] * t[0]) + s * t[1]};
}
Vec3<R> reproject(const P2& t, const Vec3<R>& vh) {
  Vec3<R> t1 = unit(Vec3<R>{-vh.y, vh.x, 0}), t2 = cross(vh, t1);
  return t[0] * t1 + t[1] * t2 + std::sqrt(1 - t[0] * t[0] - t[1] * t[1]) * vh;
}
Vec3<R> on_cap(const P2& u, const Vec3<R>& vh, R k) {
  R z = (1 - u[1]) * (1 + k * vh.z) - k * vh.z, s = std::sqrt(1 - z * z), phi = 2 * kPi<R> * u[0];
  return Vec3<R>{s * std::cos(phi), s * std::sin(phi), z};
}

/// |d f| per area of the plane, for f into the plane or the sphere.
template <class Map>
R area_ratio(Map f, const P2& at) {
  auto at_offset = [&](R dx, R dy) { return f(P2{at[0] + dx, at[1] + dy}); };
  auto right = at_offset(kStep, 0), left = at_offset(-kStep, 0), up = at_offset(0, kStep), down = at_offset(0, -kStep);
  if constexpr (std::is_same_v<decltype(right), P2>) {
    return std::fabs((right[0] - left[0]) * (up[1] - down[1]) - (right[1] - left[1]) * (up[0] - down[0])) /
           (4 * kStep * kStep);
  } else {
    Vec3<R> n = cross(right + R(-1) * left, up + R(-1) * down);
    return std::sqrt(dot(n, n)) / (4 * kStep * kStep);
  }
}
/// The same for f from the sphere to the sphere.
template <class Map>
R solid_angle_ratio(Map f, const Vec3<R>& at) {
  Vec3<R> a = unit(cross(at, std::fabs(at.z) < 0.9L ? Vec3<R>{0, 0, 1} : Vec3<R>{1, 0, 0})), b = cross(at, a);
  return area_ratio([&](const P2& d) { return f(unit(at + d[0] * a + d[1] * b)); }, P2{0, 0});
}

}  // namespace jacobian

TEST(Jacobian, OfEveryStageTimesTheDensityIsOne) {
  using namespace jacobian;
  R worst[7] = {};
  auto check = [&](int stage, R ratio, R expected) {
    R error = std::fabs(ratio / expected - 1);
    worst[stage] = std::max(worst[stage], error);
    return error < 1e-7L;
  };
  for (std::uint64_t i = 0; i < 20000; ++i) {
    Random random(15, i);
    Alpha<R> alpha{random.log_uniform(0.02, 1), random.log_uniform(0.02, 1)};
    R z = random.uniform(i % 3 ? 0.05 : -0.9, 0.999), phi = random.uniform(0, 6.28);
    Vec3<R> wo{std::sqrt(1 - z * z) * std::cos(phi), std::sqrt(1 - z * z) * std::sin(phi), z};
    Vec3<R> vh = unit(stretch(wo, alpha));
    if (vh.z < -0.98L) continue;
    P2 u{R(random.uniform(0.03, 0.9)), R(random.uniform(0.03, 0.97))};
    R a = 2 * u[0] - 1, b = 2 * u[1] - 1;
    if (std::fabs(std::fabs(a) - std::fabs(b)) < 1e-4L || std::fabs(a) + std::fabs(b) < 1e-3L) continue;

    bool is_polar = i % 2;
    auto disk = [&](const P2& p) {
      auto t = ellipsoid::disk_point(is_polar ? Warp::polar : Warp::concentric, p[0], p[1]);
      return P2{t.t1, t.t2};
    };
    P2 t = disk(u);
    ASSERT_TRUE(check(0, area_ratio(disk, u), kPi<R>));
    R s = (1 + vh.z) / 2;
    P2 t2 = squish(t, vh.z);
    if (t2[0] * t2[0] + t2[1] * t2[1] > 0.98L || 1 - t[0] * t[0] < 0.02L) continue;
    ASSERT_TRUE(check(1, area_ratio([&](const P2& p) { return squish(p, vh.z); }, t), s));
    Vec3<R> nh = reproject(t2, vh);
    ASSERT_TRUE(check(2, area_ratio([&](const P2& p) { return reproject(p, vh); }, t2), 1 / dot(nh, vh)));
    auto to_ellipsoid = [&](const Vec3<R>& n) { return unit(stretch(n, alpha)); };
    Vec3<R> m = to_ellipsoid(nh);
    R n = std::sqrt(dot(stretch(nh, alpha), stretch(nh, alpha)));
    ASSERT_TRUE(check(3, solid_angle_ratio(to_ellipsoid, nh), alpha.x * alpha.y / (n * n * n)));
    ASSERT_TRUE(check(4, solid_angle_ratio([&](const Vec3<R>& v) { return reflect(wo, v); }, m), 4 * dot(wo, m)));
    if (wo.z <= 0) continue;

    auto normal = [&](const P2& p) { return to_ellipsoid(reproject(squish(disk(p), vh.z), vh)); };
    ASSERT_TRUE(check(5, area_ratio(normal, u) * visible_normal_pdf(wo, m, alpha), 1));
    auto whole = [&](const P2& p) { return reflect(wo, normal(p)); };
    ASSERT_TRUE(check(5, area_ratio(whole, u) * reflection_pdf(wo, m, alpha), 1));

    // The cap, whole and bounded: reflecting on the hemisphere's half vector is 1 / 4 (Vh.Nh).
    for (R share : {R(1), bounded_share(wo, alpha)}) {
      R k = (share * (1 + vh.z) - 1) / vh.z;
      auto cap = [&](const P2& p) { return to_ellipsoid(unit(on_cap(p, vh, k) + vh)); };
      Vec3<R> mc = cap(u);
      auto reflected = [&](const P2& p) { return reflect(wo, cap(p)); };
      ASSERT_TRUE(check(6, area_ratio(reflected, u) * reflection_pdf(wo, mc, alpha) / share, 1));
    }
  }
  std::printf(
      "Jacobians, largest relative deviation: disk %.1Le, squish %.1Le, reproject %.1Le, back %.1Le, reflect "
      "%.1Le, density times all %.1Le, caps %.1Le\n",
      worst[0], worst[1], worst[2], worst[3], worst[4], worst[5], worst[6]);
}

}  // namespace
}  // namespace vndf::shading
