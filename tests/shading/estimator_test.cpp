// What the samples are for: estimates of reflected light, compared with integration, with samples of the distribution
// of normals, and with samplers that share nothing with ours.
#include <algorithm>
#include <cstdio>

#include <gtest/gtest.h>

#include "reference/random.h"
#include "shading/statistics.h"

namespace vndf::shading {
namespace {

using reference::Random;

/// Light from everywhere, from a window near the horizon, and from a lamp.
double radiance(const Vec3<double>& wi) {
  Vec3<double> lamp = unit(Vec3<double>{-0.5, 0.4, 0.7});
  return 0.5 + 0.3 * wi.x + (wi.z < 0.3 && wi.x < 0 ? 2 : 0) + 5 * std::exp(30 * (dot(wi, lamp) - 1));
}

struct Estimate {
  double mean, variance, rejected;
};
template <class Value>
Estimate estimate(std::size_t count, Value value) {
  double sum = 0, squares = 0, rejected = 0;
  for (std::size_t i = 0; i < count; ++i) {
    double x = value(i);
    if (x < 0) {
      ++rejected;
      continue;
    }
    sum += x;
    squares += x * x;
  }
  double n = double(count);
  return {sum / n, squares / n - sum / n * (sum / n), rejected / n};
}

// For every surface and view: the estimator's mean is the integral; the variance of its weight is below that of
// sampling the normals whatever the view (Walter et al. 2007, eq. 35-36 and 41), and so is that of the light but for
// the luck of where the lamp is; bounded, it is below the plain one's where that rejects.
TEST(Estimator, AgreesWithIntegrationAndHasTheLeastVariance) {
  constexpr std::size_t kSamples = std::size_t(1) << 19;
  std::vector<float> u1(kSamples), u2(kSamples);
  for (std::size_t i = 0; i < kSamples; ++i) {
    Random random(21, i);
    u1[i] = random.unit();
    u2[i] = random.unit();
  }
  std::printf("%-12s %-5s | %8s | %9s %9s %9s | %8s %8s\n", "alpha", "cos", "mean", "var NDF", "visible", "bounded",
              "rejected", "bounded");
  for (Alpha<float> alpha :
       {Alpha<float>{0.1f, 0.1f}, {0.3f, 0.3f}, {0.6f, 0.6f}, {1.f, 1.f}, {0.2f, 0.8f}, {0.7f, 0.9f}})
    for (float cos : {0.95f, 0.6f, 0.3f, 0.1f}) {
      float sin = std::sqrt(1 - cos * cos);
      Vec3<double> wo{0.8f * sin, 0.6f * sin, cos};
      Alpha<double> a{alpha.x, alpha.y};
      // By integration over the normals, with the library's BRDF.
      NormalGrid grid(wo, a, 500, 1000);
      Directions wi(grid.m.size());
      Values value(wi.size());
      for (std::size_t i = 0; i < wi.size(); ++i) wi.set(i, reflect(wo, grid.m.at(i)));
      evaluate_reflection(wi.size(), {0.8f * sin, 0.6f * sin, cos}, wi.in(), {alpha.x, alpha.y}, value.out());
      double integral = 0;
      for (std::size_t i = 0; i < wi.size(); ++i) {
        double c = dot(wo, grid.m.at(i));
        if (c > 0) integral += value.f_cos[i] * radiance(wi.at(i)) * 4 * c * grid.solid_angle[i];
      }

      Estimate ours[2], weights[2];
      for (bool bounded : {false, true}) {
        ReflectionOptions options;
        options.bounded = bounded;
        Samples sample(kSamples);
        sample_reflection(Warp::concentric, kSamples, {0.8f * sin, 0.6f * sin, cos}, {alpha.x, alpha.y},
                          {u1.data(), u2.data()}, sample.reflection(), options);
        ours[bounded] = estimate(kSamples, [&](std::size_t i) {
          return sample.wi.z[i] > 0 ? sample.weight[i] * radiance(sample.wi.at(i)) : -1.;
        });
        weights[bounded] = estimate(kSamples, [&](std::size_t i) { return double(sample.weight[i]); });
        EXPECT_NEAR(ours[bounded].mean, integral, 4.7 * std::sqrt(ours[bounded].variance / kSamples) + 2e-4 * integral);
      }
      // Normals of density D(m) m.z: slopes (alpha_x, alpha_y) tan(theta) with sin^2(theta) uniform.
      auto by_ndf = [&](std::size_t i, bool lit) {
        double t = std::sqrt(u1[i] / (1 - double(u1[i]))), phi = 2 * kPi<double> * u2[i];
        Vec3<double> m = unit(Vec3<double>{a.x * t * std::cos(phi), a.y * t * std::sin(phi), 1});
        double c = dot(wo, m);
        if (c <= 0) return -1.;
        Vec3<double> l = reflect(wo, m);
        if (l.z <= 0) return -1.;
        return brdf_cos(wo, l, a, false) * 4 * c / (ndf(m, a) * m.z) * (lit ? radiance(l) : 1);
      };
      Estimate ndf_samples = estimate(kSamples, [&](std::size_t i) { return by_ndf(i, true); });
      Estimate ndf_weights = estimate(kSamples, [&](std::size_t i) { return by_ndf(i, false); });
      EXPECT_NEAR(ndf_samples.mean, integral, 6 * std::sqrt(ndf_samples.variance / kSamples) + 2e-4 * integral);
      std::printf("%.2f, %.2f   %.2f  | %8.4f | %9.4f %9.4f %9.4f | %7.2f%% %7.2f%%\n", alpha.x, alpha.y, cos, integral,
                  ndf_samples.variance, ours[0].variance, ours[1].variance, 100 * ours[0].rejected,
                  100 * ours[1].rejected);
      EXPECT_LT(weights[0].variance, ndf_weights.variance);
      EXPECT_LT(ours[0].variance, 1.1 * ndf_samples.variance);
      EXPECT_LE(ours[1].rejected, ours[0].rejected + 1e-3);
      if (ours[0].rejected > 0.05 && ours[0].rejected - ours[1].rejected > 0.01) {
        EXPECT_LT(ours[1].variance, ours[0].variance);
      }
    }
}

// Walter et al. 2015, section 4: rays against the ellipsoid, from a bounding sphere (version 1) and from the
// ellipsoid's own silhouette (version 2), rejecting what is not visible from above. They share nothing with the closed
// forms.
class Rejection {
 public:
  Rejection(const Vec3<double>& wo, const Alpha<double>& alpha, std::uint64_t seed)
      : wo_(wo), alpha_(alpha), random_(seed) {}

