// The rough dielectric with an ellipsoid NDF, against the formulas of Walter et al. 2007 and 2015, from outside and
// from inside.
//
// Significance: 0.01 for all chi-square tests of the file together, by Sidak's correction; seeds are fixed.
#include <algorithm>
#include <cstdio>

#include <gtest/gtest.h>

#include "ellipsoid/model.h"
#include "reference/errors.h"
#include "shading/sphere.h"
#include "support/bits.h"

namespace vndf::ellipsoid {
namespace {

using reference::keep_larger;
using reference::kEps;
using reference::Random;
using R = long double;

constexpr Parameters kShapes[] = {
    {0.15f, 0.5f, 0, 0, 0.7f},     {0.3f, 0.6f, 0.3f, -0.2f, 0.5f}, {0.8f, 0.2f, 0.5f, 0.4f, -3.f},
    {0.3f, 0.2f, 1.f, -0.8f, 1.f}, {0.01f, 0.03f, 0.2f, 0.1f, 2.f},
};
constexpr std::size_t kRough = 4;  // of these; the last is too sharp for the sphere's grid
constexpr float kEtas[] = {1.5f, 1 / 1.5f, 1.05f, 2.4f};
struct View {
  float x, y, z;
  Columns3 in() const { return {x, y, z}; }
};
constexpr View kViews[] = {{0.f, 0.f, 1.f},
                           {0.6f, -0.36f, 0.71442284f},
                           {-0.8f, 0.5723635f, 0.18f},
                           {0.6f, -0.36f, -0.71442284f},
                           {-0.8f, 0.5723635f, -0.18f}};

/// Eq. 7's sgn(v.n) v.
template <class T>
Vec3<T> turned(const Vec3<T>& v) {
  return v.z < 0 ? T(-1) * v : v;
}

/// View i and light o as the papers have them: neither is mirrored, and each product has the sign that it has.
struct Pair {
  Vec3<R> i, o, h;  // h is unit, of the upper hemisphere
  R eta, n_i, n_o, length;
  bool refracts, possible;

  Pair(const Vec3<R>& wo, const Vec3<R>& wi, R eta_) : i(wo), o(wi), eta(eta_) {
    n_i = i.z < 0 ? eta : 1;
    n_o = o.z < 0 ? eta : 1;
    refracts = (i.z < 0) != (o.z < 0);
    h = refracts ? n_i * i + n_o * o : i + o;  // Walter et al. 2007, eq. 13 and 16
    length = std::sqrt(dot(h, h));
    h = turned((1 / length) * h);
    length /= n_i;
    // What is above sees the normal's front, what is below its back.
    possible = dot(i, h) * i.z > 0 && dot(o, h) * o.z > 0;
  }
  /// g^2, in proportion to the squared cosine of refraction.
  R g2() const {
    R n = i.z < 0 ? 1 / eta : eta, c = dot(i, h);
    return n * n - 1 + c * c;
  }
  /// The share of light that goes this way.
  R share() const {
    R f = fresnel(std::fabs(dot(i, h)), i.z < 0 ? 1 / eta : eta);
    return refracts ? 1 - f : f;
  }
  /// |d h / d o|, eq. 14 and 17.
  R jacobian() const {
    if (!refracts) return 1 / (4 * std::fabs(dot(o, h)));
    R sum = n_i * dot(i, h) + n_o * dot(o, h);
    return n_o * n_o * std::fabs(dot(o, h)) / (sum * sum);
  }
  R pdf(const M3<R>& a) const { return possible ? share() * normal_pdf(turned(i), h, a) * jacobian() : R(0); }
  /// f |o.n|, eq. 20 and 21, with G of Walter et al. 2015, eq. 7.
  R f_cos(const M3<R>& a) const {
    if (!possible) return 0;
    R g = g1(turned(i), a) * g1(turned(o), a);
    if (!refracts) return share() * g * ndf(h, a) / (4 * std::fabs(i.z));
    R ih = dot(i, h), oh = dot(o, h), sum = n_i * ih + n_o * oh;
    return std::fabs(ih) * std::fabs(oh) / std::fabs(i.z) * n_o * n_o * share() * g * ndf(h, a) / (sum * sum);
  }
  /// How much rounding the directions moves the density: wm by 1 / |h|, which D magnifies by 2 / alpha, the cosines by
  /// their own reciprocals, and Fresnel's shares by 1 / g near total reflection.
  R conditioning(const Parameters& p) const {
    R c = std::fabs(dot(i, h) * dot(o, h)), g = std::sqrt(std::fmax(R(1e-12L), std::fabs(g2())));
    return (4 + 2 / R(std::min(p.alpha_x, p.alpha_y))) * (1 + 1 / g) / (std::fmin(R(1), length) * c);
  }
};

/// Directions above and below.
struct Views {
  Directions wo;

