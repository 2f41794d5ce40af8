// The options of the shading step, against the papers' formulas: masking across a surface, radiance, the probability of
// the lobes, surfaces with two sides; and the outputs that may be left out.
#include <gtest/gtest.h>

#include <vndf/ellipsoid.h>
#include <vndf/lanes/beta.h>

#include "shading/grids.h"
#include "shading/inputs.h"

namespace vndf::shading {
namespace {

using reference::Random;
using R = long double;
constexpr R kEps = 0x1p-24L;
constexpr std::size_t kCount = 1 << 16;
constexpr AcrossMasking kAcross[] = {AcrossMasking::separable, AcrossMasking::as_reflection,
                                     AcrossMasking::height_correlated};

/// x B(x, y) with the logarithms of the gamma function.
R exact_x_beta(R x, R y) {
  return std::exp(std::log(x) + std::lgamma(x) + std::lgamma(y) - std::lgamma(x + y));
}

/// G2 / G1(wo) across the surface.
R exact_weight(AcrossMasking across, R lambda_o, R lambda_i) {
  if (across == AcrossMasking::separable) return 1 / (1 + lambda_i);
  if (across == AcrossMasking::as_reflection) return (1 + lambda_o) / (1 + lambda_o + lambda_i);
  return exact_x_beta(1 + lambda_o, 1 + lambda_i);
}

TEST(Beta, AgainstLogarithmsOfGamma) {
  R worst = 0, worst_small = 0;
  for (std::uint64_t i = 0; i < 1 << 20; ++i) {
    Random random(81, i);
    auto any = [&] { return float(random.log_uniform(1e-4, random.below(2) ? 10 : 1e5)); };
    float a = any(), b = random.below(4) ? any() : a;
    R exact = exact_x_beta(1 + R(a), 1 + R(b));
    if (exact < 1e-30L) continue;
    R error = std::fabs(lanes::x_beta(a, b) / exact - 1) / kEps;
    worst = std::max(worst, error / (1 - std::log(exact)));
    if (exact > 0.01L) worst_small = std::max(worst_small, error);
  }
  std::printf("x B(x, y): %.1Lf eps above 0.01, %.1Lf eps (1 - ln(x B)) above 1e-30\n", worst_small, worst);
  EXPECT_LE(worst_small, 45);
  EXPECT_LE(worst, 30);
}

// 1 + Lambda(wi) = 1 masks nothing, and B(2, 2) = 1 / 6, B(1, 3) = 1 / 3, B(3, 1) = 1 / 3.
TEST(Beta, OfWholeNumbers) {
  for (float a : {0.f, 1e-3f, 1.f, 1e6f, 1e18f}) EXPECT_NEAR(lanes::x_beta(a, 0.f), 1, 1e-6);
  EXPECT_NEAR(lanes::x_beta(1.f, 1.f), 2 / 6., 1e-6);
  EXPECT_NEAR(lanes::x_beta(0.f, 2.f), 1 / 3., 1e-6);
  EXPECT_NEAR(lanes::x_beta(2.f, 1.f), 3 * 1 / 12., 1e-6);  // B(3, 2)
}

TEST(Beta, IsNeverNothing) {
  for (float a = 0x1p-10f; a <= 0x1p60f; a *= 2)
    for (float b = 0x1p-10f; b <= 0x1p60f; b *= 2) ASSERT_GE(lanes::x_beta(a, b), 0x1p-118f) << a << " " << b;
}

/// Views and alpha as renderers have them, and eta.
struct Scene {
  Directions wo{kCount};
  std::vector<float> alpha_x = std::vector<float>(kCount), alpha_y = alpha_x, eta = alpha_x, probability = alpha_x;
  Numbers u{kCount, 82};