  Vec3<double> version_1() {
    Vec3<double> a = unit(cross(wo_, std::fabs(wo_.z) < 0.9 ? Vec3<double>{0, 0, 1} : Vec3<double>{1, 0, 0}));
    Vec3<double> b = cross(wo_, a);
    double radius = 1 / std::min({1., alpha_.x, alpha_.y});
    for (;;) {
      ++tried_;
      auto [x, y] = disk();
      Vec3<double> from = (radius * x) * a + (radius * y) * b;
      // |A (from - t wo)| = 1, the first hit being the one on the viewer's side.
      Vec3<double> o = stretch(from, alpha_), d = stretch(wo_, alpha_);
      double dd = dot(d, d), od = dot(o, d), discriminant = od * od - dd * (dot(o, o) - 1);
      if (discriminant < 0) continue;
      double t = (od - std::sqrt(discriminant)) / dd;
      Vec3<double> p = from + (-t) * wo_;
      Vec3<double> m = unit(stretch(stretch(p, alpha_), alpha_));
      if (m.z < 0 || dot(m, wo_) < 0) continue;
      return m;
    }
  }

  Vec3<double> version_2() {
    Vec3<double> d = unit(stretch(wo_, alpha_));
    Vec3<double> a = unit(cross(d, std::fabs(d.z) < 0.9 ? Vec3<double>{0, 0, 1} : Vec3<double>{1, 0, 0})),
                 b = cross(d, a);
    for (;;) {
      ++tried_;
      auto [x, y] = disk();
      Vec3<double> p = x * a + y * b + std::sqrt(std::max(0., 1 - x * x - y * y)) * d;
      if (p.z >= 0) return unit(stretch(p, alpha_));
    }
  }
  double tried() const { return tried_; }

 private:
  std::pair<double, double> disk() {
    for (;;) {
      double x = random_.uniform(-1, 1), y = random_.uniform(-1, 1);
      if (x * x + y * y < 1) return {x, y};
    }
  }
  Vec3<double> wo_;
  Alpha<double> alpha_;
  Random random_;
  double tried_ = 0;
};

TEST(Rejection, HasTheDistributionOfOurNormals) {
  constexpr std::size_t kSamples = std::size_t(1) << 17;
  const Alpha<float> alphas[] = {{0.3f, 0.3f}, {1.f, 1.f}, {0.2f, 0.7f}, {2.f, 0.6f}};
  const Vec3<float> views[] = {
      {0, 0, 1}, {0.6f, -0.36f, 0.71442284f}, {-0.27f, 0.9625487f, 0.02f}, {-0.9f, 0.3f, -0.31622776f}};
  double tests = 4 * 4 * 3 * 2;
  for (const auto& alpha : alphas)
    for (const auto& wo : views) {
      Alpha<double> a{alpha.x, alpha.y};
      Vec3<double> view{wo.x, wo.y, wo.z};
      Rejection first(view, a, 31), second(view, a, 32);
      std::vector<double> by_1(kRings * kSectors), by_2(by_1.size());
      for (std::size_t i = 0; i < kSamples; ++i) {
        ++by_1[bin_of_normal(first.version_1(), a)];
        ++by_2[bin_of_normal(second.version_2(), a)];
      }
      std::printf("alpha %.1f, %.1f, cos %5.2f: version 1 keeps %.1f %%, version 2 %.1f %%\n", alpha.x, alpha.y, wo.z,
                  100 * kSamples / first.tried(), 100 * kSamples / second.tried());
      for (int w = 0; w < 3; ++w) {
        std::vector<float> u1(kSamples), u2(kSamples);
        for (std::size_t i = 0; i < kSamples; ++i) {
          Random random(33 + std::uint64_t(w), i);
          u1[i] = random.unit();
          u2[i] = random.unit();
        }
        Directions wm(kSamples);
        sample_normals(kWarps[w], kSamples, {wo.x, wo.y, wo.z}, {alpha.x, alpha.y}, {u1.data(), u2.data()}, wm.out());
        std::vector<double> ours(by_1.size());
        for (std::size_t i = 0; i < kSamples; ++i) ++ours[bin_of_normal(wm.at(i), a)];
        EXPECT_GE(two_sample_p_value(ours, by_1), least_p_value(tests)) << kWarpNames[w];
        EXPECT_GE(two_sample_p_value(ours, by_2), least_p_value(tests)) << kWarpNames[w];
      }
    }
}

}  // namespace
}  // namespace vndf::shading
