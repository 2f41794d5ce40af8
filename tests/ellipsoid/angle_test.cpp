// Angles of more than half a turn cost theta eps; those up to pi are in accuracy_test.cpp.
#include <cstdio>

#include <gtest/gtest.h>

#include <vndf/lanes.h>

#include "ellipsoid/model.h"
#include "reference/errors.h"
#include "reference/random.h"

namespace vndf::ellipsoid {
namespace {

using reference::kEps;
using reference::Random;

// Half of them next to whole quarter turns, where the reduced angle is a difference of what nearly cancels.
float any_angle(Random& random, double from, double to) {
  double theta = random.log_uniform(from, to), quarter = kPi<double> / 2;
  if (random.below(2)) theta = std::fmax(std::floor(theta / quarter) * quarter, from);
  return float(random.below(2) ? theta : -theta);
}

class Turns : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(UpTo, Turns, ::testing::Values(10, 1e3, 1e6),
                         [](const auto& info) { return std::to_string(int(info.param)); });

TEST_P(Turns, Accuracy) {
  using R = long double;
  const lanes::Vec3<float> v{0.6f, 0.8f, 0};
  double angle = 0, narrow = 0, turned = 0;
  for (std::uint64_t i = 0; i < 500000; ++i) {
    Random random(31, i);
    float theta = any_angle(random, kPi<double>, GetParam());
    R sin = std::sin(R(theta)), cos = std::cos(R(theta));
    auto keep = [&](double& worst, R x, R y) {
      reference::keep_larger(worst, double(std::hypot(x, y) / std::fabs(theta) / kEps));
    };
    auto wide = lanes::angle_of<double>(theta);
    keep(angle, wide.cos - cos, wide.sin - sin);
    auto float_angle = lanes::angle_of<float>(theta);
    keep(narrow, float_angle.cos - cos, float_angle.sin - sin);
    auto w = lanes::turn(v, lanes::rotation_of(theta));
    keep(turned, w.x - (cos * v.x - sin * v.y), w.y - (sin * v.x + cos * v.y));
  }
  std::printf("angle %.3f, as floats %.3f, turned vector %.3f theta eps\n", angle, narrow, turned);
  EXPECT_LE(angle, 1);
  EXPECT_LE(narrow, 1);
  EXPECT_LE(turned, 1);
}

}  // namespace
}  // namespace vndf::ellipsoid
