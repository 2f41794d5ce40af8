// Ellipsoids at the edges of their domain: seen so that they are nearly flat, and matrices of any proportions.
#include <algorithm>

#include "edges/edges.h"

namespace vndf::edges {
namespace {

constexpr std::size_t kCount = 1 << 13;
const float kRight = 1.5707964f;  // the float next to a right angle

template <class Surface>
void expect_sound(const Batch& batch, Warp warp, const Surface& surface) {
  const std::size_t n = batch.size();
  Directions wm(n);
  Samples s(n);
  Values value(n);
  sample_normals(warp, n, batch.wo.in(), surface, batch.pairs(), wm.out());
  sample_reflection(warp, n, batch.wo.in(), surface, batch.pairs(), s.with_normals());
  evaluate_reflection(n, batch.wo.in(), s.wi.in(), surface, value.out());
  for (std::size_t i = 0; i < n; ++i) {
    ASSERT_TRUE(is_unit(wm.at(i)) && wm.z[i] >= 0)
        << kWarpNames[int(warp)] << " " << batch.at(i) << ": " << wm.x[i] << " " << wm.y[i] << " " << wm.z[i];
    ASSERT_TRUE(is_unit(s.wm.at(i))) << kWarpNames[int(warp)] << " " << batch.at(i);
    ASSERT_LE(std::fabs(length(s.wi.at(i)) - length(batch.wo.at(i))), 12 * kEps)
        << kWarpNames[int(warp)] << " " << batch.at(i);
    ASSERT_TRUE(bounded_result(s.pdf[i], s.weight[i]))
        << kWarpNames[int(warp)] << " " << batch.at(i) << ": " << s.pdf[i] << " " << s.weight[i];
    ASSERT_TRUE(bounded_result(value.pdf[i], 0) && value.f_cos[i] >= 0 && std::isfinite(value.f_cos[i]))
        << kWarpNames[int(warp)] << " " << batch.at(i) << ": " << value.pdf[i] << " " << value.f_cos[i];
  }
}

// Leaning by the float next to a right angle, an ellipsoid of small alpha is a disk seen from its edge.
TEST(Ellipsoids, LeaningByARightAngle) {
  const Batch batch(kCount, false);
  const Parameters rows[] = {
      {1e-6f, 1e-6f, 0, kRight, 0},
      {1e-5f, 1e-5f, 0, kRight, 0},
      {3e-6f, 3e-6f, 0, -kRight, 0.82f},
      {1e-6f, 67.8f, -0.42f, kRight, 0.82f},
      {1e-6f, 1e-5f, -0.42f, kRight, 0.82f},
      {1e-5f, 1e-6f, 1.2f, kRight, -2},
      {1e-6f, 1e-6f, kRight, 0, 0},
      {67.8f, 1e-6f, kRight, 0.3f, 0},
      {1e-6f, 1e-6f, kRight, kRight, 0.3f},
      {1e-6f, 100, 0, kRight, 0},
      {100, 1e-6f, 0, kRight, 0},
      {0.5f, 1e-6f, 0.7f, kRight, 1},
  };
  on_every_isa([&] {
    for (const Parameters& p : rows)
      for (Warp warp : kWarps)
        for (Way way : {Way::constants, Way::tilted}) {
          SCOPED_TRACE("row " + std::to_string(&p - rows) + " way " + std::to_string(int(way)));
          with_surface(way, p, kCount, [&](const auto& surface) { expect_sound(batch, warp, surface); });
        }
  });
}

// Any angles, and roughness at the corners of the domain.
TEST(Ellipsoids, OfTheCornersOfTheDomain) {
  const Batch batch(kCount, false);
  Random random(2);
  on_every_isa([&] {
    for (int row = 0; row < 40; ++row) {
      static const float corners[] = {1e-6f, 1e-5f, 1e-3f, 1, 100}, angles[] = {0, 0.3f, kRight, -kRight, 3.1f, -2};
      auto corner = [&] { return corners[random.below(std::size(corners))]; };
      auto angle = [&] { return angles[random.below(std::size(angles))]; };
      Parameters p{corner(), corner(), angle(), angle(), angle()};
      char text[100];
      std::snprintf(text, sizeof text, "alpha %g %g theta %g %g %g", p.alpha_x, p.alpha_y, p.theta_x, p.theta_y,
                    p.theta_z);
      SCOPED_TRACE(text);
      for (Warp warp : kWarps)
        with_surface(Way::tilted, p, kCount, [&](const auto& surface) { expect_sound(batch, warp, surface); });
    }
  });
}

// What make_shape accepts can be computed with: normals of any proportions are unit vectors.
TEST(Shapes, ThatAreAcceptedGiveUnitNormals) {
  const Batch batch(kCount, false);
  std::size_t accepted = 0;
  on_every_isa([&] {
    for (int x = -40; x <= 40; x += 4)
      for (int y = -40; y <= 40; y += 4)
        for (float lean : {0.f, 0.5f, 0x1p12f, 0x1p24f, 0x1p36f}) {
          const float rows[9] = {std::ldexp(1.f, x), 0, 0, lean, std::ldexp(1.f, y), 0, -lean, lean, 1};
          Shape shape;
          if (make_shape(rows, shape) != ShapeError::none) continue;
          ++accepted;
          Directions wm(1 << 9);
          for (Warp warp : kWarps) {
            sample_normals(warp, wm.size(), batch.wo.in(), shape, batch.pairs(), wm.out());
            for (std::size_t i = 0; i < wm.size(); ++i)
              ASSERT_TRUE(is_unit(wm.at(i)) && wm.z[i] >= 0) << kWarpNames[int(warp)] << " diagonal 2^" << x << " 2^"
                                                             << y << ", lean " << lean << ": " << batch.at(i);
          }
        }
  });
  // Those of all roughness that is promised are among them.
  Shape shape;
  for (float x : {1e-6f, 1.f, 100.f})
    for (float y : {1e-6f, 1.f, 100.f}) EXPECT_EQ(make_shape({x, 0, 0, 0, y, 0, 0, 0, 1}, shape), ShapeError::none);
  EXPECT_GT(accepted, 100u);
}

TEST(Shapes, LiteralOfExtremeProportions) {
  const Batch batch(kCount, false);
  on_every_isa([&] {
    Shape shape;
    if (make_shape({1, 0, 0, 0, 0x1p20f, 0, 0, 0, 1}, shape) != ShapeError::none) return;
    for (Warp warp : kWarps) {
      Directions wm(kCount);
      sample_normals(warp, wm.size(), batch.wo.in(), shape, batch.pairs(), wm.out());
      for (std::size_t i = 0; i < wm.size(); ++i) ASSERT_TRUE(is_unit(wm.at(i))) << batch.at(i);
    }
  });
}

}  // namespace
}  // namespace vndf::edges
