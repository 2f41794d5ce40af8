// What the ellipsoid NDF promises as a distribution: normalisations, samples, Walter's other samplers, masking.
#include <cstdio>

#include <gtest/gtest.h>

#include "ellipsoid/rejection.h"
#include "shading/grids.h"

namespace vndf::ellipsoid {
namespace {

using reference::Random;
using D = double;

constexpr Parameters kShapes[] = {
    {0.5f, 0.5f, 0, 0, 0},
    {0.15f, 0.5f, 0, 0, 0.7f},
    {0.3f, 0.6f, 0.3f, -0.2f, 0.5f},
    {0.1f, 0.4f, -0.5f, 0.5f, 2.f},
    {0.8f, 0.2f, 0.5f, 0.4f, -3.f},
    {0.05f, 0.05f, 0.2f, 0.1f, 0},
    {0.3f, 0.2f, 1.f, -0.8f, 1.f},
    {0.3f, 0.3f, 0, 0, 0},
    {1, 1, 0, 0, 0},
    {0.2f, 0.7f, 0, 0, 0},
    {2, 0.6f, 0, 0, 0},
};
constexpr int kShapeCount = int(sizeof kShapes / sizeof *kShapes);

Vec3<D> view(double cos, double phi) {
  double sin = std::sqrt(1 - cos * cos);
  Vec3<D> v{sin * std::cos(phi), sin * std::sin(phi), cos};
  return {float(v.x), float(v.y), float(v.z)};
}
const Vec3<D> kViews[] = {{0, 0, 1}, view(0.7, 0.4), view(0.25, 2.5), view(0.02, -1.9), view(-0.3, 1)};
constexpr int kViewCount = int(sizeof kViews / sizeof *kViews);

Columns3 constant(const Vec3<D>& v) {
  return {float(v.x), float(v.y), float(v.z)};
}

std::size_t bin_of(const Vec3<D>& m, const M3<D>& b) {
  return shading::bin_of(inverse_transposed_times(b, m));
}

class Every : public ::testing::TestWithParam<std::tuple<int, int>> {
 protected:
  const Parameters& parameters() const { return kShapes[std::get<0>(GetParam())]; }
  const Vec3<D>& psi() const { return kViews[std::get<1>(GetParam())]; }
};
INSTANTIATE_TEST_SUITE_P(, Every, ::testing::Combine(::testing::Range(0, kShapeCount), ::testing::Range(0, kViewCount)),
                         [](const auto& info) {
                           return "shape" + std::to_string(std::get<0>(info.param)) + "_view" +
                                  std::to_string(std::get<1>(info.param));
                         });

// Eq. 9 and 33: the projected area of all normals, and the density of the visible ones, are 1.
TEST_P(Every, Normalisation) {
  M3<D> a = matrix<D>(parameters());
  NormalGrid grid(upright(a), 40, 40);
  std::vector<float> pdf(grid.size());
  pdf_normals(pdf.size(), constant(psi()), grid.m.in(), parameters().ellipsoid(), pdf.data());
  double area = 0, visible = 0;
  for (std::size_t i = 0; i < pdf.size(); ++i) {
    auto m = unit(grid.m.at(i));
    area += ndf(m, a) * m.z * grid.solid_angle[i];
    visible += double(pdf[i]) * grid.solid_angle[i];
    double exact = normal_pdf(unit(psi()), m, a);
    if (dot(psi(), m) > 0.05) {
      ASSERT_NEAR(pdf[i] / exact, 1, 2e-5);
    }
  }
  EXPECT_NEAR(area, 1, 1e-4);
  EXPECT_NEAR(visible, 1, 2e-3);
}

// One failure by chance in a hundred runs of all tests; the seeds are fixed.
TEST_P(Every, ChiSquare) {
  constexpr std::size_t kCount = std::size_t(1) << 18;
  M3<D> b = upright(matrix<D>(parameters()));
  NormalGrid grid(b, 24, 24);
  std::vector<float> pdf(grid.size());
  pdf_normals(pdf.size(), constant(psi()), grid.m.in(), parameters().ellipsoid(), pdf.data());
  std::vector<double> expected(kRings * kSectors);
  double sum = 0;
  for (std::size_t i = 0; i < pdf.size(); ++i) sum += pdf[i] * grid.solid_angle[i];
  for (std::size_t i = 0; i < pdf.size(); ++i)
    expected[grid.bin(i)] += pdf[i] * grid.solid_angle[i] / sum * double(kCount);
  for (int w = 0; w < 3; ++w) {
    Numbers u(kCount, 2016 + std::uint64_t(w));
    Directions wm(kCount);
    sample_normals(kWarps[w], kCount, constant(psi()), parameters().ellipsoid(), u.pairs(), wm.out());
    std::vector<double> counts(kRings * kSectors);
    for (std::size_t i = 0; i < kCount; ++i) {
      ASSERT_GE(wm.z[i], 0);
      ++counts[bin_of(wm.at(i), b)];
    }
    EXPECT_GE(p_value(counts, expected), least_p_value(3 * kShapeCount * kViewCount)) << kWarpNames[w];
  }
}

// Versions 1 and 2 of section 4 share nothing with the closed forms: rays at the ellipsoid out of a bounding sphere's
// silhouette, and points of its own.
TEST_P(Every, WalterVersions1And2) {
  constexpr double kWanted = 1 << 17;
  M3<D> a = matrix<D>(parameters());
  M3<D> b = upright(a);
  Vec3<D> v = unit(psi());
  Random random(1);
  auto counting = [&](std::vector<double>& counts) { return [&](const Vec3<D>& m) { ++counts[bin_of(m, b)]; }; };
  std::vector<double> first_counts(kRings * kSectors), second_counts(kRings * kSectors);
  Tries first = sample_by_rejection(Version1(parameters(), psi()), random, kWanted, counting(first_counts));
  Tries second = sample_by_rejection(Version2(parameters(), psi()), random, kWanted, counting(second_counts));

  std::printf("alpha %.2f %.2f theta %.1f %.1f %.1f, view %.2f %.2f %.2f: rejected %.1f %% (version 1), %.1f %% (2)\n",
              parameters().alpha_x, parameters().alpha_y, parameters().theta_x, parameters().theta_y,
              parameters().theta_z, v.x, v.y, v.z, 100 * first.rejected(), 100 * second.rejected());

  constexpr std::size_t kCount = std::size_t(1) << 17;
  const double least = least_p_value(2 * 3 * kShapeCount * kViewCount);
  for (Warp warp : kWarps) {
    Numbers u(kCount, 33 + std::uint64_t(warp));
    Directions wm(kCount);
    sample_normals(warp, kCount, constant(psi()), parameters().ellipsoid(), u.pairs(), wm.out());
    std::vector<double> third(kRings * kSectors);
    for (std::size_t i = 0; i < kCount; ++i) ++third[bin_of(wm.at(i), b)];
    if (first.kept > 1000) {
      EXPECT_GE(two_sample_p_value(third, first_counts), least) << kWarpNames[int(warp)];
    }
    EXPECT_GE(two_sample_p_value(third, second_counts), least) << kWarpNames[int(warp)];
  }
  // What is rejected is what the lune lacks of the ellipsoid.
  double share = std::max(0., 1 - lune_area(v, a) / ellipsoid_area(v, a));
  EXPECT_NEAR(second.rejected(), share, 5 * std::sqrt(share * (1 - share) / second.tried) + 1e-9);
}

// Eq. 31; f cos, pdf and weight by eq. 4, 48 and 50; weight <= 1; f(wo, wi) = f(wi, wo).
TEST_P(Every, Reflection) {
  if (psi().z < 0) return;
  constexpr std::size_t kCount = std::size_t(1) << 15;
  M3<D> a = matrix<D>(parameters());
  Vec3<D> v = psi();
  EXPECT_LE(lune_area(v, a) * g1(v, a), ellipsoid_area({0, 0, 1}, a) * v.z * (1 + 1e-12));
  for (int w = 0; w < 3; ++w) {
    Numbers u(kCount, 17 + std::uint64_t(w));
    Samples s(kCount);
    Values there(kCount), back(kCount);
    auto e = parameters().ellipsoid();
    sample_reflection(kWarps[w], kCount, constant(v), e, u.pairs(), s.with_normals());
    evaluate_reflection(kCount, constant(v), s.wi.in(), e, there.out());
    evaluate_reflection(kCount, s.wi.in(), constant(v), e, back.out());
    double energy = 0;
    for (std::size_t i = 0; i < kCount; ++i) {
      ASSERT_GE(s.weight[i], 0);
      ASSERT_LE(s.weight[i], 1);
      energy += s.weight[i];
      Vec3<D> wi = s.wi.at(i);
      if (!(wi.z > 0)) {
        ASSERT_EQ(s.pdf[i], 0);
        ASSERT_EQ(there.f_cos[i], 0);
        continue;
      }
      Vec3<D> h = unit(v + wi);
      double pdf = ndf(h, a) * ellipsoid_area({0, 0, 1}, a) / (4 * lune_area(v, a));
      double f = ndf(h, a) * g1(v, a) * g1(wi, a) / (4 * v.z * wi.z);
      ASSERT_NEAR(there.pdf[i] / pdf, 1, 1e-4);
      ASSERT_NEAR(there.f_cos[i] / wi.z / f, 1, 1e-4);
      ASSERT_NEAR(back.f_cos[i] / v.z / f, 1, 1e-4);
      if (s.cos[i] > 0.2f && wi.z > 1e-3) {
        ASSERT_NEAR(s.pdf[i] / pdf, 1, 2e-4);
        ASSERT_NEAR(s.weight[i] / (f * wi.z / pdf), 1, 2e-3);
      }
    }
    EXPECT_LE(energy, double(kCount));
  }
}

}  // namespace
}  // namespace vndf::ellipsoid
