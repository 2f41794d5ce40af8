// The accuracy of the shading step, one test per hard case and warp: inputs, oracle, bound.
//
// The oracle takes the normal of the papers' listings in quadruple precision and from there on their plain formulas in
// long double. Errors are in eps = 2^-24, and relative but for directions. What conditioning does to a relative error
// is divided out, and stated where it is.
#include <algorithm>
#include <cstdio>

#include <gtest/gtest.h>

#include "reference/errors.h"
#include "shading/inputs.h"

namespace vndf::shading {
namespace {

using reference::HardCase;
using reference::keep_larger;
using reference::kEps;
using R = long double;

constexpr std::size_t kSamples = std::size_t(1) << 15;

struct Errors {
  double wi = 0;    // Euclidean
  double wi_z = 0;  // over wo.z + 2 (wo.wm) wm.z, the terms of wi.z
  double cos = 0;   // wo.wm, absolute
  double pdf = 0;   // over 1 + max(alpha) |A^-1 wm|, what D makes of an error of Nh
  double pdf_p999 = 0;
  double weight = 0;         // over what the weight makes of the error of wi.z
  double agreement = 0;      // sample's pdf and evaluate's, over (4 + 2 / alpha) / (wo.wm)
  double evaluated_pdf = 0;  // of evaluate, for the wi it is given
  double evaluated_f = 0;
};

// Bounds: about twice what 2^18 samples show.
constexpr Errors kAlphaUpTo1 = {70, 45, 20, 70, 42, 14, 4, 25, 25};
constexpr Errors kLargeAlpha = {330, 120, 60, 20, 12, 200, 8, 25, 25};

Errors measure(Warp warp, const HardCase& hard_case, bool bounded, std::size_t count) {
  auto in = reference::generate(hard_case, warp, count, 3);
  Samples sample(count);
  Values value(count);
  ReflectionOptions options;
  options.bounded = bounded;
  sample_reflection(warp, count, in.wo(), in.alpha(), in.u(), sample.with_normals(), options);
  evaluate_reflection(count, in.wo(), sample.wi.in(), in.alpha(), value.out(), options);

  Errors worst;
  std::vector<double> pdf_errors;
  auto keep = [](double& largest, R error) { keep_larger(largest, double(error / kEps)); };
  for (std::size_t i = 0; i < count; ++i) {
    Vec3<R> wo{in.wo_x[i], in.wo_y[i], in.wo_z[i]};
    Alpha<R> alpha{in.alpha_x[i], in.alpha_y[i]};
    Vec3<R> wi = sample.wi.at<R>(i);
    if (!(wi.z > 0)) {
      EXPECT_EQ(sample.pdf[i], 0);
      EXPECT_EQ(sample.weight[i], 0);
    }
    EXPECT_LE(sample.weight[i], 1);
    EXPECT_GE(sample.weight[i], 0);

    // Bounded samples have normals of their own.
    Vec3<R> m = unit(sample.wm.at<R>(i));
    if (!bounded) {
      const float view[3] = {in.wo_x[i], in.wo_y[i], in.wo_z[i]};
      const float roughness[2] = {in.alpha_x[i], in.alpha_y[i]};
      const float u[2] = {in.u_x[i], in.u_y[i]};
      auto exact_m = reference::oracle_normal_quad(warp, view, roughness, u);
      m = {exact_m.x, exact_m.y, exact_m.z};
    }
    Vec3<R> exact = reflect(wo, m);
    R cos = dot(wo, m);
    R terms = wo.z + 2 * std::fabs(cos) * m.z;
    if (!bounded) {
      Vec3<R> off = wi + R(-1) * exact;
      keep(worst.wi, std::sqrt(dot(off, off)));
      // The oracle's normal is rounded to double.
      keep(worst.wi_z, (std::fabs(wi.z - exact.z) - R(0x1p-49)) / terms);
      keep(worst.cos, std::fabs(sample.cos[i] - cos));
    }
    if (wi.z <= 0 || exact.z <= 0) continue;

    R share = bounded ? bounded_share(wo, alpha) : R(1);
    R length_o = std::sqrt(dot(stretch(wo, alpha), stretch(wo, alpha)));
    auto pdf_of = [&](const Vec3<R>& normal) { return ndf(normal, alpha) / (2 * (length_o + wo.z) * share); };
    auto weight_of = [&](const Vec3<R>& l) {
      R length_i = std::sqrt(dot(stretch(l, alpha), stretch(l, alpha)));
      return share * l.z * (length_o + wo.z) / (l.z * length_o + length_i * wo.z);
    };
    if (!bounded) {
      Vec3<R> slopes = unstretch(m, alpha);
      R magnified = 1 + std::max(alpha.x, alpha.y) * std::sqrt(dot(slopes, slopes));
      R error = std::fabs(sample.pdf[i] / pdf_of(m) - 1) / magnified;
      keep(worst.pdf, error);
      pdf_errors.push_back(reference::or_infinite(double(error / kEps)));
      R weight = weight_of(exact);
      R from_wi_z = (1 - weight * length_o / (length_o + wo.z)) * terms / exact.z;
      keep(worst.weight, std::fabs(sample.weight[i] / weight - 1) / (1 + from_wi_z));
    }
    R smaller = std::min(alpha.x, alpha.y);
    keep(worst.agreement,
         std::fabs(R(sample.pdf[i]) / value.pdf[i] - 1) / (4 + 2 / smaller) * std::fmin(R(1), dot(wo, m)));
    R pdf = pdf_of(unit(wo + wi));
    keep(worst.evaluated_pdf, std::fabs(value.pdf[i] / pdf - 1));
    keep(worst.evaluated_f, std::fabs(value.f_cos[i] / (pdf * weight_of(wi)) - 1));
  }
  if (!pdf_errors.empty()) {
    auto p999 = pdf_errors.begin() + std::ptrdiff_t(double(pdf_errors.size() - 1) * 0.999);
    std::nth_element(pdf_errors.begin(), p999, pdf_errors.end());
    worst.pdf_p999 = *p999;
  }
  return worst;
}

/// The cases with unit views above the horizon.
std::vector<std::size_t> rows() {
  std::vector<std::size_t> indices;
  const auto& all = reference::hard_cases();
  for (std::size_t i = 0; i < all.size(); ++i) {
    auto in = reference::generate(all[i], Warp::polar, 64, 1);
    bool good = true;
    for (std::size_t k = 0; k < in.size(); ++k) {
      double length = std::hypot(in.wo_x[k], in.wo_y[k], in.wo_z[k]);
      good &= in.wo_z[k] >= 0 && std::fabs(length - 1) < 1e-6;
    }
    if (good) indices.push_back(i);
  }
  return indices;
}

using Param = std::tuple<int, std::size_t, bool>;
class Accuracy : public ::testing::TestWithParam<Param> {};
INSTANTIATE_TEST_SUITE_P(, Accuracy,
                         ::testing::Combine(::testing::Range(0, 3), ::testing::ValuesIn(rows()), ::testing::Bool()),
                         [](const auto& info) {
                           return std::string(kWarpNames[std::get<0>(info.param)]) + "_" +
                                  reference::hard_cases()[std::get<1>(info.param)].name +
                                  (std::get<2>(info.param) ? "_bounded" : "");
                         });

TEST_P(Accuracy, Reflection) {
  auto [warp, row, bounded] = GetParam();
  const HardCase& hard_case = reference::hard_cases()[row];
  Errors errors = measure(kWarps[warp], hard_case, bounded, kSamples);
  std::printf(
      "%s %s%s: wi %.1f, wi.z %.1f, wo.wm %.1f, pdf %.1f (p99.9 %.1f), weight %.1f, agreement %.2f, evaluated pdf "
      "%.1f, "
      "f %.1f eps\n",
      kWarpNames[warp], hard_case.name, bounded ? " bounded" : "", errors.wi, errors.wi_z, errors.cos, errors.pdf,
      errors.pdf_p999, errors.weight, errors.agreement, errors.evaluated_pdf, errors.evaluated_f);
  const Errors& bound = hard_case.alpha_above_1 ? kLargeAlpha : kAlphaUpTo1;
  EXPECT_LE(errors.wi, bound.wi);
  EXPECT_LE(errors.wi_z, bound.wi_z);
  EXPECT_LE(errors.cos, bound.cos);
  EXPECT_LE(errors.pdf, bound.pdf);
  EXPECT_LE(errors.pdf_p999, bound.pdf_p999);
  EXPECT_LE(errors.weight, bound.weight);
  EXPECT_LE(errors.agreement, bound.agreement);
  EXPECT_LE(errors.evaluated_pdf, bound.evaluated_pdf);
  EXPECT_LE(errors.evaluated_f, bound.evaluated_f);
}

// Where the view and the normal do not graze, what rounding wi costs is 16 eps (4 + 2 / alpha), down to alpha = 1e-3.
TEST(Agreement, OfSampleAndEvaluate) {
  for (float alpha : {1e-3f, 1e-2f, 0.1f, 0.5f, 1.f})
    for (Warp warp : kWarps)
      for (bool bounded : {false, true}) {
        std::size_t count = std::size_t(1) << 16;
        auto in = reference::generate(reference::hard_cases()[0], warp, count, 5);
        Samples sample(count);
        Values value(count);
        ReflectionOptions options;
        options.bounded = bounded;
        sample_reflection(warp, count, in.wo(), {alpha, alpha}, in.u(), sample.with_normals(), options);
        evaluate_reflection(count, in.wo(), sample.wi.in(), {alpha, alpha}, value.out(), options);
        double worst = 0;
        for (std::size_t i = 0; i < count; ++i)
          if (!(sample.pdf[i] <= 0 || sample.cos[i] <= 0.25f))
            keep_larger(worst, std::fabs(double(sample.pdf[i]) / value.pdf[i] - 1));
        EXPECT_LE(worst, 16 * kEps * (4 + 2 / alpha)) << alpha;
      }
}

// f cos is pdf times weight, for either masking.
TEST(Agreement, OfWeightAndBrdf) {
  std::size_t count = std::size_t(1) << 16;
  auto in = reference::generate(reference::hard_cases()[0], Warp::polar, count, 6);
  for (Masking masking : {Masking::height_correlated, Masking::separable})
    for (bool bounded : {false, true}) {
      ReflectionOptions options{masking, bounded};
      Samples sample(count);
      Values value(count);
      sample_reflection(Warp::polar, count, in.wo(), in.alpha(), in.u(), sample.with_normals(), options);
      evaluate_reflection(count, in.wo(), sample.wi.in(), in.alpha(), value.out(), options);
      for (std::size_t i = 0; i < count; ++i) {
        if (sample.wi.z[i] <= 0) continue;
        auto wo = Vec3<R>{in.wo_x[i], in.wo_y[i], in.wo_z[i]};
        auto wi = sample.wi.at<R>(i);
        R f = brdf_cos(wo, wi, {in.alpha_x[i], in.alpha_y[i]}, masking == Masking::separable);
        ASSERT_NEAR(double(value.f_cos[i] / f), 1, 25 * kEps);
        ASSERT_NEAR(double(sample.weight[i] * value.pdf[i] / f), 1, 25 * kEps);
      }
    }
}

/// The density of visible normals for any view, by the projected area that Walter et al. 2015 give in eq. 28.
R pdf_of_any_view(const Vec3<R>& v, const Vec3<R>& m, const Alpha<R>& alpha) {
  Vec3<R> h = stretch(v, alpha);
  R length = std::sqrt(dot(h, h)), l2 = h.x * h.x + h.y * h.y;
  R area = h.z < 0 ? l2 / (length - h.z) : length + h.z;
  return 2 * dot(v, m) * ndf(m, alpha) / area;
}

TEST(NormalDensity, Accuracy) {
  std::size_t count = std::size_t(1) << 15;
  for (const HardCase& hard_case : reference::hard_cases()) {
    auto in = reference::generate(hard_case, Warp::polar, count, 7);
    Directions wm(count);
    std::vector<float> pdf(count);
    sample_normals(Warp::polar, count, in.wo(), in.alpha(), in.u(), wm.out());
    pdf_normals(count, in.wo(), wm.in(), in.alpha(), pdf.data());
    double worst = 0;
    for (std::size_t i = 0; i < count; ++i) {
      Vec3<R> wo{in.wo_x[i], in.wo_y[i], in.wo_z[i]}, m = wm.at<R>(i);
      if (std::fabs(dot(wo, wo) - 1) > 1e-6L || dot(wo, m) <= 0) continue;
      // The formula is homogeneous in m but for the cosine.
      R exact = pdf_of_any_view(wo, unit(m), {in.alpha_x[i], in.alpha_y[i]}) * std::sqrt(dot(m, m));
      keep_larger(worst, double(std::fabs(pdf[i] / exact - 1) * std::fmin(R(1), dot(wo, m)) / kEps));
    }
    std::printf("%s: density of normals, relative error times wo.wm: %.1f eps\n", hard_case.name, worst);
    EXPECT_LE(worst, 25) << hard_case.name;
  }
}

}  // namespace
}  // namespace vndf::shading
