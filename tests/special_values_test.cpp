// What the header says of values at the edge of the domain and beyond it.
#include <cmath>
#include <limits>

#include "reference/errors.h"
#include "support/bits.h"

namespace vndf::testing {
namespace {

using reference::kEps;

struct Normal {
  float x, y, z;
};

class SpecialValues : public ::testing::TestWithParam<std::tuple<Warp, std::string>> {
 protected:
  void SetUp() override {
    if (set_isa(std::get<1>(GetParam()).c_str()) == IsaError::unsupported) GTEST_SKIP();
  }
  static Warp warp() { return std::get<0>(GetParam()); }

  static Normal sample(const float (&wo)[3], const float (&alpha)[2], const float (&u)[2]) {
    Normal wm;
    sample_normals(warp(), 1, {wo[0], wo[1], wo[2]}, {alpha[0], alpha[1]}, {u[0], u[1]}, {&wm.x, &wm.y, &wm.z});
    return wm;
  }
  static void expect_unit_and_upper(const Normal& wm) {
    double length = std::sqrt(double(wm.x) * wm.x + double(wm.y) * wm.y + double(wm.z) * wm.z);
    EXPECT_NEAR(length, 1, 5 * kEps);
    EXPECT_GE(wm.z, 0);
  }
  static void expect_near(const Normal& a, const Normal& b) {
    EXPECT_NEAR(a.x, b.x, 40 * kEps);
    EXPECT_NEAR(a.y, b.y, 40 * kEps);
    EXPECT_NEAR(a.z, b.z, 40 * kEps);
  }
  /// Random numbers, the ends of [0, 1] among them.
  template <class F>
  static void for_each_u(F f) {
    const float values[] = {0.f, 0x1p-24f, 0.125f, 0.3f, 0.5f, 0.77f, 1 - 0x1p-24f, 1.f};
    for (float u1 : values)
      for (float u2 : values) f({u1, u2});
  }

