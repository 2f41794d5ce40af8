// Whether the normals have the density they should: Pearson's chi-square test of histograms against the integrated
// density.
//
// Significance: 0.01 for all tests together, by Sidak's correction for their number; the seeds are fixed, so a test
// that passes keeps passing. Bins that expect fewer than 10 samples are pooled. With 2^20 samples over some 384 bins, a
// density wrong by 2 % over half of the normals is found with near certainty.
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "reference/errors.h"
#include "support/operations.h"
#include "support/statistics.h"

namespace vndf::testing {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr std::size_t kSamples = std::size_t(1) << 20;
constexpr int kRings = 16, kSectors = 24;

struct Roughness {
  const char* name;
  float x, y;
};
constexpr Roughness kRoughness[] = {
    {"smooth", 0.001f, 0.001f}, {"glossy", 0.1f, 0.1f},     {"rough", 0.7f, 0.7f},
    {"rougher", 3.f, 3.f},      {"brushed_x", 0.6f, 0.05f}, {"brushed_y", 0.01f, 1.f},
};

struct View {
  const char* name;
  float x, y, z;
};
constexpr View kViews[] = {
    {"normal", 0.f, 0.f, 1.f},
    {"oblique", 0.6f, -0.36f, 0.71442284f},
    {"grazing", -0.27f, 0.9625487f, 0.02f},
    {"horizontal", 0.8f, 0.6f, 0.f},
    {"below_horizon", -0.9f, 0.3f, -0.31622776f},
    {"far_below_horizon", 0.3f, 0.4f, -0.8660254f},
};

constexpr std::size_t kTests = std::size(kRoughness) * std::size(kViews) * 3;

/// D_V(m) = 2 D(m) max(0, V.m) / (a + V.z) with a = |A V|: Heitz 2018, eq. 3, with G1 / V.z written out; the same below
/// the horizon (section 3.3: the signed sum of the two projected half disks is (a + V.z) / 2 in these units).
double density(const View& wo, const Roughness& alpha, double x, double y, double z) {
  double v_dot_m = wo.x * x + wo.y * y + wo.z * z;
  if (v_dot_m <= 0) return 0;
  double h = x * x / (double(alpha.x) * alpha.x) + y * y / (double(alpha.y) * alpha.y) + z * z;
  double d = 1 / (kPi * alpha.x * alpha.y * h * h);
  double a = std::hypot(double(alpha.x) * wo.x, double(alpha.y) * wo.y, double(wo.z));
  return 2 * d * v_dot_m / (a + wo.z);
}

/// Coordinates of the upper hemisphere in which the density is spread out: the slopes are (alpha_x g cos p, alpha_y g
/// sin p), with g = scale q / (1 - q), q in [0, 1], p in [0, 2 pi]. Below the horizon the smallest visible g is large,
/// and sets the scale.
class Chart {
 public:
  Chart(const View& wo, const Roughness& alpha) : wo_(wo), alpha_(alpha) {
    double horizontal = std::hypot(double(alpha.x) * wo.x, double(alpha.y) * wo.y);
    scale_ = wo.z < 0 ? std::max(1., -wo.z / horizontal) : 1;
  }

  /// The density times the solid angle per dq dp.
  double density_at(double q, double p) const {
    double g = scale_ * q / (1 - q);
    double slope_x = alpha_.x * g * std::cos(p), slope_y = alpha_.y * g * std::sin(p);
    double z = 1 / std::sqrt(1 + slope_x * slope_x + slope_y * slope_y);
    double g_per_q = scale_ / ((1 - q) * (1 - q));
    return density(wo_, alpha_, slope_x * z, slope_y * z, z) * z * z * z * alpha_.x * alpha_.y * g * g_per_q;
  }

  std::size_t bin(double x, double y, double z) const {
    double across = std::hypot(x / alpha_.x, y / alpha_.y);
    double q = across / (across + scale_ * z);
    double turn = std::atan2(y / alpha_.y, x / alpha_.x) / (2 * kPi);
    int ring = std::min(int(q * kRings), kRings - 1);
    int sector = std::min(int((turn < 0 ? turn + 1 : turn) * kSectors), kSectors - 1);
    return std::size_t(ring * kSectors + sector);
  }

 private:
  View wo_;
  Roughness alpha_;
  double scale_;
};

/// A rectangle of a chart.
struct Cell {
  double q0, q1, p0, p1;
};

/// Gauss's rule with 4 x 4 points.
double gauss(const Chart& chart, const Cell& cell) {
  constexpr double kNode[] = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563, 0.8611363115940526};
  constexpr double kWeight[] = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461, 0.3478548451374538};
  double q_half = (cell.q1 - cell.q0) / 2, p_half = (cell.p1 - cell.p0) / 2, sum = 0;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      sum += kWeight[i] * kWeight[j] *
             chart.density_at(cell.q0 + q_half * (1 + kNode[i]), cell.p0 + p_half * (1 + kNode[j]));
  return sum * q_half * p_half;
}