  explicit Views(std::size_t count, std::uint64_t seed, double least_cos = 0) : wo(count) {
    for (std::size_t i = 0; i < count; ++i) {
      Random random(seed, i);
      double z = random.below(2) ? random.uniform(least_cos, 1) : random.uniform(-1, -least_cos);
      double phi = random.uniform(0, 2 * kPi<double>), s = std::sqrt(1 - z * z);
      wo.set(i, Vec3<double>{s * std::cos(phi), s * std::sin(phi), z});
    }
  }
};

// theta = 0: the bits of the plain functions with separable masking, however it is given, but for the weights across of
// columns of theta_x, which are eq. 50 in one division.
TEST(Dielectric, IsPlainWithoutAngles) {
  constexpr std::size_t kCount = 1 << 15;
  Directions wo = Views(kCount, 1).wo;
  Numbers u(kCount, 2);
  std::vector<float> alpha_x(kCount), alpha_y(kCount), eta(kCount), zero(kCount);
  for (std::size_t i = 0; i < kCount; ++i) {
    Random random(3, i);
    alpha_x[i] = float(random.log_uniform(1e-3, 1));
    alpha_y[i] = float(random.log_uniform(1e-3, 1));
    eta[i] = float(random.log_uniform(0.4, 2.5));
  }
  Columns2 alpha{alpha_x.data(), alpha_y.data()};
  for (Warp warp : kWarps) {
    Samples plain(kCount), other(kCount);
    Values there(kCount), here(kCount);
    sample_dielectric(warp, kCount, wo.in(), alpha, eta.data(), u.in(), plain.dielectric(), Masking::separable);
    evaluate_dielectric(kCount, wo.in(), plain.wi.in(), alpha, eta.data(), there.out(), Masking::separable);
    const Column none(0.f), zeros(zero.data());
    for (const Ellipsoid& e : {Ellipsoid(alpha), Ellipsoid(alpha, none, none, zeros), Ellipsoid(alpha, zeros)}) {
      double worst = 0;
      auto keep = [&](double a, double b) {
        if (a != b) keep_larger(worst, std::fabs(a / b - 1) / kEps);
      };
      sample_dielectric(warp, kCount, wo.in(), e, eta.data(), u.in(), other.dielectric());
      evaluate_dielectric(kCount, wo.in(), plain.wi.in(), e, eta.data(), here.out());
      auto table = [](const Samples& s, const Values& value) {
        return testing::Table{s.wi.x, s.wi.y, s.wi.z, s.pdf, s.side, value.pdf};
      };
      ASSERT_TRUE(testing::same_bits(table(plain, there), table(other, here)));
      for (std::size_t i = 0; i < kCount; ++i) {
        keep(other.weight[i], plain.weight[i]);
        keep(here.f_cos[i], there.f_cos[i]);
      }
      EXPECT_LE(worst, e.theta_x.data ? 4 : 0);
    }
  }
}

// The papers' formulas in long double, for pairs that are sampled and for any; and what is impossible is 0.
TEST(Dielectric, EvaluatesThePapersFormulas) {
  constexpr std::size_t kCount = 1 << 15;
  Directions wo = Views(kCount, 4, 0.02).wo, any = Views(kCount, 5, 0.02).wo;
  Numbers u(kCount, 6);
  double worst[2][2] = {};
  std::size_t pairs[2][2] = {}, impossible = 0;
  for (const Parameters& p : kShapes)
    for (float eta : kEtas) {
      Samples sample(kCount);
      sample_dielectric(Warp::concentric, kCount, wo.in(), p.ellipsoid(), eta, u.in(), sample.dielectric());
      for (std::size_t i = 0; i < kCount; i += 2) sample.wi.set(i, any.at(i));
      Values value(kCount);
      evaluate_dielectric(kCount, wo.in(), sample.wi.in(), p.ellipsoid(), eta, value.out());
      M3<R> a = matrix<R>(p);
      for (std::size_t i = 0; i < kCount; ++i) {
        Pair pair(wo.at<R>(i), sample.wi.at<R>(i), eta);
        // On the borders of what is possible rounding decides.
        R border = std::min({std::fabs(dot(pair.i, pair.h)), std::fabs(dot(pair.o, pair.h)), std::fabs(pair.h.z),
                             std::fabs(pair.o.z), std::fabs(pair.g2()), pair.length});
        if (border < 1e-4L) continue;
        R pdf = pair.pdf(a), f_cos = pair.f_cos(a), scale = pair.conditioning(p) * kEps;
        if (!(pdf > 1e-20L)) {
          ASSERT_LE(value.pdf[i], 1e-19f) << i;
          ASSERT_LE(value.f_cos[i], 1e-19f) << i;
          ++impossible;
          continue;
        }
        bool below = pair.i.z < 0;
        for (R ratio : {value.pdf[i] / pdf, value.f_cos[i] / f_cos})
          keep_larger(worst[below][pair.refracts], double(std::fabs(ratio - 1) / scale));
        ++pairs[below][pair.refracts];
      }
    }
  for (bool below : {false, true})
    for (bool refracts : {false, true}) {
      std::printf("%s, %s: within %.2f eps of the formulas, times conditioning, %zu pairs\n", below ? "below" : "above",
                  refracts ? "refracted" : "reflected", worst[below][refracts], pairs[below][refracts]);
      EXPECT_LE(worst[below][refracts], 4);
      EXPECT_GT(pairs[below][refracts], kCount / 4);
    }
  EXPECT_GT(impossible, kCount / 4);
}

// A Shape of a general matrix, by the same formulas.
TEST(Dielectric, TakesShapesOfMatrices) {
  constexpr std::size_t kCount = 1 << 12;
  const float rows[9] = {0.4f, 0.1f, 0.3f, -0.2f, 0.5f, -0.1f, 0.05f, 0.1f, 1.2f};
  M3<R> a{{rows[0], rows[3], rows[6]}, {rows[1], rows[4], rows[7]}, {rows[2], rows[5], rows[8]}};
  Shape shape;
  ASSERT_EQ(make_shape(rows, shape), ShapeError::none);
  Directions wo = Views(kCount, 7, 0.1).wo;
  Numbers u(kCount, 8);
  for (Warp warp : kWarps) {
    Samples sample(kCount);
    Values value(kCount);
    sample_dielectric(warp, kCount, wo.in(), shape, 1.5f, u.in(), sample.dielectric());
    evaluate_dielectric(kCount, wo.in(), sample.wi.in(), shape, 1.5f, value.out());
    std::size_t compared = 0;
    for (std::size_t i = 0; i < kCount; ++i) {
      Pair pair(wo.at<R>(i), sample.wi.at<R>(i), 1.5L);
      if (sample.pdf[i] <= 0 || std::fabs(dot(pair.i, pair.h)) < 0.1L || std::fabs(pair.g2()) < 0.01L) continue;
      ++compared;
      ASSERT_NEAR(value.pdf[i] / pair.pdf(a), 1, 1e-4) << i;
      ASSERT_NEAR(value.f_cos[i] / pair.f_cos(a), 1, 1e-4) << i;
      ASSERT_NEAR(sample.pdf[i] / pair.pdf(a), 1, 1e-3) << i;
      ASSERT_NEAR(sample.weight[i] * pair.pdf(a) / pair.f_cos(a), 1, 1e-3) << i;
    }
    EXPECT_GT(compared, kCount / 2);
  }
}

// sample's density is evaluate's, its weight the quotient of f cos and it, at most 1; what comes out at the wrong side
// counts nothing.
TEST(Dielectric, SampleAgreesWithEvaluate) {
  constexpr std::size_t kCount = 1 << 15;
  Numbers u(kCount, 9);
  double worst = 0, worst_weight = 0;
  for (const View& v : kViews)
    for (float eta : kEtas)
      for (const Parameters& p : kShapes)
        for (Warp warp : kWarps) {
          Samples sample(kCount);
          Values value(kCount);
          sample_dielectric(warp, kCount, v.in(), p.ellipsoid(), eta, u.in(), sample.dielectric());
          evaluate_dielectric(kCount, v.in(), sample.wi.in(), p.ellipsoid(), eta, value.out());
          for (std::size_t i = 0; i < kCount; ++i) {
            ASSERT_EQ(std::fabs(sample.side[i]), 1);
            ASSERT_GE(sample.weight[i], 0);
            ASSERT_LE(sample.weight[i], 1);
            if ((sample.wi.z[i] * v.z > 0) != (sample.side[i] > 0)) {
              ASSERT_EQ(sample.pdf[i], 0);
              ASSERT_EQ(sample.weight[i], 0);
            }
            if (sample.pdf[i] <= 0) continue;
            Pair pair({v.x, v.y, v.z}, sample.wi.at<R>(i), eta);
            // The normals of the cap lose digits where they are nearly perpendicular to the view.
            if (warp == Warp::spherical_cap && std::fabs(dot(pair.i, pair.h)) < 0.05L) continue;
            double scale = double(pair.conditioning(p)) * kEps;
            keep_larger(worst, std::fabs(double(sample.pdf[i]) / value.pdf[i] - 1) / scale);
            keep_larger(worst_weight,
                        std::fabs(double(value.f_cos[i]) / (double(sample.weight[i]) * value.pdf[i]) - 1) / kEps);
          }
        }
  std::printf("densities agree within %.2f eps times conditioning, weights within %.1f eps\n", worst, worst_weight);
  EXPECT_LE(worst, 16);
  EXPECT_LE(worst_weight, 24);  // a sample's weight takes A wi with A as floats
}

// wi on both sides, and the share that is lost, against the density that evaluate_dielectric states; and the mean
// weight against the integral of f cos.
TEST(Dielectric, HasTheDensityAndTheEnergyThatItStates) {
  constexpr std::size_t kSamples = std::size_t(1) << 18;
  Numbers u(kSamples, 10);
  Sphere sphere;
  double tests = double(std::size(kViews) * kRough * 2 * 3), least = 1;
  for (const View& v : kViews)
    for (std::size_t shape = 0; shape < kRough; ++shape)
      for (float eta : {1.5f, 1 / 2.4f}) {
        const Parameters& p = kShapes[shape];
        evaluate_dielectric(Sphere::kCount, v.in(), sphere.wi.in(), p.ellipsoid(), eta, sphere.value.out());
        Sphere::Stated stated = sphere.stated(kSamples);
        EXPECT_LE(stated.all, 1 + 1e-3);
        EXPECT_LE(stated.energy, 1 + 1e-3);
        for (int w = 0; w < 3; ++w) {
          Samples sample(kSamples);
          sample_dielectric(kWarps[w], kSamples, v.in(), p.ellipsoid(), eta, u.in(), sample.dielectric());
          Sphere::Found found = Sphere::found(sample);
          double probability = p_value(found.counts, stated.expected);
          least = std::min(least, probability);
          EXPECT_GE(probability, least_p_value(tests)) << kWarpNames[w] << " " << v.z << " eta " << eta;
          EXPECT_NEAR(found.weight, stated.energy, 4.7 * found.sigma + 1e-3);
        }
        std::printf(
            "cos %5.2f, alpha %.2f %.2f theta %.1f %.1f, eta %.2f: %.1f %% of the energy leaves, %.1f %% lost\n", v.z,
            p.alpha_x, p.alpha_y, p.theta_x, p.theta_y, eta, 100 * stated.energy, 100 * (1 - stated.all));
      }
  std::printf("least p of %g tests: %.3g\n", tests, least);
}

// Eq. 7: masking is that of directions turned to the upper hemisphere. The weight of a direction across is the one that
// reflection has for its mirror image in the origin, not in the surface; a view from below is its mirror image in the
// origin with the indices exchanged, but for rounding: the normal of a pair is summed for the lower direction's side,
// so that the pair exchanged has the same.
TEST(Dielectric, MaskingOfTurnedDirections) {
  constexpr std::size_t kCount = 1 << 14;
  Directions wo = Views(kCount, 11, 0.02).wo;
  Numbers u(kCount, 12);
  double worst = 0;
  std::size_t across = 0, tell_apart = 0;
  auto mirrored = [](const Vec3<double>& v) { return -1. * v; };
  for (const Parameters& p : kShapes) {
    Samples sample(kCount);
    Values value(kCount), other(kCount), upper(kCount), reflected(kCount);
    Directions wo_2(kCount), wi_2(kCount), wo_up(kCount), wi_up(kCount), wi_flat(kCount);
    sample_dielectric(Warp::polar, kCount, wo.in(), p.ellipsoid(), 2.f, u.in(), sample.dielectric());
    for (std::size_t i = 0; i < kCount; ++i) {
      Vec3<double> wi = sample.wi.at(i);
      wo_2.set(i, mirrored(wo.at(i)));
      wi_2.set(i, mirrored(wi));
      wo_up.set(i, turned(wo.at(i)));
      wi_up.set(i, turned(wi));
      wi_flat.set(i, Vec3<double>{wi.x, wi.y, std::fabs(wi.z)});
    }
    evaluate_dielectric(kCount, wo.in(), sample.wi.in(), p.ellipsoid(), 2.f, value.out());
    evaluate_dielectric(kCount, wo_2.in(), wi_2.in(), p.ellipsoid(), 0.5f, other.out());
    evaluate_reflection(kCount, wo_up.in(), wi_up.in(), p.ellipsoid(), upper.out());
    evaluate_reflection(kCount, wo_up.in(), wi_flat.in(), p.ellipsoid(), reflected.out());
    for (std::size_t i = 0; i < kCount; ++i) {
      ASSERT_NEAR(value.f_cos[i], other.f_cos[i], 1e-3 * value.f_cos[i]) << i;
      ASSERT_NEAR(value.pdf[i], other.pdf[i], 1e-3 * value.pdf[i]) << i;
      if (!(value.pdf[i] > 0) || sample.side[i] > 0) continue;
      ++across;
      double weight = double(value.f_cos[i]) / value.pdf[i], exact = double(upper.f_cos[i]) / upper.pdf[i];
      keep_larger(worst, std::fabs(weight / exact - 1) / kEps);
      tell_apart += std::fabs(double(reflected.f_cos[i]) / reflected.pdf[i] / exact - 1) > 0.01;
    }
  }
  std::printf("weights across within %.1f eps of those of reflection; %zu of %zu pairs tell mirror images apart\n",
              worst, tell_apart, across);
  EXPECT_LE(worst, 8);
  EXPECT_GT(across, kCount);
  EXPECT_GT(tell_apart, across / 4);
}

// f / eta^2 of the side that light comes from is symmetric, for reflection and across.
TEST(Dielectric, IsReciprocal) {
  constexpr std::size_t kCount = 1 << 16;
  Directions a = Views(kCount, 13, 0.05).wo, b = Views(kCount, 14, 0.05).wo;
  double worst[2] = {};
  std::size_t pairs[2] = {};
  for (const Parameters& p : kShapes)
    for (float eta : kEtas) {
      Values there(kCount), back(kCount);
      evaluate_dielectric(kCount, a.in(), b.in(), p.ellipsoid(), eta, there.out());
      evaluate_dielectric(kCount, b.in(), a.in(), p.ellipsoid(), eta, back.out());
      for (std::size_t i = 0; i < kCount; ++i) {
        Pair pair(a.at<R>(i), b.at<R>(i), eta), reverse(b.at<R>(i), a.at<R>(i), eta);
        R border = std::min({std::fabs(dot(pair.i, pair.h)), std::fabs(dot(pair.o, pair.h)), std::fabs(pair.h.z),
                             std::fabs(pair.g2()), std::fabs(reverse.g2())});
        if (!pair.possible || border < 1e-3L) continue;
        R f = there.f_cos[i] / std::fabs(pair.o.z) / (pair.n_o * pair.n_o);
        R g = back.f_cos[i] / std::fabs(pair.i.z) / (pair.n_i * pair.n_i);
        if (f == 0 && g == 0) continue;
        R scale = std::fmax(pair.conditioning(p), reverse.conditioning(p)) * kEps;
        keep_larger(worst[pair.refracts], double(std::fabs(f / g - 1) / scale));
        ++pairs[pair.refracts];
      }
    }
  std::printf("reciprocity within %.2f eps times conditioning reflected, %.2f across; %zu and %zu pairs\n", worst[0],
              worst[1], pairs[0], pairs[1]);
  for (int k : {0, 1}) {
    EXPECT_LE(worst[k], 4);
    EXPECT_GT(pairs[k], kCount / 4);
  }
}

// eta = 1: there is no surface, and light goes straight on, all of it.
TEST(Dielectric, EqualIndices) {
  constexpr std::size_t kCount = 1 << 12;
  Directions wo = Views(kCount, 15).wo;
  Numbers u(kCount, 16);
  for (const Parameters& p : kShapes) {
    Samples sample(kCount);
    sample_dielectric(Warp::polar, kCount, wo.in(), p.ellipsoid(), 1.f, u.in(), sample.dielectric());
    for (std::size_t i = 0; i < kCount; ++i) {
      ASSERT_EQ(sample.side[i], -1);
      ASSERT_EQ(sample.wi.x[i], -wo.x[i]);
      ASSERT_EQ(sample.wi.y[i], -wo.y[i]);
      ASSERT_EQ(sample.wi.z[i], -wo.z[i]);
      ASSERT_EQ(sample.weight[i], 1) << i;
      ASSERT_EQ(sample.pdf[i], 0x1p60f) << i;
    }
  }
}

// Bad numbers of any kind stay in their lanes.
TEST(Dielectric, BadInputsDisturbNoOtherLane) {
  constexpr std::size_t kCount = 1 << 12;
  const float bad[] = {NAN, INFINITY, -INFINITY, 0.f, -0.f, -1.5f, 1e-40f, 3e38f};
  Directions wo = Views(kCount, 17).wo, wi = Views(kCount, 18).wo;
  Numbers u(kCount, 19);
  std::vector<std::vector<float>> good = {wo.x, wo.y, wo.z, wi.x, wi.y, wi.z, u.a, u.b, u.c};
  for (int c = 0; c < 6; ++c) good.emplace_back(kCount);  // alpha, theta, eta
  for (std::size_t i = 0; i < kCount; ++i) {
    Random random(20, i);
    for (std::size_t c : {9, 10}) good[c][i] = float(random.log_uniform(0.01, 1));
    for (std::size_t c : {11, 12, 13}) good[c][i] = float(random.uniform(-0.5, 0.5));
    good[14][i] = float(random.log_uniform(0.4, 2.5));
  }
  auto run = [&](const std::vector<std::vector<float>>& t, bool tilted, Samples& s, Values& v) {
    auto in = [&](std::size_t c) { return Column(t[c].data()); };
    Ellipsoid e({in(9), in(10)}, tilted ? in(11) : 0.f, tilted ? in(12) : 0.f, in(13));
    sample_dielectric(Warp::concentric, kCount, {in(0), in(1), in(2)}, e, in(14), {in(6), in(7), in(8)},
                      s.dielectric());
    evaluate_dielectric(kCount, {in(0), in(1), in(2)}, {in(3), in(4), in(5)}, e, in(14), v.out());
  };
  for (bool tilted : {false, true}) {
    Samples expected(kCount), sample(kCount);
    Values expected_value(kCount), value(kCount);
    run(good, tilted, expected, expected_value);
    auto mixed = good;
    for (std::size_t i = 0; i < kCount; ++i) {
      Random random(21, i);
      if (i % 3 != 0) mixed[random.below(15)][i] = bad[random.below(std::size(bad))];
    }
    run(mixed, tilted, sample, value);
    for (std::size_t i = 0; i < kCount; i += 3) {
      ASSERT_EQ(expected.wi.x[i], sample.wi.x[i]);
      ASSERT_EQ(expected.wi.y[i], sample.wi.y[i]);
      ASSERT_EQ(expected.wi.z[i], sample.wi.z[i]);
      ASSERT_EQ(expected.pdf[i], sample.pdf[i]);
      ASSERT_EQ(expected.weight[i], sample.weight[i]);
      ASSERT_EQ(expected.side[i], sample.side[i]);
      ASSERT_EQ(expected_value.f_cos[i], value.f_cos[i]);
      ASSERT_EQ(expected_value.pdf[i], value.pdf[i]);
    }
  }
}

}  // namespace
}  // namespace vndf::ellipsoid