  explicit Scene(bool above = false) {
    for (std::size_t i = 0; i < kCount; ++i) {
      Random random(83, i);
      double z = random.uniform(0.02, 1), phi = random.uniform(0, 7), s = std::sqrt(1 - z * z);
      wo.set(i, Vec3<double>{s * std::cos(phi), s * std::sin(phi), above || random.below(2) ? z : -z});
      alpha_x[i] = float(random.uniform(0.02, 1));
      alpha_y[i] = float(random.uniform(0.02, 1));
      eta[i] = float(random.below(2) ? random.uniform(1.02, 2.5) : random.uniform(0.4, 0.98));
      probability[i] = float(random.uniform(0.05, 0.95));
    }
  }
  Columns2 alpha() const { return {alpha_x.data(), alpha_y.data()}; }
  void sample(const DielectricSamples& out, const DielectricOptions& options, Warp warp = Warp::concentric) const {
    sample_dielectric(warp, kCount, wo.in(), alpha(), eta.data(), u.in(), out, options);
  }
  void evaluate(const Directions& wi, const Evaluations& out, const DielectricOptions& options) const {
    evaluate_dielectric(kCount, wo.in(), wi.in(), alpha(), eta.data(), out, options);
  }
  R lambda_of(const Directions& v, std::size_t i) const {
    return lambda(v.at<R>(i), Alpha<R>{R(alpha_x[i]), R(alpha_y[i])});
  }
  /// The index on the other side over the one on the view's.
  R seen(std::size_t i) const { return wo.z[i] < 0 ? 1 / R(eta[i]) : R(eta[i]); }
};

TEST(Options, MaskingAcrossTheSurface) {
  const Scene scene;
  for (AcrossMasking across : kAcross) {
    DielectricOptions options;
    options.across = across;
    Samples sample(kCount);
    Values value(kCount);
    scene.sample(sample.dielectric(), options);
    scene.evaluate(sample.wi, value.out(), options);
    R worst = 0, worst_f = 0;
    std::size_t refracted = 0;
    for (std::size_t i = 0; i < kCount; ++i) {
      if (sample.side[i] > 0 || sample.pdf[i] == 0) continue;
      ++refracted;
      R exact = exact_weight(across, scene.lambda_of(scene.wo, i), scene.lambda_of(sample.wi, i));
      if (exact < 1e-30L) continue;
      R scale = (1 - std::log(exact)) / std::min(R(1), std::fabs(R(sample.wi.z[i])) * 64);  // Lambda has 1 / wi.z
      worst = std::max(worst, std::fabs(sample.weight[i] / exact - 1) / scale / kEps);
      worst_f = std::max(worst_f, std::fabs(value.f_cos[i] / R(value.pdf[i]) / exact - 1) / scale / kEps);
    }
    std::printf("across %d: weight %.1Lf, f cos / pdf %.1Lf eps (1 - ln weight)\n", int(across), worst, worst_f);
    EXPECT_GT(refracted, kCount / 3);
    EXPECT_LE(worst, 30);
    EXPECT_LE(worst_f, 30);
  }
}

// How far renderers are apart: the shares of light at 85 degrees that pass, as vndf.h states them.
TEST(Options, TransmittanceAtGrazingAngles) {
  constexpr std::size_t kMany = 1 << 20;
  const double expected[] = {0.608, 0.754, 0.451};
  Numbers u(kMany, 84);
  Samples sample(kMany);
  const double angle = 85 * kPi<double> / 180;
  for (AcrossMasking across : kAcross) {
    DielectricOptions options;
    options.across = across;
    sample_dielectric(Warp::concentric, kMany, {std::sin(angle), 0, std::cos(angle)}, {0.5, 0.5}, 1.5, u.in(),
                      sample.dielectric(), options);
    double passed = 0;
    for (std::size_t i = 0; i < kMany; ++i)
      if (sample.side[i] < 0) passed += sample.weight[i] / double(kMany);
    EXPECT_NEAR(passed, expected[int(across)], 0.002);  // sigma is below 0.0005
  }
}

TEST(Options, RadianceHasTheSquareOfTheIndex) {
  const Scene scene;
  Samples energy(kCount), radiance(kCount);
  Values f(kCount), f_radiance(kCount);
  DielectricOptions options;
  scene.sample(energy.dielectric(), options);
  scene.evaluate(energy.wi, f.out(), options);
  options.radiance = true;
  scene.sample(radiance.dielectric(), options);
  scene.evaluate(energy.wi, f_radiance.out(), options);
  for (std::size_t i = 0; i < kCount; ++i) {
    R across = 1 / (scene.seen(i) * scene.seen(i)), factor = energy.side[i] > 0 ? 1 : across;
    bool wi_across = energy.wi.z[i] * scene.wo.z[i] < 0;  // also where a reflection went wrong
    ASSERT_NEAR(double(radiance.weight[i]), double(energy.weight[i] * factor), double(8 * kEps * radiance.weight[i]));
    ASSERT_NEAR(double(f_radiance.f_cos[i]), double(f.f_cos[i] * (wi_across ? across : 1)),
                double(8 * kEps * f_radiance.f_cos[i]));
    ASSERT_EQ(radiance.pdf[i], energy.pdf[i]);
    ASSERT_EQ(f_radiance.pdf[i], f.pdf[i]);
    ASSERT_EQ(radiance.wi.x[i], energy.wi.x[i]);
  }
}

// f = pdf weight is the surface's, however the lobe was chosen.
TEST(Options, ProbabilityOfReflection) {
  const Scene scene;
  Samples sample(kCount);
  Values value(kCount), by_fresnel(kCount);
  std::vector<float> reflectance(kCount);
  DielectricOptions options;
  options.reflection_probability = scene.probability.data();
  auto out = sample.dielectric();
  out.reflectance = reflectance.data();
  scene.sample(out, options);
  scene.evaluate(sample.wi, value.out(), options);
  scene.evaluate(sample.wi, by_fresnel.out(), {});
  std::size_t seen[2] = {};
  for (std::size_t i = 0; i < kCount; ++i) {
    bool reflects = sample.side[i] > 0;
    ASSERT_EQ(reflects, scene.u.c[i] < scene.probability[i]);
    ASSERT_EQ(value.f_cos[i], by_fresnel.f_cos[i]);
    if (sample.pdf[i] == 0 || by_fresnel.pdf[i] == 0) continue;
    // Away from total reflection and from where the rounding of wi moves its normal.
    R f = reflectance[i], share = reflects ? f : 1 - f, p = scene.probability[i];
    if (share < 0.01L || std::fabs(scene.seen(i) - 1) < 0.2L) continue;
    ++seen[reflects];
    R chosen = reflects ? p : 1 - p;
    ASSERT_NEAR(double(value.pdf[i] / R(by_fresnel.pdf[i]) * share / chosen), 1, 2e-2);
    ASSERT_NEAR(double(R(sample.pdf[i]) / value.pdf[i]), 1, 2e-2);
    ASSERT_NEAR(double(R(sample.pdf[i]) * sample.weight[i] / value.f_cos[i]), 1, 2e-2);
  }
  EXPECT_GT(seen[0], kCount / 8);
  EXPECT_GT(seen[1], kCount / 8);
}

TEST(Options, OneLobeAlone) {
  Scene scene;
  scene.u.c[0] = 1;  // the random number included
  for (float probability : {0.f, 1.f}) {
    Samples sample(kCount);
    Values value(kCount);
    DielectricOptions options;
    options.reflection_probability = probability;
    scene.sample(sample.dielectric(), options);
    scene.evaluate(sample.wi, value.out(), options);
    for (std::size_t i = 0; i < kCount; ++i) {
      ASSERT_EQ(sample.side[i], probability == 1 ? 1 : -1);
      ASSERT_LE(sample.weight[i], 1);  // Fresnel's share is in it
    }
    // Of the other lobe there is light, and no density.
    scene.evaluate(scene.wo, value.out(), options);
    for (std::size_t i = 0; i < kCount; ++i) {
      if (std::fabs(scene.wo.z[i]) < 0.1) continue;
      ASSERT_GT(value.f_cos[i], 0);
      ASSERT_EQ(value.pdf[i] > 0, probability == 1);
    }
  }
}

// Samples have the density that is stated, and their mean weight is the integral of f cos.
TEST(Options, HaveTheDensityAndTheEnergyThatTheyState) {
  constexpr std::size_t kSamples = std::size_t(1) << 18;
  constexpr double kTests = 4;
  Numbers u(kSamples, 85);
  Sphere sphere;
  Samples sample(kSamples);
  const Vec3<double> v = unit(Vec3<double>{0.5, 0.3, 0.6});
  for (float probability : {0.5f, 0.f, 1.f, -1.f}) {
    DielectricOptions options;
    options.across = AcrossMasking::height_correlated;
    options.radiance = true;
    if (probability >= 0) options.reflection_probability = probability;
    evaluate_dielectric(Sphere::kCount, {v.x, v.y, v.z}, sphere.wi.in(), {0.5, 0.3}, 1.5, sphere.value.out(), options);
    Sphere::Stated stated = sphere.stated(kSamples);
    sample_dielectric(Warp::concentric, kSamples, {v.x, v.y, v.z}, {0.5, 0.3}, 1.5, u.in(), sample.dielectric(),
                      options);
    Sphere::Found found = Sphere::found(sample);
    EXPECT_GE(p_value(found.counts, stated.expected), least_p_value(kTests)) << probability;
    if (probability != 0 && probability != 1) {  // one lobe alone has only its own energy
      EXPECT_NEAR(found.weight, stated.energy, 4.7 * found.sigma + 1e-3) << probability;
    }
  }
}

TEST(Options, OutputsOfTheDielectric) {
  const Scene scene;
  Samples sample(kCount);
  std::vector<float> wi_dot_wm(kCount), reflectance(kCount);
  auto out = sample.dielectric();
  out.wm = sample.wm.out();
  out.wo_dot_wm = sample.cos.data();
  out.wi_dot_wm = wi_dot_wm.data();
  out.reflectance = reflectance.data();
  scene.sample(out, {});
  for (std::size_t i = 0; i < kCount; ++i) {
    Vec3<R> wo = scene.wo.at<R>(i), wm = sample.wm.at<R>(i), wi = sample.wi.at<R>(i);
    R c = dot(wo, wm);
    ASSERT_NEAR(double(dot(wm, wm)), 1, 1e-6);
    ASSERT_TRUE(wm.z * wo.z >= 0);
    ASSERT_NEAR(sample.cos[i], double(c), 1e-6);
    ASSERT_GE(sample.cos[i], 0);
    ASSERT_LE(sample.cos[i], 1);
    ASSERT_NEAR(wi_dot_wm[i], double(dot(wi, wm)), 2e-6);
    ASSERT_EQ(wi_dot_wm[i] > 0, sample.side[i] > 0);
    // Total reflection begins like a root, and near 0 cosines count for themselves.
    R total = std::fabs(scene.seen(i) * scene.seen(i) - 1 + c * c), steep = 4 / std::sqrt(std::max(total, R(1e-9L)));
    ASSERT_NEAR(reflectance[i], double(fresnel(c, scene.seen(i))), double(20 * kEps * (1 + steep)));
  }
}

TEST(Options, CosineOfAnEvaluatedPair) {
  const Scene scene(true);
  Directions wi(kCount);
  for (std::size_t i = 0; i < kCount; ++i) wi.set(i, unit(scene.wo.at((i * 7919) % kCount)));
  Values value(kCount);
  std::vector<float> cos(kCount);
  for (bool bounded : {false, true}) {
    evaluate_reflection(kCount, scene.wo.in(), wi.in(), scene.alpha(),
                        {value.f_cos.data(), value.pdf.data(), cos.data()}, {Masking::height_correlated, bounded});
    for (std::size_t i = 0; i < kCount; ++i) {
      Vec3<R> h = scene.wo.at<R>(i) + wi.at<R>(i);
      ASSERT_NEAR(cos[i], double(std::sqrt(dot(h, h)) / 2), double(4 * kEps * cos[i]));
      ASSERT_LE(cos[i], 1);
    }
  }
}

/// What a two-sided call gives for a view from below is what the view from above gets, mirrored.
template <class Sample, class Evaluate>
void expect_mirrored(const Scene& scene, Sample sample, Evaluate evaluate) {
  Directions below = scene.wo;
  for (float& z : below.z) z = -z;
  const ReflectionOptions two_sided{Masking::height_correlated, false, true};
  Samples up(kCount), down(kCount), one_sided(kCount);
  Values f_up(kCount), f_down(kCount);
  sample(scene.wo.in(), up.with_normals(), two_sided);
  sample(scene.wo.in(), one_sided.with_normals(), ReflectionOptions());
  sample(below.in(), down.with_normals(), two_sided);
  evaluate(scene.wo.in(), up.wi.in(), f_up.out(), two_sided);
  evaluate(below.in(), down.wi.in(), f_down.out(), two_sided);
  std::size_t lit = 0;
  for (std::size_t i = 0; i < kCount; ++i) {
    ASSERT_EQ(up.wi.z[i], one_sided.wi.z[i]);
    ASSERT_EQ(up.pdf[i], one_sided.pdf[i]);
    ASSERT_EQ(down.wi.x[i], up.wi.x[i]);
    ASSERT_EQ(down.wi.y[i], up.wi.y[i]);
    ASSERT_EQ(down.wi.z[i], -up.wi.z[i]);
    ASSERT_EQ(down.wm.z[i], -up.wm.z[i]);
    ASSERT_EQ(down.pdf[i], up.pdf[i]);
    ASSERT_EQ(down.weight[i], up.weight[i]);
    ASSERT_EQ(down.cos[i], up.cos[i]);
    ASSERT_EQ(f_down.f_cos[i], f_up.f_cos[i]);
    ASSERT_EQ(f_down.pdf[i], f_up.pdf[i]);
    lit += down.pdf[i] > 0;
  }
  EXPECT_GT(lit, kCount / 2);
}
TEST(Options, TwoSided) {
  const Scene scene(true);
  auto over = [&](const auto& surface) {
    expect_mirrored(
        scene,
        [&](const Columns3& wo, const ReflectionSamples& out, const ReflectionOptions& options) {
          sample_reflection(Warp::concentric, kCount, wo, surface, {scene.u.a.data(), scene.u.b.data()}, out, options);
        },
        [&](const Columns3& wo, const Columns3& wi, const Evaluations& out, const ReflectionOptions& options) {
          evaluate_reflection(kCount, wo, wi, surface, out, options);
        });
  };
  over(scene.alpha());
  over(Ellipsoid(scene.alpha(), 0, 0, 0.3));
  over(Ellipsoid(scene.alpha(), 0.1, -0.2, 0.3));
}

}  // namespace
}  // namespace vndf::shading
