// Whether the oracle deserves its name.
#include <cmath>

#include <gtest/gtest.h>

#include "reference/errors.h"
#include "reference/quad.h"
#include "support/operations.h"

namespace vndf::reference {
namespace {

double distance(const OracleNormal& a, const OracleNormal& b) {
  return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

// The estimate that decides which arithmetic is enough must hold.
TEST(Oracle, LongDoubleIsAsGoodAsItSays) {
  constexpr std::size_t kCount = 1 << 12;
  for (Warp warp : testing::kWarps)
    for (const HardCase& row : hard_cases()) {
      if (row.no_visible_normal) continue;
      Inputs in = generate(row, warp, kCount, 1);
      for (std::size_t i = 0; i < kCount; ++i) {
        const float wo[3] = {in.wo_x[i], in.wo_y[i], in.wo_z[i]};
        const float alpha[2] = {in.alpha_x[i], in.alpha_y[i]};
        const float u[2] = {in.u_x[i], in.u_y[i]};
        OracleNormal rough = oracle_normal_long_double(warp, wo, alpha, u);
        OracleNormal fine = oracle_normal_quad(warp, wo, alpha, u);
        // What is left of the result, both rounded to double.
        ASSERT_LE(distance(rough, fine), rough.uncertainty + fine.uncertainty + 0x1p-51) << row.name << " " << i;
        ASSERT_LE(fine.uncertainty, kEps / 16) << row.name << " " << i;
      }
    }
}

#if VNDF_FLOAT128
// 113 bits, of pi and of each function, where long double has 64.
TEST(Quad, HasItsDigits) {
  Quad sin, cos, root = square_root(Quad(3));
  sin_cos(kPi<Quad> / 6, sin, cos);
  EXPECT_LE(std::fabs(double(2 * sin - 1)), 0x1p-110);
  EXPECT_LE(std::fabs(double(2 * cos - root)), 0x1p-110);
  EXPECT_LE(std::fabs(double(root * root - 3)), 0x1p-110);
}
#endif

TEST(Oracle, KnownNormals) {
  struct Row {
    Warp warp;
    float wo[3], alpha[2], u[2];
    double wm[3];
  };
  const double h = std::sqrt(0.5);
  const Row rows[] = {
      // The centre of the disk, seen along the normal, at 60 degrees and edge-on.
      {Warp::polar, {0, 0, 1}, {0.5f, 0.5f}, {0, 0}, {0, 0, 1}},
      {Warp::concentric, {0, 0, 1}, {0.5f, 0.5f}, {0.5f, 0.5f}, {0, 0, 1}},
      {Warp::polar, {1, 0, 0}, {1, 1}, {0, 0}, {std::sqrt(0.75), 0, 0.5}},
      {Warp::concentric, {1, 0, 0}, {1, 1}, {0.5f, 0.5f}, {std::sqrt(0.75), 0, 0.5}},
      // Along +z, T1 is +y and T2 is -x.
      {Warp::polar, {0, 0, 1}, {1, 1}, {0.5f, 0}, {0, h, h}},
      {Warp::polar, {0, 0, 1}, {1, 1}, {0.5f, 0.25f}, {-h, 0, h}},
      {Warp::concentric, {0, 0, 1}, {1, 1}, {1, 0.5f}, {0, 1, 0}},
      // alpha scales the horizontal components: (0, h, h) becomes (0, h / 2, h).
      {Warp::polar, {0, 0, 1}, {1, 0.5f}, {0.5f, 0}, {0, 1 / std::sqrt(5.), 2 / std::sqrt(5.)}},
      // The cap's top and its rim: half vectors of the view with +z and with a horizontal direction, a quarter turn on
      // from opposite to the view.
      {Warp::spherical_cap, {1, 0, 0}, {1, 1}, {0, 0}, {h, 0, h}},
      {Warp::spherical_cap, {1, 0, 0}, {1, 1}, {0.25f, 1}, {h, -h, 0}},
      {Warp::spherical_cap, {0, 1, 0}, {1, 1}, {0.25f, 1}, {h, h, 0}},
      {Warp::spherical_cap, {1, 0, 0}, {1, 1}, {0.5f, 1}, {1, 0, 0}},
      // Opposite to a view along +z is -x.
      {Warp::spherical_cap, {0, 0, 1}, {1, 1}, {0, 0.5f}, {-h, 0, h}},
      {Warp::spherical_cap, {0, 0, 1}, {1, 1}, {0.25f, 0.5f}, {0, -h, h}},
  };
  for (const Row& row : rows) {
    OracleNormal wm = oracle_normal(row.warp, row.wo, row.alpha, row.u);
    EXPECT_NEAR(wm.x, row.wm[0], 1e-9);
    EXPECT_NEAR(wm.y, row.wm[1], 1e-9);
    EXPECT_NEAR(wm.z, row.wm[2], 1e-9);
  }
}

}  // namespace
}  // namespace vndf::reference