/// Divides a cell until its quarters agree with it: the edge of the visible normals runs across.
double integrate(const Chart& chart, const Cell& cell, double whole, int depth) {
  double q = (cell.q0 + cell.q1) / 2, p = (cell.p0 + cell.p1) / 2;
  const Cell quarters[] = {
      {cell.q0, q, cell.p0, p}, {q, cell.q1, cell.p0, p}, {cell.q0, q, p, cell.p1}, {q, cell.q1, p, cell.p1}};
  double parts[4], sum = 0;
  for (int i = 0; i < 4; ++i) sum += parts[i] = gauss(chart, quarters[i]);
  if (depth == 0 || (depth < 8 && std::fabs(sum - whole) < 1e-9)) return sum;
  sum = 0;
  for (int i = 0; i < 4; ++i) sum += integrate(chart, quarters[i], parts[i], depth - 1);
  return sum;
}

std::vector<double> expected_masses(const Chart& chart) {
  std::vector<double> masses;
  for (int ring = 0; ring < kRings; ++ring)
    for (int sector = 0; sector < kSectors; ++sector) {
      Cell cell{double(ring) / kRings, double(ring + 1) / kRings, 2 * kPi * sector / kSectors,
                2 * kPi * (sector + 1) / kSectors};
      masses.push_back(integrate(chart, cell, gauss(chart, cell), 9));
    }
  return masses;
}

TEST(ChiSquare, PValuesAreThoseOfTheTables) {
  EXPECT_NEAR(chi_square_tail(3.841458821, 1), 0.05, 1e-9);
  EXPECT_NEAR(chi_square_tail(23.20925116, 10), 0.01, 1e-9);
  EXPECT_NEAR(chi_square_tail(67.32756331, 100), 0.995, 1e-9);
}

/// Indices of kRoughness and kViews.
using Parameters = std::tuple<Warp, int, int>;

class Density : public ::testing::TestWithParam<Parameters> {};

std::string name(const ::testing::TestParamInfo<Parameters>& info) {
  const auto& [warp, alpha, wo] = info.param;
  return std::string(kWarpNames[int(warp)]) + "_" + kRoughness[alpha].name + "_" + kViews[wo].name;
}
INSTANTIATE_TEST_SUITE_P(, Density,
                         ::testing::Combine(::testing::ValuesIn(kWarps),
                                            ::testing::Range(0, int(std::size(kRoughness))),
                                            ::testing::Range(0, int(std::size(kViews)))),
                         name);

TEST_P(Density, OfVisibleNormals) {
  Warp warp = std::get<0>(GetParam());
  const Roughness& alpha = kRoughness[std::get<1>(GetParam())];
  const View& wo = kViews[std::get<2>(GetParam())];
  Chart chart(wo, alpha);
  std::vector<double> masses = expected_masses(chart);
  ASSERT_NEAR(std::accumulate(masses.begin(), masses.end(), 0.), 1, 1e-5) << "the density does not integrate to 1";

  std::vector<float> u1(kSamples), u2(kSamples), x(kSamples), y(kSamples), z(kSamples);
  std::uint64_t stream = std::uint64_t((int(warp) * 100 + std::get<1>(GetParam())) * 100 + std::get<2>(GetParam()));
  reference::Random random(1, stream);
  for (std::size_t i = 0; i < kSamples; ++i) {
    u1[i] = random.unit();
    u2[i] = random.unit();
  }
  sample_normals(warp, kSamples, {wo.x, wo.y, wo.z}, {alpha.x, alpha.y}, {u1.data(), u2.data()},
                 {x.data(), y.data(), z.data()});

  std::vector<double> counts(masses.size());
  for (std::size_t i = 0; i < kSamples; ++i) {
    double length = std::hypot(double(x[i]), double(y[i]), double(z[i]));
    ASSERT_NEAR(length, 1, 5 * reference::kEps) << "u " << u1[i] << " " << u2[i];
    ASSERT_GE(z[i], 0) << "u " << u1[i] << " " << u2[i];
    ++counts[chart.bin(x[i], y[i], z[i])];
  }
  for (double& mass : masses) mass *= double(kSamples);
  EXPECT_GE(p_value(counts, masses), least_p_value(kTests));
}

}  // namespace
}  // namespace vndf::testing
