// Literal input, literal output: what a person can check with a pencil. Start here.
#include <gtest/gtest.h>

#include <vndf/ellipsoid.h>

namespace vndf {
namespace {

constexpr float kNear = 1e-6f;
constexpr float kPi = 3.14159265f;

struct Direction {
  float x = 7, y = 7, z = 7;
  Out3 out() { return {&x, &y, &z}; }
};
void expect_near(const Direction& found, const Direction& expected) {
  EXPECT_NEAR(found.x, expected.x, kNear);
  EXPECT_NEAR(found.y, expected.y, kNear);
  EXPECT_NEAR(found.z, expected.z, kNear);
}

// The radius of u is sqrt(u1), the angle u2 turns: half way out, half a turn.
TEST(ByEye, DiskPolar) {
  float x, y;
  sample_disk(DiskMap::polar, 1, {0.25f, 0.5f}, {&x, &y});
  EXPECT_NEAR(x, -0.5, kNear);
  EXPECT_NEAR(y, 0, kNear);
}

// Concentric squares become concentric circles: the centre, the middles of two sides, half way to a third, a corner.
TEST(ByEye, DiskConcentric) {
  const float u1[] = {0.5f, 1, 0.5f, 0.25f, 1}, u2[] = {0.5f, 0.5f, 1, 0.5f, 1};
  const float expected_x[] = {0, 1, 0, -0.5f, 0.70710678f}, expected_y[] = {0, 0, 1, 0, 0.70710678f};
  float x[5], y[5];
  sample_disk(DiskMap::concentric, 5, {u1, u2}, {x, y});
  for (int i = 0; i < 5; ++i) {
    EXPECT_NEAR(x[i], expected_x[i], kNear) << i;
    EXPECT_NEAR(y[i], expected_y[i], kNear) << i;
  }
}

// Seen along the normal, the disk's first axis is y. Half of the area has a slope under 1: (0, 1, 1) / sqrt(2). An
// alpha_y of 1/2 halves the slope: (0, 1, 2) / sqrt(5).
TEST(ByEye, NormalOfAViewFromAbove) {
  Direction round, flat;
  sample_normals(Warp::polar, 1, {0, 0, 1}, {1, 1}, {0.5f, 0}, round.out());
  sample_normals(Warp::polar, 1, {0, 0, 1}, {1, 0.5f}, {0.5f, 0}, flat.out());
  expect_near(round, {0, 0.70710678f, 0.70710678f});
  expect_near(flat, {0, 0.44721360f, 0.89442719f});
}

// Seen from the edge, the visible quarter of the unit sphere is half a disk, whose upper end is +z: the centre of u is
// the middle, at a height of 1/2. The cap's top is the half vector of the view and +z.
TEST(ByEye, NormalOfAViewFromTheEdge) {
  Direction disk, cap;
  sample_normals(Warp::concentric, 1, {1, 0, 0}, {1, 1}, {0.5f, 0.5f}, disk.out());
  sample_normals(Warp::spherical_cap, 1, {1, 0, 0}, {1, 1}, {0, 0}, cap.out());
  expect_near(disk, {0.86602540f, 0, 0.5f});
  expect_near(cap, {0.70710678f, 0, 0.70710678f});
}

// Without roughness a surface is a mirror, whatever the random numbers say.
TEST(ByEye, Mirror) {
  Direction wi;
  float pdf, weight;
  sample_reflection(Warp::polar, 1, {0.6f, 0, 0.8f}, {0, 0}, {0.3f, 0.6f}, {wi.out(), &pdf, &weight});
  expect_near(wi, {-0.6f, 0, 0.8f});
  EXPECT_EQ(pdf, 0x1p60f);  // what stands for a delta
  EXPECT_NEAR(weight, 1, kNear);
}

// From above and straight back nothing is masked: D = 1 / (pi alpha^2), and a fourth of that for light.
TEST(ByEye, DensityStraightBack) {
  Direction wi;
  float of_normal, f_cos, pdf, sampled_pdf, weight;
  pdf_normals(1, {0, 0, 1}, {0, 0, 1}, {0.5f, 0.5f}, &of_normal);
  evaluate_reflection(1, {0, 0, 1}, {0, 0, 1}, {0.5f, 0.5f}, {&f_cos, &pdf});
  sample_reflection(Warp::concentric, 1, {0, 0, 1}, {0.5f, 0.5f}, {0.5f, 0.5f}, {wi.out(), &sampled_pdf, &weight});
  EXPECT_NEAR(of_normal, 4 / kPi, kNear);
  EXPECT_NEAR(f_cos, 1 / kPi, kNear);
  EXPECT_NEAR(pdf, 1 / kPi, kNear);
  expect_near(wi, {0, 0, 1});
  EXPECT_NEAR(sampled_pdf, 1 / kPi, kNear);
  EXPECT_NEAR(weight, 1, kNear);
}

// alpha = 1 is the sphere: D = 1 / pi and Lambda = (1 / cos - 1) / 2. At cos = 4/5 that is 1/8, so that G1 = 8/9,
// G2 = 4/5 if heights are correlated, and 64/81 if not. f_cos is D G2 / (4 cos), pdf is D G1 / (4 cos).
TEST(ByEye, SphereSeenFromTheSide) {
  float f_cos, pdf, separable, same;
  evaluate_reflection(1, {0.6f, 0, 0.8f}, {-0.6f, 0, 0.8f}, {1, 1}, {&f_cos, &pdf});
  evaluate_reflection(1, {0.6f, 0, 0.8f}, {-0.6f, 0, 0.8f}, {1, 1}, {&separable, &same}, {Masking::separable, false});
  EXPECT_NEAR(f_cos, 1 / (4 * kPi), kNear);
  EXPECT_NEAR(pdf, 10 / (9 * 4 * kPi), kNear);
  EXPECT_NEAR(separable, 80 / (81 * 4 * kPi), kNear);
  EXPECT_EQ(same, pdf);
}

// Glass reflects ((1.5 - 1) / (1.5 + 1))^2 = 4 % of what comes straight: the third random number chooses.
TEST(ByEye, GlassFromAbove) {
  const float choice[] = {0.0399f, 0.0401f};
  float x[2], y[2], z[2], pdf[2], weight[2], side[2];
  sample_dielectric(Warp::polar, 2, {0, 0, 1}, {0, 0}, 1.5f, {0.3f, 0.6f, choice}, {{x, y, z}, pdf, weight, side});
  EXPECT_EQ(side[0], 1);
  expect_near({x[0], y[0], z[0]}, {0, 0, 1});
  EXPECT_EQ(side[1], -1);
  expect_near({x[1], y[1], z[1]}, {0, 0, -1});
}

// Snell: a sine of 0.6 becomes 0.6 / 1.5 = 0.4 below. From below a sine of 0.8 would become 1.2: all is reflected.
TEST(ByEye, GlassFromTheSide) {
  const float wo_x[] = {0.6f, 0.8f}, wo_z[] = {0.8f, -0.6f};
  float x[2], y[2], z[2], pdf[2], weight[2], side[2];
  sample_dielectric(Warp::polar, 2, {wo_x, 0, wo_z}, {0, 0}, 1.5f, {0.3f, 0.6f, 0.99f}, {{x, y, z}, pdf, weight, side});
  EXPECT_EQ(side[0], -1);
  expect_near({x[0], y[0], z[0]}, {-0.4f, 0, -0.91651514f});
  EXPECT_EQ(side[1], 1);
  expect_near({x[1], y[1], z[1]}, {-0.8f, 0, -0.6f});
}

// An ellipsoid turned by a right angle has its axes exchanged. Nearly smooth, and leaning by theta_y = 0.1, all of its
// normals are (-sin 0.1, 0, cos 0.1).
TEST(ByEye, EllipsoidTurnedAndLeaning) {
  float exchanged, turned;
  pdf_normals(1, {0.6f, 0, 0.8f}, {0.28f, 0, 0.96f}, {0.2f, 0.7f}, &exchanged);
  pdf_normals(1, {0.6f, 0, 0.8f}, {0.28f, 0, 0.96f}, Ellipsoid({0.7f, 0.2f}, 0, 0, kPi / 2), &turned);
  EXPECT_NEAR(turned, exchanged, 1e-5f * exchanged);
  Direction wm;
  sample_normals(Warp::concentric, 1, {0, 0, 1}, Ellipsoid({1e-6f, 1e-6f}, 0, 0.1f), {0.5f, 0.5f}, wm.out());
  expect_near(wm, {-0.09983342f, 0, 0.99500417f});
}

}  // namespace
}  // namespace vndf