 private:
  KeepIsa keep_;
};
std::string warp_and_isa(const ::testing::TestParamInfo<SpecialValues::ParamType>& info) {
  static const char* const names[] = {"polar", "concentric", "spherical_cap"};
  return std::string(names[int(std::get<0>(info.param))]) + "_" + std::get<1>(info.param);
}
INSTANTIATE_TEST_SUITE_P(, SpecialValues,
                         ::testing::Combine(::testing::Values(Warp::polar, Warp::concentric, Warp::spherical_cap),
                                            ::testing::ValuesIn(isa_names())),
                         warp_and_isa);

TEST_P(SpecialValues, NoNaNForAnyAlphaAndLength) {
  const float lengths[] = {0, 1e-42f, 1e-20f, 1, 1e17f};
  const float directions[][3] = {{0, 0, 1},           {0, 0, -1},         {1, 0.1f, 0},   {-0.3f, 0.5f, 0.8f},
                                 {0.3f, 0.5f, -0.8f}, {1, 0.1f, -1e-10f}, {0, 1e-20f, 1}, {1e-42f, 0, -1}};
  const float alphas[] = {0, 1e-45f, 1e-30f, 1e-10f, 0.3f, 100, 1e4f, 1e10f, 1e20f};
  for (const auto& wo : directions)
    for (float length : lengths)
      for (float alpha_x : alphas)
        for (float alpha_y : alphas)
          for_each_u([&](const float(&u)[2]) {
            Normal wm = sample({length * wo[0], length * wo[1], length * wo[2]}, {alpha_x, alpha_y}, u);
            ASSERT_FALSE(std::isnan(wm.x) || std::isnan(wm.y) || std::isnan(wm.z));
            if (alpha_x <= 1e4f && alpha_y <= 1e4f) expect_unit_and_upper(wm);
          });
}

TEST_P(SpecialValues, BothEndsOfTheRandomNumbers) {
  const float views[][3] = {{0, 0, 1},        {0.6f, 0, 0.8f},  {0.8f, 0.6f, 0},  {0.8f, 0.6f, -0.f}, {0, 1, 1e-6f},
                            {0.6f, 0, -0.8f}, {0, 1e-4f, -1.f}, {1e-12f, 0, 1.f}, {0, 1e-10f, 1.f}};
  const float alphas[][2] = {{0.5f, 0.5f}, {1e-4f, 1e-4f}, {1e-6f, 1.f}, {1.f, 0.05f}, {100.f, 100.f}};
  for (const auto& wo : views)
    for (const auto& alpha : alphas)
      for_each_u([&](const float(&u)[2]) {
        expect_unit_and_upper(sample(wo, alpha, u));
        if (HasFailure())
          FAIL() << wo[0] << " " << wo[1] << " " << wo[2] << " alpha " << alpha[0] << " " << alpha[1] << " u " << u[0]
                 << " " << u[1];
      });
}

TEST_P(SpecialValues, NoVisibleNormal) {
  for_each_u([](const float(&u)[2]) { expect_unit_and_upper(sample({0, 0, -1}, {0.3f, 0.7f}, u)); });
}

TEST_P(SpecialValues, NoView) {
  for (float zero : {0.f, -0.f})
    for_each_u([&](const float(&u)[2]) { expect_unit_and_upper(sample({zero, zero, zero}, {0.3f, 0.7f}, u)); });
}

TEST_P(SpecialValues, SignOfZeroCosineDoesNotMatter) {
  for_each_u([](const float(&u)[2]) {
    expect_near(sample({0.6f, 0.8f, 0.f}, {0.3f, 0.7f}, u), sample({0.6f, 0.8f, -0.f}, {0.3f, 0.7f}, u));
  });
}

TEST_P(SpecialValues, Mirror) {
  for_each_u([](const float(&u)[2]) {
    Normal wm = sample({0.6f, 0, 0.8f}, {0, 0}, u);
    if (u[0] < 1 && u[1] < 1) expect_near(wm, {0, 0, 1});
    expect_unit_and_upper(wm);
  });
}

TEST_P(SpecialValues, NegativeAlphaMirrorsItsAxis) {
  for_each_u([](const float(&u)[2]) {
    // The view in the hemisphere configuration is mirrored with it, so the reference is the mirrored view's normal.
    Normal wm = sample({0.5f, 0.3f, 0.8f}, {-0.4f, 0.7f}, u);
    Normal mirrored = sample({-0.5f, 0.3f, 0.8f}, {0.4f, 0.7f}, u);
    expect_near(wm, {-mirrored.x, mirrored.y, mirrored.z});
  });
}

TEST_P(SpecialValues, TheExtremesOfAlphaAndLength) {
  for (float alpha : {1e-30f, 1e-20f, 1e-10f, 1e-3f, 1.f, 100.f})
    for (float length : {1e-30f, 1e-20f, 1.f, 1e20f, 1e30f})
      for (float z : {0.8f, 0.f})
        for_each_u([&](const float(&u)[2]) {
          if (z == 0.f && alpha < 1e-9f) return;  // a mirror seen edge-on
          expect_unit_and_upper(sample({0.6f * length, 0, z * length}, {alpha, alpha}, u));
          if (HasFailure())
            FAIL() << "alpha " << alpha << " length " << length << " z " << z << " u " << u[0] << " " << u[1];
        });
}

// The azimuth of a vanishing tilt is that of the tilt; of none, +x.
TEST_P(SpecialValues, AzimuthOfNormalViews) {
  for_each_u([](const float(&u)[2]) {
    const float tilt = warp() == Warp::spherical_cap ? 1e-15f : 1e-25f;
    Normal exact = sample({0, 0, 1}, {0.5f, 0.5f}, u);
    expect_near(sample({tilt, 0, 1}, {0.5f, 0.5f}, u), exact);
    Normal along_y = sample({0, tilt, 1}, {0.5f, 0.5f}, u);
    expect_near(along_y, {-exact.y, exact.x, exact.z});
  });
}

}  // namespace
}  // namespace vndf::testing
