// The accuracy of the normals, one test per hard case and warp: inputs, oracle, bound.
//
// 2^20 samples per case; VNDF_TEST_SAMPLES sets another number, as a power of two (22 is what the report takes).
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "reference/errors.h"
#include "support/inputs.h"

namespace vndf::testing {
namespace {

using reference::HardCase;

// |(d wm.x / alpha_x, d wm.y / alpha_y)|, for small alpha; beyond a thousand alphas from +z relative to the slope,
// since there the rounding of wm alone comes close to it (see errors.h).
constexpr double kSlopeBound = 1e-3;

/// Of errors in units of 2^-24.
struct Bounds {
  double mean, p999, max;
};

// For alpha up to 1.
constexpr Bounds kBounds = {1.2, 8, 40}, kCapBounds = {1.2, 8, 60};
// Where rounding wo and alpha alone moves the exact normal by more than half of that, twice what it moves it: a view
// below the horizon along the axis of a far smaller alpha. (The worst known: alpha 1e-5 and 0.08, a view along the
// first axis, 970 eps by rounding alone.)
constexpr double kConditionLimit = 2;
// Above 1, A Nh / |A Nh| magnifies the error of Nh.
constexpr Bounds kLargeAlpha = {1.2, 10, 200};
// The norm of every result.
constexpr double kNormBound = 5;

std::size_t sample_count() {
  const char* exponent = std::getenv("VNDF_TEST_SAMPLES");
  return std::size_t(1) << (exponent ? std::atoi(exponent) : 20);
}

/// A warp and an index of hard_cases().
using Row = std::tuple<Warp, std::size_t>;

class Accuracy : public ::testing::TestWithParam<Row> {
 protected:
  static Warp warp() { return std::get<0>(GetParam()); }
  static const HardCase& hard_case() { return reference::hard_cases()[std::get<1>(GetParam())]; }

  static Bounds bounds() {
    return hard_case().alpha_above_1 ? kLargeAlpha : warp() == Warp::spherical_cap ? kCapBounds : kBounds;
  }

  /// The error, in eps, that the conditioning of a sample excuses.
  static double excused(const reference::Inputs& in, std::size_t i) {
    const float wo[3] = {in.wo_x[i], in.wo_y[i], in.wo_z[i]};
    const float alpha[2] = {in.alpha_x[i], in.alpha_y[i]};
    const float u[2] = {in.u_x[i], in.u_y[i]};
    return kConditionLimit * reference::conditioning(warp(), wo, alpha, u).view / reference::kEps;
  }
};

std::string name(const ::testing::TestParamInfo<Row>& info) {
  return std::string(kWarpNames[int(std::get<0>(info.param))]) + "_" +
         reference::hard_cases()[std::get<1>(info.param)].name;
}
INSTANTIATE_TEST_SUITE_P(, Accuracy,
                         ::testing::Combine(::testing::ValuesIn(kWarps),
                                            ::testing::Range(std::size_t(0), reference::hard_cases().size())),
                         name);

TEST_P(Accuracy, Normals) {
  reference::Inputs in = reference::generate(hard_case(), warp(), sample_count(), 1);
  std::vector<float> x(in.size()), y(in.size()), z(in.size());
  sample_normals(warp(), in.size(), in.wo(), in.alpha(), in.u(), {x.data(), y.data(), z.data()});
  auto at = [&](std::size_t i) {
    char wm[100];
    std::snprintf(wm, sizeof wm, ", wm %a, %a, %a", x[i], y[i], z[i]);
    return describe(operation("normals_polar"), {in.wo_x, in.wo_y, in.wo_z, in.alpha_x, in.alpha_y, in.u_x, in.u_y},
                    i) +
           wm;
  };
  for (std::size_t i = 0; i < in.size(); ++i) ASSERT_GE(z[i], 0) << "below the surface: " << at(i);

  auto oracle = reference::oracle_normals(warp(), in);
  auto errors = reference::measure(in, oracle, x.data(), y.data(), z.data());
  EXPECT_LE(errors.max_norm, kNormBound) << at(errors.worst_norm);
  if (hard_case().no_visible_normal) return;

  std::printf("%s %s: mean %.2f, p99.9 %.2f, max %.2f eps; slope %.2g (resolved %.2g); norm %.2f eps\n",
              kWarpNames[int(warp())], hard_case().name, errors.mean, errors.p999, errors.max, errors.max_slope,
              errors.max_resolved_slope, errors.max_norm);
  EXPECT_LE(oracle.uncertainty, reference::kEps / 16) << "the oracle itself";
  EXPECT_LE(errors.mean, bounds().mean);
  EXPECT_LE(errors.p999, bounds().p999);
  if (hard_case().small_alpha) {
    EXPECT_LE(errors.max_resolved_slope, kSlopeBound) << at(errors.worst_slope);
  }
  // The worst of the samples that their conditioning does not excuse.
  double worst_error = 0;
  std::size_t worst = 0;
  for (std::size_t i = 0; i < in.size(); ++i) {
    double error = std::hypot(x[i] - oracle.x[i], y[i] - oracle.y[i], z[i] - oracle.z[i]) / reference::kEps;
    if (error <= bounds().max || error <= worst_error || error <= excused(in, i)) continue;
    worst_error = error;
    worst = i;
  }
  EXPECT_LE(worst_error, bounds().max) << at(worst);
}

}  // namespace
}  // namespace vndf::testing
