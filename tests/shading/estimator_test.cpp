// What the samples are for: estimates of reflected light, compared with integration and with samples of the
// distribution of normals.
#include <algorithm>
#include <cstdio>

#include <gtest/gtest.h>

#include "shading/grids.h"

namespace vndf::shading {
namespace {

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

/// Rejected samples in percent, all visible normals and bounded, at cos = 0.95.
constexpr struct {
  float alpha_x, alpha_y;
  double rejected[2];
} kStatedByTheHeader[] = {{1, 1, {49, 0}}, {0.6f, 0.6f, {26, 4}}, {0.2f, 0.8f, {23, 21}}};

// For every surface and view: the estimator's mean is the integral; the variance of its weight is below that of
// sampling the normals whatever the view (Walter et al. 2007, eq. 35-36 and 41), and so is that of the light but for
// the luck of where the lamp is; bounded, it is below the plain one's where that rejects.
TEST(Estimator, AgreesWithIntegrationAndHasTheLeastVariance) {
  constexpr std::size_t kSamples = std::size_t(1) << 19;
  const Numbers u(kSamples, 21);
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
        sample_reflection(Warp::concentric, kSamples, {0.8f * sin, 0.6f * sin, cos}, {alpha.x, alpha.y}, u.pairs(),
                          sample.reflection(), options);
        ours[bounded] = estimate(kSamples, [&](std::size_t i) {
          return sample.wi.z[i] > 0 ? sample.weight[i] * radiance(sample.wi.at(i)) : -1.;
        });
        weights[bounded] = estimate(kSamples, [&](std::size_t i) { return double(sample.weight[i]); });
        EXPECT_NEAR(ours[bounded].mean, integral, 4.7 * std::sqrt(ours[bounded].variance / kSamples) + 2e-4 * integral);
      }
      // Normals of density D(m) m.z: slopes (alpha_x, alpha_y) tan(theta) with sin^2(theta) uniform.
      auto by_ndf = [&](std::size_t i, bool lit) {
        double t = std::sqrt(u.a[i] / (1 - double(u.a[i]))), phi = 2 * kPi<double> * u.b[i];
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
      for (const auto& stated : kStatedByTheHeader)
        for (int bounded : {0, 1}) {
          if (cos != 0.95f || alpha.x != stated.alpha_x || alpha.y != stated.alpha_y) continue;
          EXPECT_NEAR(100 * ours[bounded].rejected, stated.rejected[bounded], 0.5);
        }
      if (ours[0].rejected > 0.05 && ours[0].rejected - ours[1].rejected > 0.01) {
        EXPECT_LT(ours[1].variance, ours[0].variance);
      }
    }
}

}  // namespace
}  // namespace vndf::shading
