// The accuracy of the ellipsoid NDF against Walter's plain equations 34-47 in quadruple precision, and the identities
// with plain GGX. Errors are in eps = 2^-24.
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>

#include <gtest/gtest.h>

#include <vndf/lanes.h>

#include "ellipsoid/cases.h"
#include "reference/errors.h"
#include "support/bits.h"

namespace vndf::ellipsoid {
namespace {

using reference::Inputs;
using reference::keep_larger;
using reference::kEps;
using testing::same_bits;
using testing::Table;

// |theta| <= pi.
TEST(Angle, Accuracy) {
  double worst = 0, worst_length = 0, worst_turn = 0, worst_small = 0;
  const lanes::Vec3<float> v{0.6f, 0.8f, 0};
  for (int i = -2000000; i <= 2000000; ++i) {
    float theta = float(double(i) / 2000000 * kPi<double>);
    auto angle = lanes::angle_of<double>(theta);
    keep_larger(worst, std::hypot(angle.cos - std::cos(double(theta)), angle.sin - std::sin(double(theta))));
    keep_larger(worst_length, std::fabs(std::hypot(angle.cos, angle.sin) - 1));
    double c = std::cos(double(theta)), s = std::sin(double(theta));
    auto turned = lanes::turn(v, lanes::rotation_of(theta));
    double x = c * v.x - s * v.y, y = s * v.x + c * v.y;
    keep_larger(worst_turn, std::hypot(turned.x - x, turned.y - y));
    if (std::fabs(x) < 0.0625) keep_larger(worst_small, std::fabs(turned.x - x));
    if (std::fabs(y) < 0.0625) keep_larger(worst_small, std::fabs(turned.y - y));
  }
  std::printf("angle: %.3f eps, length %.3f, turned vector %.3f, its small components %.3f\n", worst / kEps,
              worst_length / kEps, worst_turn / kEps, worst_small / kEps);
  EXPECT_LE(worst, 0.4 * kEps);
  EXPECT_LE(worst_turn, 2.5 * kEps);
  EXPECT_LE(worst_small, 0.6 * kEps);
  auto zero = lanes::angle_of<double>(0.f);
  EXPECT_EQ(zero.cos, 1);
  EXPECT_EQ(zero.sin, 0);
}

/// How far the normal moves when each of view, alpha and theta moves by half a unit of its last place.
double conditioning(Warp warp, const Inputs& in, const Angles& theta, std::size_t i) {
  Vec3<float> wo{in.wo_x[i], in.wo_y[i], in.wo_z[i]};
  Parameters p = parameters(in, theta, i);
  const float u[2] = {in.u_x[i], in.u_y[i]};
  auto at = exact_normal(warp, wo, p, u);
  double sum = 0;
  for (float* value : {&wo.x, &wo.y, &wo.z, &p.alpha_x, &p.alpha_y, &p.theta_x, &p.theta_y, &p.theta_z}) {
    float kept = *value;
    *value = std::nextafter(kept, 1e30f);
    sum += distance(exact_normal(warp, wo, p, u), at) / 2;
    *value = kept;
  }
  return sum;
}

struct Bounds {
  double mean, p999, max;
};
// Those of plain GGX (../accuracy_test.cpp), with the same exception: what twice the conditioning explains.
constexpr Bounds kUpright = {1.2, 8, 40}, kUprightCap = {1.3, 8, 40};
// Beyond half a radian A wo comes close to -A n, where the normal's third component is small.
constexpr Bounds kAnyAngle = {1.3, 40, 250};

class Accuracy : public ::testing::TestWithParam<std::tuple<int, std::size_t>> {
 protected:
  static Bounds bounds(Warp warp, const Case& c) {
    if (c.lean > 0.5) return kAnyAngle;
    return warp == Warp::spherical_cap ? kUprightCap : kUpright;
  }
};
INSTANTIATE_TEST_SUITE_P(, Accuracy,
                         ::testing::Combine(::testing::Range(0, 3), ::testing::Range(std::size_t(0), cases().size())),
                         [](const auto& info) {
                           return std::string(kWarpNames[std::get<0>(info.param)]) + "_" +
                                  cases()[std::get<1>(info.param)].inputs.name;
                         });

TEST_P(Accuracy, Normals) {
  constexpr std::size_t kCount = std::size_t(1) << 17;
  Warp warp = kWarps[std::get<0>(GetParam())];
  Case c = cases()[std::get<1>(GetParam())];
  Inputs in = generate(c.inputs, warp, kCount, 11);
  Angles theta(kCount, c.lean, 12);
  Directions wm(kCount);
  sample_normals(warp, kCount, in.wo(), theta.with(in.alpha()), in.u(), wm.out());
  std::vector<double> errors(kCount);
  double over_conditioning = 0, unexcused = 0, opposite = 0;
  Bounds bound = bounds(warp, c);
  for (std::size_t i = 0; i < kCount; ++i) {
    double error = errors[i] = reference::or_infinite(distance(wm.at(i), exact_normal(warp, in, theta, i)) / kEps);
    auto a = matrix<double>(parameters(in, theta, i));
    Vec3<double> psi{in.wo_x[i], in.wo_y[i], in.wo_z[i]};
    if (dot(unit(a * psi), unit(a.c3)) < -0.999) keep_larger(opposite, error);
    if (error <= 10) continue;
    double moved = conditioning(warp, in, theta, i) / kEps;
    keep_larger(over_conditioning, error / (1 + moved));
    if (!(error <= 2 * moved)) keep_larger(unexcused, error);
  }
  double mean = 0;
  for (double e : errors) mean += e / double(kCount);
  std::sort(errors.begin(), errors.end());
  double p999 = errors[kCount - 1 - kCount / 1000];
  std::printf(
      "%s %s: mean %.2f, p99.9 %.1f, max %.1f eps, %.1f times conditioning; unexcused %.1f; A wo within 0.045 of "
      "-A n: %.1f\n",
      kWarpNames[std::get<0>(GetParam())], c.inputs.name, mean, p999, errors.back(), over_conditioning, unexcused,
      opposite);
  EXPECT_LE(mean, bound.mean);
  EXPECT_LE(p999, bound.p999);
  EXPECT_LE(unexcused, bound.max);
}

// Densities and weights for given directions, against the plain formulas in long double: relatively, the density of
// normals times wo.wm, and a sample's weight for the wi that it has. As for plain GGX 25 eps; but h = wo + wi and wm
// are rounded by component, which A^-T mixes, and D magnifies what that loses by 2 / alpha, or what alpha above 1 makes
// of the angles.
TEST(Densities, Accuracy) {
  using R = long double;
  constexpr std::size_t kCount = std::size_t(1) << 14;
  std::vector<Case> rows_of_inputs = cases();
  rows_of_inputs.push_back(alpha_up_to_100());
  for (const Case& c : rows_of_inputs)
    for (Warp warp : kWarps) {
      Inputs in = generate(c.inputs, warp, kCount, 13);
      Angles theta(kCount, c.lean, 14);
      Ellipsoid e = theta.with(in.alpha());
      Samples s(kCount);
      Values value(kCount);
      std::vector<float> pdf(kCount);
      sample_reflection(warp, kCount, in.wo(), e, in.u(), s.with_normals());
      evaluate_reflection(kCount, in.wo(), s.wi.in(), e, value.out());
      pdf_normals(kCount, in.wo(), s.wm.in(), e, pdf.data());
      struct {
        const char* what;
        double bound, worst;
      } rows[] = {{"pdf of normals", 1, 0}, {"evaluated pdf", 1, 0}, {"f cos", 1, 0}, {"weight", 0.5, 0}};
      for (std::size_t i = 0; i < kCount; ++i) {
        Vec3<R> wo{in.wo_x[i], in.wo_y[i], in.wo_z[i]}, wm = s.wm.at<R>(i), wi = s.wi.at<R>(i);
        if (std::fabs(dot(wo, wo) - 1) > 1e-6L) continue;
        auto a = matrix<R>(parameters(in, theta, i));
        auto [smaller, larger] = std::minmax(in.alpha_x[i], in.alpha_y[i]);
        R scale =
            std::fmax(R(25), larger <= 1 ? 4 + 2 / R(smaller) : 12 + 6 * R(larger) / std::fmin(R(1), R(smaller))) *
            R(kEps);
        auto keep = [&](int k, R error) { keep_larger(rows[k].worst, double(std::fabs(error) / scale)); };
        // The library's density is homogeneous in wm but for the cosine.
        R length = std::sqrt(dot(wm, wm)), cos = dot(wo, wm);
        if (!(cos <= 1e-6L)) keep(0, (pdf[i] / (normal_pdf(wo, (1 / length) * wm, a) * length) - 1) * cos);
        if (s.pdf[i] <= 0) continue;
        Vec3<R> h = unit(wo + wi);
        R exact = ndf(h, a) * ellipsoid_area(Vec3<R>{0, 0, 1}, a) / (4 * lune_area(wo, a));
        R f = ndf(h, a) * g1(wo, a) * g1(wi, a) / (4 * wo.z);
        keep(1, value.pdf[i] / exact - 1);
        keep(2, value.f_cos[i] / f - 1);
        keep(3, s.weight[i] / (f / exact) - 1);
      }
      for (const auto& row : rows)
        EXPECT_LE(row.worst, row.bound) << row.what << ", " << kWarpNames[int(warp)] << " " << c.inputs.name;
    }
}

/// Inputs of plain GGX, and angles by the same names as the functions take them.
struct Batch {
  Inputs in;
  Angles theta;

