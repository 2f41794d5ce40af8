// The rough dielectric: Fresnel's equations, directions, densities, energy, from outside and from inside.
//
// Significance: 0.01 for all chi-square tests of a file together, by Sidak's correction; seeds are fixed.
#include <algorithm>
#include <cstdio>

#include <gtest/gtest.h>

#include <vndf/lanes.h>

#include "reference/errors.h"
#include "reference/random.h"
#include "shading/sphere.h"

namespace vndf::shading {
namespace {

using reference::keep_larger;
using reference::kEps;
using reference::Random;
using R = long double;

constexpr float kEtas[] = {1.5f, 1 / 1.5f, 1.05f, 2.4f, 0.1f, 0.3f, 4.f, 10.f};

/// How steep Fresnel's shares are near total reflection, beside 1 / g: where the indices are further apart than 1 to
/// 2.45 it grows with the square of their quotient.
R contrast(float eta) {
  R quotient = std::max(eta, 1 / eta);
  return std::max(R(1), quotient * quotient / 6);
}

struct View {
  float x, y, z;
};
constexpr View kViews[] = {{0.f, 0.f, 1.f},
                           {0.6f, -0.36f, 0.71442284f},
                           {-0.8f, 0.5723635f, 0.18f},
                           {0.6f, -0.36f, -0.71442284f},
                           {-0.8f, 0.5723635f, -0.18f}};
constexpr Alpha<float> kAlphas[] = {{0.3f, 0.3f}, {0.7f, 0.7f}, {0.2f, 0.6f}};

// Relative accuracy of both shares, for eta from 0.1 to 10 and close to 1. Near the angle of total reflection the
// transmitted share is as ill-conditioned as g, near Brewster's angle rp alone vanishes, and rs does not.
TEST(Fresnel, BothSharesAreAccurate) {
  double reflected = 0, transmitted = 0, sum = 0;
  for (std::uint64_t i = 0; i < 1000000; ++i) {
    Random random(41, i);
    float eta = float(random.below(2) ? random.log_uniform(0.1, 10) : 1 + random.log_uniform(1e-5, 1e-2));
    float cos = float(random.below(2) ? random.uniform(0, 1) : random.log_uniform(1e-6, 1));
    auto index = lanes::index_seen(false, eta);
    auto f = lanes::fresnel(lanes::cosines(cos, index), index);
    R c = cos, n = eta, g2 = n * n - 1 + c * c;
    if (g2 <= 0) {
      EXPECT_EQ(f.reflected, 1);
      EXPECT_EQ(f.transmitted, 0);
      continue;
    }
    R g = std::sqrt(g2), conditioning = 1 + (c * c + std::fabs(n * n - 1)) / g2;
    keep_larger(sum, double(std::fabs(R(f.reflected) + f.transmitted - 1) / conditioning / kEps));
    R s = (c - g) / (c + g), p = (n * n * c - g) / (n * n * c + g);
    R exact = (s * s + p * p) / 2;
    R through = 2 * c * g * (1 / ((c + g) * (c + g)) + n * n / ((n * n * c + g) * (n * n * c + g)));
    // Long double takes the plain differences with 1e-19 / |n - 1| to spare.
    keep_larger(reflected, double(std::fabs(f.reflected / exact - 1) / conditioning / kEps));
    keep_larger(transmitted, double(std::fabs(f.transmitted / through - 1) / conditioning / kEps));
    if (std::fabs(n - 1) > 0.01L) {
      EXPECT_NEAR(double(exact), double(fresnel(c, n)), 1e-12);
    }
  }
  std::printf("Fresnel: reflected %.1f, transmitted %.1f eps times conditioning; their sum is 1 within %.1f\n",
              reflected, transmitted, sum);
  EXPECT_LE(reflected, 16);
  EXPECT_LE(transmitted, 16);
  EXPECT_LE(sum, 16);
}

// Directions are the papers' for the normal of the same random numbers, the shares as Fresnel says; what is at the
// wrong side counts nothing.
TEST(Dielectric, DirectionsAndSides) {
  constexpr std::size_t kCount = 1 << 15;
  Numbers u(kCount, 42);
  double worst[2] = {}, worst_unit = 0;
  for (const View& v : kViews)
    for (float eta : kEtas)
      for (const auto& alpha : {Alpha<float>{1e-3f, 1e-3f}, kAlphas[1], kAlphas[2]})
        for (Warp warp : kWarps) {
          Samples sample(kCount);
          sample_dielectric(warp, kCount, {v.x, v.y, v.z}, {alpha.x, alpha.y}, eta, u.in(), sample.dielectric());
          float flip = v.z < 0 ? -1.f : 1.f;
          Directions wm(kCount);
          sample_normals(warp, kCount, {flip * v.x, flip * v.y, flip * v.z}, {alpha.x, alpha.y},
                         {u.a.data(), u.b.data()}, wm.out());
          Vec3<R> wo{flip * v.x, flip * v.y, flip * v.z};
          R n = v.z < 0 ? 1 / R(eta) : R(eta);
          double flipped = 0;
          for (std::size_t i = 0; i < kCount; ++i) {
            Vec3<R> m = unit(wm.at<R>(i));
            R c = dot(wo, m), f = fresnel(c, n);
            bool reflects = sample.side[i] > 0;
            ASSERT_TRUE(std::fabs(sample.side[i]) == 1);
            if (std::fabs(f - u.c[i]) > 1e-4L) {
              ASSERT_EQ(reflects, R(u.c[i]) < f);
            }
            flipped += reflects != (R(u.c[i]) < f);
            R sin2 = (1 - c * c) / (n * n);
            Vec3<R> exact =
                reflects ? reflect(wo, m) : (1 / n) * (R(-1) * wo) + (c / n - std::sqrt(std::max(R(0), 1 - sin2))) * m;
            exact = R(flip) * exact;
            Vec3<R> wi = sample.wi.at<R>(i), off = wi + R(-1) * exact;
            // Refraction near total reflection is as ill-conditioned as the root of 1 - sin^2.
            R conditioning = reflects ? R(1) : 1 + 1 / std::sqrt(std::max(R(1e-12L), 1 - sin2));
            keep_larger(worst[reflects], double(std::sqrt(dot(off, off)) / conditioning / kEps));
            keep_larger(worst_unit, double(std::fabs(std::sqrt(dot(wi, wi)) - 1) / conditioning / kEps));
            bool possible = (wi.z * v.z > 0) == reflects && wi.z != 0;
            if (!possible) {
              ASSERT_EQ(sample.pdf[i], 0);
              ASSERT_EQ(sample.weight[i], 0);
            }
            ASSERT_LE(sample.weight[i], 1);
          }
          EXPECT_LE(flipped, kCount * 1e-4);
        }
  std::printf("wi given wm: reflected within %.1f, refracted within %.1f eps; length within %.1f eps\n", worst[1],
              worst[0], worst_unit);
  EXPECT_LE(worst[1], 25);
  EXPECT_LE(worst[0], 25);
}

// sample's density is evaluate's. Rounding wi turns wm by 2^-24 over |wo + eta wi|, which D magnifies by 2 / alpha, the
// cosines by their own reciprocals, and Fresnel's shares by 1 / g near total reflection.
TEST(Dielectric, SampleAgreesWithEvaluate) {
  constexpr std::size_t kCount = 1 << 16;
  Numbers u(kCount, 43);
  double worst = 0;
  for (const View& v : kViews)
    for (float eta : kEtas)
      for (const auto& alpha : {Alpha<float>{1e-2f, 1e-2f}, kAlphas[0], kAlphas[1], kAlphas[2]})
        for (Masking masking : {Masking::height_correlated, Masking::separable}) {
          Samples sample(kCount);
          Values value(kCount);
          sample_dielectric(Warp::concentric, kCount, {v.x, v.y, v.z}, {alpha.x, alpha.y}, eta, u.in(),
                            sample.dielectric(), masking);
          evaluate_dielectric(kCount, {v.x, v.y, v.z}, sample.wi.in(), {alpha.x, alpha.y}, eta, value.out(), masking);
          R n = v.z < 0 ? 1 / R(eta) : R(eta);
          for (std::size_t i = 0; i < kCount; ++i) {
            if (sample.pdf[i] <= 0) continue;
            Vec3<R> wo{v.x, v.y, v.z}, wi = sample.wi.at<R>(i);
            Vec3<R> h = wo + (sample.side[i] > 0 ? R(1) : n) * wi;
            R length = std::sqrt(dot(h, h)), c = std::fabs(dot(wo, h)) / length, c_i = std::fabs(dot(wi, h)) / length;
            R conditioning = (4 + 2 / R(std::min(alpha.x, alpha.y))) / std::min(R(1), length) / (c * c_i);
            conditioning *= 1 + contrast(eta) / std::sqrt(std::max(R(1e-12L), std::fabs(n * n - 1 + c * c)));
            double error = double(std::fabs(R(sample.pdf[i]) / value.pdf[i] - 1) / conditioning / kEps);
            keep_larger(worst, error);
            ASSERT_LE(error, 8) << v.z << " " << eta << " " << alpha.x << " " << sample.side[i] << " at " << i;
            R f = R(sample.weight[i]) * value.pdf[i];
            ASSERT_NEAR(double(value.f_cos[i] / f), 1, 20 * kEps);
          }
        }
  std::printf("densities agree within %.2f eps (4 + 2 / alpha) (1 + 1 / g) / (|h| wo.wm |wi.wm|)\n", worst);
}

// wi on both sides, and the share that is lost, against the density that evaluate_dielectric states; and the mean
// weight against the integral of f cos: energy is kept but for what masking loses.
TEST(Dielectric, HasTheDensityAndTheEnergyThatItStates) {
  constexpr std::size_t kSamples = std::size_t(1) << 18;
  Numbers u(kSamples, 44);
  Sphere sphere;
  double tests = double(std::size(kViews) * std::size(kAlphas) * 3 * 3), least = 1;
  for (const View& v : kViews)
    for (const auto& alpha : kAlphas)
      for (float eta : {1.5f, 1 / 1.5f, 2.4f}) {
        Masking masking = alpha.x == 0.7f ? Masking::separable : Masking::height_correlated;
        evaluate_dielectric(Sphere::kCount, {v.x, v.y, v.z}, sphere.wi.in(), {alpha.x, alpha.y}, eta,
                            sphere.value.out(), masking);
        Sphere::Stated stated = sphere.stated(kSamples);
        EXPECT_LE(stated.all, 1 + 1e-3);
        EXPECT_LE(stated.energy, 1 + 1e-3);
        for (int w = 0; w < 3; ++w) {
          Samples sample(kSamples);
          sample_dielectric(kWarps[w], kSamples, {v.x, v.y, v.z}, {alpha.x, alpha.y}, eta, u.in(), sample.dielectric(),
                            masking);
          Sphere::Found found = Sphere::found(sample);
          double p = p_value(found.counts, stated.expected);
          least = std::min(least, p);
          EXPECT_GE(p, least_p_value(tests)) << kWarpNames[w] << " " << v.z << " alpha " << alpha.x << " eta " << eta;
          EXPECT_NEAR(found.weight, stated.energy, 4.7 * found.sigma + 1e-3);
        }
        std::printf(
            "cos %5.2f, alpha %.1f, %.1f, eta %.2f: %.1f %% of the energy leaves, %.1f %% of samples are lost\n", v.z,
            alpha.x, alpha.y, eta, 100 * stated.energy, 100 * (1 - stated.all));
      }
  std::printf("least p of %g tests: %.3g\n", tests, least);
}

// Seen smooth, the surface splits light as Fresnel says and keeps all of it.
TEST(Dielectric, SmoothLimit) {
  constexpr std::size_t kCount = 1 << 18;
  Numbers u(kCount, 45);
  for (const View& v : kViews)
    for (float eta : kEtas) {
      Samples sample(kCount);
      sample_dielectric(Warp::polar, kCount, {v.x, v.y, v.z}, {1e-5f, 1e-5f}, eta, u.in(), sample.dielectric());
      double reflected = 0, weight = 0;
      for (std::size_t i = 0; i < kCount; ++i) {
        reflected += sample.side[i] > 0;
        weight += sample.weight[i];
      }
      double f = fresnel<double>(std::fabs(v.z), v.z < 0 ? 1 / double(eta) : double(eta));
      EXPECT_NEAR(reflected / kCount, f, 5 * std::sqrt(f * (1 - f) / kCount) + 1e-4);
      EXPECT_NEAR(weight / kCount, 1, 1e-4);
    }
}

// f / eta^2 of the side that light comes from is symmetric.
TEST(Dielectric, IsReciprocal) {
  constexpr std::size_t kCount = 1 << 17;
  Directions a(kCount), b(kCount);
  for (std::size_t i = 0; i < kCount; ++i) {
    Random random(46, i);
    for (auto* d : {&a, &b}) {
      double z = random.uniform(0.05, 1), phi = random.uniform(0, 7), s = std::sqrt(1 - z * z);
      d->set(i, Vec3<double>{s * std::cos(phi), s * std::sin(phi), d == &a || random.below(2) ? z : -z});
    }
  }
  double worst = 0;
  std::size_t across = 0;
  for (float eta : kEtas) {
    Values there(kCount), back(kCount);
    evaluate_dielectric(kCount, a.in(), b.in(), {0.5f, 0.3f}, eta, there.out());
    evaluate_dielectric(kCount, b.in(), a.in(), {0.5f, 0.3f}, eta, back.out());
    for (std::size_t i = 0; i < kCount; ++i) {
      bool through = b.z[i] < 0;
      double f = double(there.f_cos[i]) / std::fabs(b.z[i]) / (through ? double(eta) * eta : 1);
      double g = double(back.f_cos[i]) / a.z[i];
      // Straight passage, and cosines near 0, which for the other way is near total reflection: there g^2 is a
      // difference.
      R n = through ? R(eta) : R(1);
      Vec3<R> h = a.at<R>(i) + n * b.at<R>(i);
      R length = std::sqrt(dot(h, h)), c = std::fabs(dot(a.at<R>(i), h)) / length,
        c_i = std::fabs(dot(b.at<R>(i), h)) / length;
      // On the borders of what is possible, that of total reflection among them, rounding decides.
      if (c < 5e-3L || c_i < 5e-3L || std::fabs(h.z) < 1e-4L * length || (f == 0 && g == 0)) continue;
      across += through;
      R root = std::sqrt(std::fabs(R(eta) * eta - 1 + c * c));
      if (root < 5e-3L) continue;
      keep_larger(worst, double(std::fabs(f / g - 1) / kEps * std::fmin(R(1), length) * c * c * c_i * c_i *
                                std::fmin(R(1), root)));
    }
  }
  std::printf("reciprocity within %.1f eps / (|h| (wo.wm wi.wm)^2), %zu pairs across\n", worst, across);
  EXPECT_GT(across, kCount / 4);
  EXPECT_LE(worst, 60);
}

}  // namespace
}  // namespace vndf::shading
