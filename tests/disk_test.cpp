// The accuracy of the stages before the hemisphere: sine and cosine, and the two disk maps.
#include <cmath>

#include <gtest/gtest.h>
#include <vndf/lanes.h>

#include "reference/errors.h"

namespace vndf {
namespace {

using reference::kEps;

constexpr std::uint32_t kSteps = 1u << 24;

/// The largest error seen, and where.
struct Largest {
  double error = 0;
  float u[2] = {};

  void see(double e, float u1, float u2 = 0) {
    if (reference::keep_larger(error, e)) u[0] = u1, u[1] = u2;
  }
};
std::ostream& operator<<(std::ostream& out, const Largest& largest) {
  return out << largest.error << " at u " << largest.u[0] << " " << largest.u[1];
}

/// In units of the last place of the exact value. An exact zero must be met exactly.
double ulps(float value, long double exact) {
  if (std::fabs(exact) < 1e-15L) return value == 0 ? 0 : HUGE_VAL;
  int exponent;
  std::frexp(exact, &exponent);
  return double(std::fabs(value - exact) * std::ldexp(1.L, 24 - exponent));
}

// All multiples of 2^-24 in [0, 1].
TEST(SinCos2Pi, Exhaustive) {
  constexpr double kBoundUlp = 3;
  const long double two_pi = 2 * std::acos(-1.L);
  Largest sin_error, cos_error;
  for (std::uint32_t k = 0; k <= kSteps; ++k) {
    float u = float(k) * 0x1p-24f;
    // The argument is reduced to [-1/8, 1/8] exactly, so that its zeros are exact.
    int quadrant = int((k + kSteps / 8) / (kSteps / 4));
    long double f = two_pi * (u - quadrant * 0.25L);
    long double s = std::sin(f), c = std::cos(f);
    const long double sin[] = {s, c, -s, -c}, cos[] = {c, -s, -c, s};
    auto angle = lanes::sincos2pi(u);
    sin_error.see(ulps(angle.sin, sin[quadrant % 4]), u);
    cos_error.see(ulps(angle.cos, cos[quadrant % 4]), u);
  }
  ::testing::Test::RecordProperty("sin_ulp", std::to_string(sin_error.error));
  ::testing::Test::RecordProperty("cos_ulp", std::to_string(cos_error.error));
  std::cout << "sin " << sin_error << ", cos " << cos_error << " ulp\n";
  EXPECT_LE(sin_error.error, kBoundUlp) << sin_error;
  EXPECT_LE(cos_error.error, kBoundUlp) << cos_error;
}

class DiskMaps : public ::testing::TestWithParam<DiskMap> {
 protected:
  static lanes::DiskPoint<float> map(const float (&u)[2]) {
    lanes::Vec2<float> p{u[0], u[1]};
    return GetParam() == DiskMap::polar ? lanes::polar_map(p) : lanes::concentric_map(p);
  }

  /// Random points, and points close to where something happens.
  template <class F>
  static void for_each_u(F f) {
    reference::Random random(1);
    for (int i = 0; i < 1 << 20; ++i) f({random.unit(), random.unit()});
    for (const auto& row : reference::hard_cases()) {
      Warp warp = GetParam() == DiskMap::polar ? Warp::polar : Warp::concentric;
      reference::Inputs in = reference::generate(row, warp, 1 << 12, 2);
      for (std::size_t i = 0; i < in.size(); ++i) f({in.u_x[i], in.u_y[i]});
    }
    for (float u1 : {0.f, 0x1p-24f, 0.25f, 0.5f, 1 - 0x1p-24f, 1.f})
      for (float u2 : {0.f, 0x1p-24f, 0.25f, 0.5f, 1 - 0x1p-24f, 1.f}) f({u1, u2});
  }
};
INSTANTIATE_TEST_SUITE_P(, DiskMaps, ::testing::Values(DiskMap::polar, DiskMap::concentric), [](const auto& info) {
  return std::string(info.param == DiskMap::polar ? "polar" : "concentric");
});

TEST_P(DiskMaps, Point) {
  Largest point, radius, area;
  for_each_u([&](const float(&u)[2]) {
    float x, y;
    sample_disk(GetParam(), 1, {u[0], u[1]}, {&x, &y});
    auto exact = reference::oracle_disk(GetParam(), u);
    point.see(std::hypot(x - exact.t1, y - exact.t2) / kEps, u[0], u[1]);
    radius.see(std::fabs(std::hypot(double(x), double(y)) - exact.r) / kEps, u[0], u[1]);
    area.see(std::fabs(double(x) * x + double(y) * y - exact.r * exact.r) / kEps, u[0], u[1]);
  });
  std::cout << "point " << point << ", r " << radius << ", area " << area << " eps\n";
  EXPECT_LE(point.error, 4) << point;
  EXPECT_LE(radius.error, 4) << radius;
  EXPECT_LE(area.error, 7) << area;
}

// 1 - r^2 to full relative accuracy, save on the rim itself, where it is kept just above 0.
TEST_P(DiskMaps, DistanceFromTheRim) {
  Largest relative;
  for_each_u([&](const float(&u)[2]) {
    double e = map(u).e, exact = reference::oracle_disk(GetParam(), u).e;
    relative.see((std::fabs(e - exact) - 0x1p-50) / (exact + 0x1p-50) / kEps, u[0], u[1]);
  });
  std::cout << "e " << relative << " eps, relative\n";
  EXPECT_LE(relative.error, 4) << relative;
}

}  // namespace
}  // namespace vndf