  Batch(const char* name, std::size_t count, std::uint64_t seed) : in(0), theta(0, 0, 0) {
    for (const Case& c : cases())
      if (c.inputs.name == std::string(name)) {
        in = generate(c.inputs, Warp::polar, count, seed);
        theta = Angles(count, c.lean, seed + 1);
      }
  }
  Columns3 wo() const { return in.wo(); }
  Columns2 alpha() const { return in.alpha(); }
  Columns2 u() const { return in.u(); }
};

// theta_x = theta_y = 0 is plain GGX in a frame turned about n, sample by sample, whichever way the angles are given;
// straight from above too, where only the frame says which azimuth is which.
TEST(Identity, TurnedFrame) {
  constexpr std::size_t kCount = 1 << 14;
  const Columns2 alpha{0.2f, 0.5f};
  std::vector<float> zeros(kCount);
  for (float theta : {0.7f, 2.f, -3.f})
    for (Warp warp : kWarps) {
      Batch in("typical", kCount, 8);
      for (std::size_t i = 0; i < 64; ++i) in.in.wo_x[i] = 0, in.in.wo_y[i] = 0, in.in.wo_z[i] = 1;
      M3<double> turn = rotation<double>(0, 0, theta);
      Directions turned_wo(kCount), plain(kCount), other(kCount);
      for (std::size_t i = 0; i < kCount; ++i)
        turned_wo.set(i, turn * Vec3<double>{in.in.wo_x[i], in.in.wo_y[i], in.in.wo_z[i]});
      sample_normals(warp, kCount, turned_wo.in(), alpha, in.u(), plain.out());
      std::vector<float> column(kCount, theta);
      for (const Ellipsoid& ellipsoid : {Ellipsoid(alpha, 0.f, 0.f, theta), Ellipsoid(alpha, 0.f, 0.f, column.data()),
                                         Ellipsoid(alpha, zeros.data(), zeros.data(), column.data())}) {
        sample_normals(warp, kCount, in.wo(), ellipsoid, in.u(), other.out());
        double bound = 40 * kEps;
        for (std::size_t i = 0; i < kCount; ++i)
          ASSERT_LE(distance(transposed_times(turn, plain.at(i)), other.at(i)), bound) << theta << " " << i;
      }
    }
}

// c A and Q A: the same normals, the same densities.
TEST(Invariance, FactorsAndOrthogonalMatrices) {
  constexpr std::size_t kCount = 1 << 12;
  Batch in("typical", kCount, 9);
  for (const Parameters& p : {Parameters{0.3f, 0.5f, 0.2f, -0.4f, 1.f}, Parameters{0.1f, 0.6f, -0.5f, 0.3f, 2.f}}) {
    auto shape_of = [&](double c, double turn) {
      M3<double> a = rotation<double>(turn, -turn / 2, turn) * matrix<double>(p);
      const float rows[9] = {float(c * a.c1.x), float(c * a.c2.x), float(c * a.c3.x),
                             float(c * a.c1.y), float(c * a.c2.y), float(c * a.c3.y),
                             float(c * a.c1.z), float(c * a.c2.z), float(c * a.c3.z)};
      Shape shape;
      EXPECT_EQ(make_shape(rows, shape), ShapeError::none);
      return shape;
    };
    for (Warp warp : kWarps) {
      Directions expected(kCount), normals(kCount);
      std::vector<float> densities(kCount), pdf(kCount);
      sample_normals(warp, kCount, in.wo(), shape_of(1, 0), in.u(), expected.out());
      pdf_normals(kCount, in.wo(), expected.in(), p.ellipsoid(), densities.data());
      for (double c : {1., 1e-20, 1e15})
        for (double turn : {0., 0.4, 2., 3.}) {
          Shape shape = shape_of(c, turn);
          sample_normals(warp, kCount, in.wo(), shape, in.u(), normals.out());
          pdf_normals(kCount, in.wo(), expected.in(), shape, pdf.data());
          for (std::size_t i = 0; i < kCount; ++i) {
            ASSERT_LE(distance(normals.at(i), expected.at(i)), 4000 * kEps) << turn;
            ASSERT_NEAR(pdf[i], densities[i], 2e-4 * densities[i] + 1e-6);
          }
        }
      sample_normals(warp, kCount, in.wo(), p.ellipsoid(), in.u(), normals.out());
      for (std::size_t i = 0; i < kCount; ++i) ASSERT_LE(distance(normals.at(i), expected.at(i)), 4000 * kEps);
    }
  }
}

TEST(MakeShape, Errors) {
  Shape shape;
  auto error = [&](std::array<float, 9> a) {
    float rows[9];
    std::copy(a.begin(), a.end(), rows);
    return make_shape(rows, shape);
  };
  EXPECT_EQ(error({1, 0, 0, 0, 1, 0, 0, 0, 1}), ShapeError::none);
  EXPECT_EQ(error({1e-30f, 0, 0, 0, 1e-30f, 0, 0, 0, 1e-30f}), ShapeError::none);
  EXPECT_EQ(error({0, 0, 0, 0, 0, 0, 0, 0, 0}), ShapeError::not_positive);
  EXPECT_EQ(error({-1, 0, 0, 0, 1, 0, 0, 0, 1}), ShapeError::not_positive);
  EXPECT_EQ(error({1, 2, 3, 2, 4, 6, 0, 0, 1}), ShapeError::not_positive);
  EXPECT_EQ(error({1, 2, 3, 4, 5, 6, 7, 8, 9}), ShapeError::not_positive);
  EXPECT_EQ(error({NAN, 0, 0, 0, 1, 0, 0, 0, 1}), ShapeError::not_finite);
  EXPECT_EQ(error({1, 0, 0, 0, INFINITY, 0, 0, 0, 1}), ShapeError::not_finite);
  EXPECT_EQ(error({1e-25f, 0, 0, 0, 1e-25f, 0, 0, 0, 1}), ShapeError::out_of_range);
  for (float x : {0x1p-26f, 0x1p26f}) EXPECT_EQ(error({x, 0, 0, 0, 1, 0, 0, 0, 1}), ShapeError::none) << x;
  for (float x : {0x1p-27f, 0x1p27f}) EXPECT_EQ(error({x, 0, 0, 0, 1, 0, 0, 0, 1}), ShapeError::out_of_range) << x;
  EXPECT_EQ(error({1, 0, 0, 0, 1, 0, 0x1p26f, 0, 1}), ShapeError::none);
  EXPECT_EQ(error({1, 0, 0, 0, 1, 0, 0x1p27f, 0, 1}), ShapeError::out_of_range);
  // A column next to the plane of the others.
  EXPECT_EQ(error({1, 0, 0, 0, 1, 0, 0x1p20f, 0x1p19f, 1}), ShapeError::none);
  EXPECT_EQ(error({1, 0, 0, 0, 1, 0, 0x1p20f, 0x1p21f, 1}), ShapeError::not_positive);
  for (auto e : {ShapeError::none, ShapeError::not_finite, ShapeError::not_positive, ShapeError::out_of_range})
    EXPECT_GT(std::string(message(e)).size(), 5u);
}

// What is not taken changes nothing.
TEST(MakeShape, LeavesTheShapeThatItDoesNotTake) {
  const float good[9] = {0.3f, 0, 0, 0.1f, 0.5f, 0, 0, 0.2f, 1};
  Shape shape, before;
  ASSERT_EQ(make_shape(good, before), ShapeError::none);
  for (const std::array<float, 9>& a : {std::array<float, 9>{NAN, 0, 0, 0, 1, 0, 0, 0, 1},
                                        {1, 2, 3, 4, 5, 6, 7, 8, 9},
                                        {1e-25f, 0, 0, 0, 1, 0, 0, 0, 1}}) {
    float rows[9];
    std::copy(a.begin(), a.end(), rows);
    shape = before;
    ASSERT_NE(make_shape(rows, shape), ShapeError::none);
    EXPECT_EQ(std::memcmp(&shape, &before, sizeof shape), 0);
  }
}

// Azimuths of a view along n count from the normal of A y and A n, of the matrix as it is given.
TEST(MakeShape, AzimuthsOfNormalViews) {
  for (double theta_z : {0., 0.7, -2.}) {
    M3<double> a = matrix<double>({0.3f, 0.6f, 0.4f, -0.3f, float(theta_z)});
    const float rows[9] = {float(a.c1.x), float(a.c2.x), float(a.c3.x), float(a.c1.y), float(a.c2.y),
                           float(a.c3.y), float(a.c1.z), float(a.c2.z), float(a.c3.z)};
    Shape shape;
    ASSERT_EQ(make_shape(rows, shape), ShapeError::none);
    const Vec3<double> x = unit(cross(a.c2, a.c3)), z = unit(a.c3), y = cross(z, x);
    for (float u : {0.1f, 0.5f, 0.9f}) {
      // The disk's t1 is along y and its t2 along -x: Vh is z, T1 its azimuth turned by a quarter.
      Directions wm(1);
      sample_normals(Warp::polar, 1, {0, 0, 1}, shape, {u, 0}, wm.out());
      Vec3<double> nh = std::sqrt(double(u)) * y + std::sqrt(1 - double(u)) * z;
      EXPECT_LE(distance(wm.at(0), unit(transposed_times(a, nh))), 40 * kEps) << theta_z << " " << u;
    }
  }
}

}  // namespace
}  // namespace vndf::ellipsoid
