// The accuracy of the ellipsoid NDF against Walter's plain equations 34-47 in quadruple precision, and the identities
// with plain GGX. Errors are in eps = 2^-24.
#include <algorithm>
#include <array>
#include <cstdio>

#include <gtest/gtest.h>

#include <vndf/lanes.h>

#include "ellipsoid/model.h"
#include "reference/hard_cases.h"

namespace vndf::ellipsoid {
namespace {

using reference::Random;
constexpr double kEps = 0x1p-24;

// |theta| <= pi.
TEST(Angle, Accuracy) {
  double worst = 0, worst_length = 0;
  for (int i = -2000000; i <= 2000000; ++i) {
    float theta = float(double(i) / 2000000 * kPi<double>);
    auto angle = lanes::angle_of(theta);
    double cos = lanes::as<double>(angle.cos), sin = lanes::as<double>(angle.sin);
    worst = std::max(worst, std::hypot(cos - std::cos(double(theta)), sin - std::sin(double(theta))));
    worst_length = std::max(worst_length, std::fabs(std::hypot(cos, sin) - 1));
  }
  std::printf("angle: %.3f eps, length %.3f\n", worst / kEps, worst_length / kEps);
  EXPECT_LE(worst, 0.5 * kEps);
  auto zero = lanes::angle_of(0.f);
  EXPECT_EQ(lanes::as<float>(zero.cos), 1.f);
  EXPECT_EQ(lanes::as<float>(zero.sin), 0.f);
}

struct Batch {
  std::vector<float> column[10];  // wo, alpha, theta, u

