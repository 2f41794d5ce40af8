// Fresnel's equations of dielectrics in long double, of conductors against the amplitudes of complex numbers; frames.
#include <algorithm>
#include <complex>
#include <cstdio>

#include <gtest/gtest.h>

#include <vndf/lanes.h>

#include "reference/errors.h"
#include "reference/random.h"
#include "shading/model.h"

namespace vndf {
namespace {

using reference::Random;
using R = long double;

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
    reference::keep_larger(sum, double(std::fabs(R(f.reflected) + f.transmitted - 1) / conditioning / reference::kEps));
    R s = (c - g) / (c + g), p = (n * n * c - g) / (n * n * c + g);
    R exact = (s * s + p * p) / 2;
    R through = 2 * c * g * (1 / ((c + g) * (c + g)) + n * n / ((n * n * c + g) * (n * n * c + g)));
    // Long double takes the plain differences with 1e-19 / |n - 1| to spare.
    reference::keep_larger(reflected, double(std::fabs(f.reflected / exact - 1) / conditioning / reference::kEps));
    reference::keep_larger(transmitted,
                           double(std::fabs(f.transmitted / through - 1) / conditioning / reference::kEps));
    if (std::fabs(n - 1) > 0.01L) {
      EXPECT_NEAR(double(exact), double(shading::fresnel(c, n)), 1e-12);
    }
  }
  std::printf("Fresnel: reflected %.1f, transmitted %.1f eps times conditioning; their sum is 1 within %.1f\n",
              reflected, transmitted, sum);
  EXPECT_LE(reflected, 16);
  EXPECT_LE(transmitted, 16);
  EXPECT_LE(sum, 16);
}

/// The reflectance by Fresnel's amplitudes, of the refracted wave's complex cosine.
R exact_conductor(R c, R eta, R k) {
  using C = std::complex<R>;
  C n(eta, k), refracted = std::sqrt(C(1) - C(1 - c * c) / (n * n));
  C s = (c - n * refracted) / (c + n * refracted);
  C p = (n * c - refracted) / (n * c + refracted);
  return (std::norm(s) + std::norm(p)) / 2;
}

TEST(Conductor, AgainstComplexAmplitudes) {
  R worst = 0;
  for (std::uint64_t i = 0; i < 1000000; ++i) {
    Random random(71, i);
    float eta = float(random.log_uniform(0.05, 10)), k = float(random.log_uniform(0.1, 15));
    float cos = float(random.below(2) ? random.uniform(0, 1) : random.log_uniform(1e-6, 1));
    R exact = exact_conductor(cos, eta, k);
    worst = std::max(worst, std::fabs(lanes::conductor_reflectance(cos, eta, k) / exact - 1));
  }
  std::printf("conductor: %.1Lf x 2^-24\n", worst * 0x1p24L);
  EXPECT_LE(worst, 40 * 0x1p-24L);
}

// The values that tables of optics print: gold at 652 nm, and glass without absorption, (eta - 1)^2 / (eta + 1)^2.
TEST(Conductor, AtNormalIncidence) {
  EXPECT_NEAR(lanes::conductor_reflectance(1.f, 0.16f, 3.6f), (0.84 * 0.84 + 3.6 * 3.6) / (1.16 * 1.16 + 3.6 * 3.6),
              1e-7);
  EXPECT_NEAR(lanes::conductor_reflectance(1.f, 1.5f, 0.f), 0.04f, 1e-8);
}

TEST(Conductor, IsOneAtTheHorizon) {
  for (float eta : {0.1f, 1.f, 3.f}) {
    EXPECT_EQ(lanes::conductor_reflectance(0.f, eta, 2.f), 1.f);
  }
}

TEST(Schlick, Ends) {
  EXPECT_EQ(lanes::schlick_reflectance(1.f, 0.04f), 0.04f);
  EXPECT_EQ(lanes::schlick_reflectance(0.f, 0.04f), 1.f);
  EXPECT_EQ(lanes::schlick_reflectance(0.5f, 0.f), 1 / 32.f);
}

TEST(Frame, ThereAndBack) {
  // x = (0, 0, 1), y = (1, 0, 0), z = (0, 1, 0).
  lanes::Frame<float> frame{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
  auto local = lanes::to_local({1.f, 2.f, 3.f}, frame);
  EXPECT_EQ(local.x, 3);
  EXPECT_EQ(local.y, 1);
  EXPECT_EQ(local.z, 2);
  auto world = lanes::to_world(local, frame);
  EXPECT_EQ(world.x, 1);
  EXPECT_EQ(world.y, 2);
  EXPECT_EQ(world.z, 3);
}

}  // namespace
}  // namespace vndf