  explicit Batch(std::size_t count) {
    for (auto& c : column) c.resize(count);
  }
  std::size_t size() const { return column[0].size(); }
  Columns3 wo() const { return {column[0].data(), column[1].data(), column[2].data()}; }
  Columns2 alpha() const { return {column[3].data(), column[4].data()}; }
  Ellipsoid ellipsoid() const { return {alpha(), column[5].data(), column[6].data(), column[7].data()}; }
  Columns2 u() const { return {column[8].data(), column[9].data()}; }
};

V3<double> exact_normal(Warp warp, const float (&in)[10]) {
  V3<Quad> psi{in[0], in[1], in[2]};
  M3<Quad> a = matrix<Quad>({in[3], in[4], in[5], in[6], in[7]});
  Quad u1 = in[8], u2 = in[9];
  auto m =
      warp == Warp::spherical_cap ? sample_cap(psi, a, u1, u2) : sample_version_3(psi, a, disk_point(warp, u1, u2));
  return {double(m.x), double(m.y), double(m.z)};
}
double distance(const V3<double>& a, const V3<double>& b) {
  auto d = a + -1. * b;
  return std::sqrt(dot(d, d));
}
/// How far the normal moves when each of view, alpha and theta moves by half a unit of its last place.
double conditioning(Warp warp, const float (&in)[10]) {
  auto at = exact_normal(warp, in);
  double sum = 0;
  for (int c = 0; c < 8; ++c) {
    float moved[10];
    std::copy(in, in + 10, moved);
    moved[c] = std::nextafter(in[c], 1e9f);
    sum += distance(exact_normal(warp, moved), at) / 2;
  }
  return sum;
}

struct Row {
  const char* name;
  double least_alpha, largest_alpha, largest_theta, least_cos, largest_cos;
};
constexpr Row kRows[] = {
    {"typical", 0.05, 1, 0.5, 0, 1},
    {"grazing", 0.05, 1, 0.5, 0, 1e-3},
    {"normal_incidence", 0.05, 1, 0.5, 0.999999, 1},
    {"small_alpha", 1e-3, 1e-2, 0.5, 0, 1},
    {"any_alpha", 1e-3, 1, 0.5, 0, 1},
    {"below_horizon", 0.05, 1, 0.5, -1, 0},
    {"any_angle", 0.05, 1, 3.1, 0, 1},
    {"any_angle_small_alpha", 1e-3, 1e-2, 3.1, 0, 1},
};

Batch inputs(const Row& row, std::size_t count, std::uint64_t seed) {
  Batch in(count);
  for (std::size_t i = 0; i < count; ++i) {
    Random random(seed, i);
    double cos = random.uniform(row.least_cos, row.largest_cos), sin = std::sqrt(1 - cos * cos);
    double phi = random.uniform(0, 2 * kPi<double>);
    const double values[] = {sin * std::cos(phi),
                             sin * std::sin(phi),
                             cos,
                             random.log_uniform(row.least_alpha, row.largest_alpha),
                             random.log_uniform(row.least_alpha, row.largest_alpha),
                             random.uniform(-row.largest_theta, row.largest_theta),
                             random.uniform(-row.largest_theta, row.largest_theta),
                             random.uniform(-3.1, 3.1)};
    for (int c = 0; c < 8; ++c) in.column[c][i] = float(values[c]);
    in.column[8][i] = random.unit();
    in.column[9][i] = random.unit();
  }
  return in;
}

class Accuracy : public ::testing::TestWithParam<std::tuple<int, int>> {};
INSTANTIATE_TEST_SUITE_P(
    , Accuracy, ::testing::Combine(::testing::Range(0, 3), ::testing::Range(0, int(sizeof kRows / sizeof *kRows))),
    [](const auto& info) {
      return std::string(kWarpNames[std::get<0>(info.param)]) + "_" + kRows[std::get<1>(info.param)].name;
    });

// The distance from the exact normal; over 1 + what half a unit in each input moves that normal by, too: with A n
// leaning, A wo is a sum that can cancel, which it does near the directions where A wo is perpendicular to A n.
TEST_P(Accuracy, Normals) {
  constexpr std::size_t kCount = std::size_t(1) << 13;
  Warp warp = kWarps[std::get<0>(GetParam())];
  const Row& row = kRows[std::get<1>(GetParam())];
  Batch in = inputs(row, kCount, 11);
  Directions wm(kCount);
  sample_normals(warp, kCount, in.wo(), in.ellipsoid(), in.u(), wm.out());
  std::vector<double> errors(kCount);
  double worst = 0, over_conditioning = 0, worst_opposite = 0;
  int opposite = 0;
  for (std::size_t i = 0; i < kCount; ++i) {
    float values[10];
    for (int c = 0; c < 10; ++c) values[c] = in.column[c][i];
    // There the cap's azimuth begins elsewhere, and which sample belongs to which u is another choice.
    if (warp == Warp::spherical_cap && matrix<double>({values[3], values[4], values[5], values[6], values[7]}).c3.z < 0)
      continue;
    double error = distance(wm.at(i), exact_normal(warp, values)) / kEps;
    errors[i] = error;
    worst = std::max(worst, error);
    auto a = matrix<double>({values[3], values[4], values[5], values[6], values[7]});
    if (dot(direction(a * V3<double>{values[0], values[1], values[2]}), direction(a.c3)) < -0.999) {
      ++opposite;
      worst_opposite = std::max(worst_opposite, error);
    }
    if (error > 10) over_conditioning = std::max(over_conditioning, error / (1 + conditioning(warp, values) / kEps));
  }
  double mean = 0;
  for (double e : errors) mean += e / double(kCount);
  std::sort(errors.begin(), errors.end());
  double p999 = errors[kCount - 1 - kCount / 1000];
  std::printf(
      "%s %s: mean %.2f, p99.9 %.1f, max %.1f eps; max over conditioning %.1f; %d with A psi "
      "within 0.045 of -A n, max %.1f\n",
      kWarpNames[std::get<0>(GetParam())], row.name, mean, p999, worst, over_conditioning, opposite, worst_opposite);
  if (warp == Warp::spherical_cap) return;
  EXPECT_LE(over_conditioning, 8);
  if (row.largest_theta <= 0.5 && row.least_alpha >= 0.05 && row.least_cos >= 0) {
    EXPECT_LE(mean, 2.2);
    EXPECT_LE(p999, 40);
    EXPECT_LE(worst, 160);
  }
}

// theta = 0. As constants: the bits of the plain functions with separable masking. As a column of theta_z, or columns
// of all: the same but for a few eps.
enum class Zero { constants, turned, tilted };
Ellipsoid without_angles(Zero zero, const Columns2& alpha, const std::vector<float>& zeros) {
  Column column = zeros.data(), constant = 0.f;
  Column leaning = zero == Zero::tilted ? column : constant;
  return {alpha, leaning, leaning, zero == Zero::constants ? constant : column};
}

TEST(Identity, PlainNormals) {
  constexpr std::size_t kCount = 1 << 14;
  std::vector<float> zeros(kCount);
  for (const auto& row : reference::hard_cases())
    for (Warp warp : kWarps) {
      auto in = reference::generate(row, warp, kCount, 5);
      Directions plain(kCount), other(kCount);
      sample_normals(warp, kCount, in.wo(), in.alpha(), in.u(), plain.out());
      for (Zero zero : {Zero::constants, Zero::turned, Zero::tilted}) {
        sample_normals(warp, kCount, in.wo(), without_angles(zero, in.alpha(), zeros), in.u(), other.out());
        double worst = 0;
        for (std::size_t i = 0; i < kCount; ++i) worst = std::max(worst, distance(plain.at(i), other.at(i)) / kEps);
        EXPECT_LE(worst, zero == Zero::tilted ? 4 : 0) << row.name << " " << int(zero);
      }
    }
}

TEST(Identity, PlainReflection) {
  constexpr std::size_t kCount = 1 << 16;
  ReflectionOptions options{Masking::separable, false};
  std::vector<float> zeros(kCount);
  for (int row : {0, 1, 3})
    for (Warp warp : kWarps)
      for (Zero zero : {Zero::constants, Zero::turned, Zero::tilted}) {
        Batch in = inputs(kRows[row], kCount, 6);
        Ellipsoid ellipsoid = without_angles(zero, in.alpha(), zeros);
        Samples plain(kCount), other(kCount);
        Values there(kCount), here(kCount);
        std::vector<float> pdf(kCount), other_pdf(kCount);
        sample_reflection(warp, kCount, in.wo(), in.alpha(), in.u(), plain.with_normals(), options);
        sample_reflection(warp, kCount, in.wo(), ellipsoid, in.u(), other.with_normals());
        evaluate_reflection(kCount, in.wo(), plain.wi.in(), in.alpha(), there.out(), options);
        evaluate_reflection(kCount, in.wo(), plain.wi.in(), ellipsoid, here.out());
        pdf_normals(kCount, in.wo(), plain.wm.in(), in.alpha(), pdf.data());
        pdf_normals(kCount, in.wo(), plain.wm.in(), ellipsoid, other_pdf.data());
        struct {
          const char* what;
          double worst, turned, tilted;
        } rows[] = {{"wi", 0, 0, 16},           {"wo.wm", 0, 0, 6}, {"pdf", 0, 0, 20},
                    {"evaluated pdf", 0, 0, 4}, {"f cos", 0, 4, 8}, {"pdf of normals", 0, 0, 4},
                    {"weight", 0, 4, INFINITY}};  // wi at the horizon makes any error of the weight
        auto keep = [&](int k, double a, double b) {
          if (a != b) rows[k].worst = std::max(rows[k].worst, std::fabs(a / b - 1) / kEps);
        };
        for (std::size_t i = 0; i < kCount; ++i) {
          rows[0].worst = std::max(rows[0].worst, distance(plain.wi.at(i), other.wi.at(i)) / kEps);
          rows[1].worst = std::max(rows[1].worst, std::fabs(double(plain.cos[i]) - other.cos[i]) / kEps);
          keep(2, other.pdf[i], plain.pdf[i]);
          keep(3, here.pdf[i], there.pdf[i]);
          keep(4, here.f_cos[i], there.f_cos[i]);
          keep(5, other_pdf[i], pdf[i]);
          keep(6, other.weight[i], plain.weight[i]);
        }
        for (const auto& r : rows) {
          EXPECT_LE(r.worst, zero == Zero::constants ? 0
                             : zero == Zero::turned  ? r.turned
                                                     : r.tilted)
              << r.what << " in " << kRows[row].name << ", " << int(zero);
        }
      }
}

// theta_x = theta_y = 0 is plain GGX in a frame turned about n.
TEST(Identity, TurnedFrame) {
  constexpr std::size_t kCount = 1 << 14;
  for (Warp warp : {Warp::polar, Warp::concentric}) {
    Batch in = inputs(kRows[0], kCount, 8);
    Directions turned_wo(kCount), plain(kCount), other(kCount);
    for (std::size_t i = 0; i < kCount; ++i)
      turned_wo.set(
          i, rotation<double>(0, 0, in.column[7][i]) * V3<double>{in.column[0][i], in.column[1][i], in.column[2][i]});
    sample_normals(warp, kCount, turned_wo.in(), in.alpha(), in.u(), plain.out());
    sample_normals(warp, kCount, in.wo(), Ellipsoid(in.alpha(), 0.f, 0.f, in.column[7].data()), in.u(), other.out());
    for (std::size_t i = 0; i < kCount; ++i) {
      auto back = transposed_times(rotation<double>(0, 0, in.column[7][i]), plain.at(i));
      ASSERT_LE(distance(back, other.at(i)), 200 * kEps) << i;
    }
  }
}

// c A and Q A: the same normals from the disk, the same densities.
TEST(Invariance, FactorsAndOrthogonalMatrices) {
  constexpr std::size_t kCount = 1 << 12;
  Batch in = inputs(kRows[0], kCount, 9);
  for (const Parameters& p : {Parameters{0.3f, 0.5f, 0.2f, -0.4f, 1.f}, Parameters{0.1f, 0.6f, -0.5f, 0.3f, 2.f}}) {
    Directions expected(kCount), normals(kCount);
    sample_normals(Warp::polar, kCount, in.wo(), p.ellipsoid(), in.u(), expected.out());
    std::vector<float> densities(kCount), pdf(kCount);
    pdf_normals(kCount, in.wo(), expected.in(), p.ellipsoid(), densities.data());
    for (double c : {1., 1e-20, 1e15})
      for (double turn : {0., 0.4, 2., 3.}) {
        M3<double> a = rotation<double>(turn, -turn / 2, 1) * matrix<double>(p);
        const float rows[9] = {float(c * a.c1.x), float(c * a.c2.x), float(c * a.c3.x),
                               float(c * a.c1.y), float(c * a.c2.y), float(c * a.c3.y),
                               float(c * a.c1.z), float(c * a.c2.z), float(c * a.c3.z)};
        Shape shape;
        ASSERT_EQ(make_shape(rows, shape), ShapeError::none);
        sample_normals(Warp::polar, kCount, in.wo(), shape, in.u(), normals.out());
        pdf_normals(kCount, in.wo(), expected.in(), shape, pdf.data());
        for (std::size_t i = 0; i < kCount; ++i) {
          ASSERT_LE(distance(normals.at(i), expected.at(i)), 4000 * kEps) << turn;
          ASSERT_NEAR(pdf[i], densities[i], 2e-4 * densities[i] + 1e-6);
        }
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
  for (auto e : {ShapeError::none, ShapeError::not_finite, ShapeError::not_positive, ShapeError::out_of_range})
    EXPECT_GT(std::string(message(e)).size(), 5u);
}

}  // namespace
}  // namespace vndf::ellipsoid
