// What the tests of the edges of the domain share: surfaces in every way that the library takes them, directions, and
// what results have to be whatever the inputs are.
#pragma once

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "ellipsoid/model.h"
#include "reference/errors.h"
#include "reference/random.h"
#include "shading/sphere.h"
#include "support/bits.h"

namespace vndf::edges {

using namespace shading;
using ellipsoid::Parameters;
using reference::kEps;
using reference::Random;
using testing::on_every_isa;

/// The largest density: its square is finite, and so is the sum of two of them.
constexpr float kLargestPdf = 0x1p60f;

/// How a surface is given: plain GGX without the angles; an ellipsoid by constants, by a column of theta_z alone or by
/// columns of all angles; a matrix.
enum class Way { plain, constants, turned, tilted, matrix };
constexpr Way kWays[] = {Way::plain, Way::constants, Way::turned, Way::tilted, Way::matrix};

/// f(surface) with what the functions take: Columns2, an Ellipsoid or a Shape.
template <class F>
void with_surface(Way way, const Parameters& p, std::size_t count, F f) {
  const Columns2 alpha{p.alpha_x, p.alpha_y};
  std::vector<float> x(count, p.theta_x), y(count, p.theta_y), z(count, p.theta_z);
  switch (way) {
    case Way::plain:
      return f(alpha);
    case Way::constants:
      return f(p.ellipsoid());
    case Way::turned:
      return f(Ellipsoid(alpha, 0.f, 0.f, z.data()));
    case Way::tilted:
      return f(Ellipsoid(alpha, x.data(), y.data(), z.data()));
    case Way::matrix:
      break;
  }
  auto a = ellipsoid::matrix<double>(p);
  const float rows[9] = {float(a.c1.x), float(a.c2.x), float(a.c3.x), float(a.c1.y), float(a.c2.y),
                         float(a.c3.y), float(a.c1.z), float(a.c2.z), float(a.c3.z)};
  Shape shape;
  // What make_shape refuses is no surface.
  if (make_shape(rows, shape) == ShapeError::none) f(shape);
}

inline double length(const V3<double>& v) {
  return std::sqrt(dot(v, v));
}
inline double distance(const V3<double>& a, const V3<double>& b) {
  return length(a + -1. * b);
}
inline bool finite(const V3<double>& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
inline bool is_unit(const V3<double>& v, double eps = 5) {
  return std::fabs(length(v) - 1) <= eps * kEps;
}

/// A direction of this height.
inline V3<double> direction_at(Random& random, double z) {
  double phi = random.uniform(0, 2 * kPi<double>), s = std::sqrt((1 - z) * (1 + z));
  return {s * std::cos(phi), s * std::sin(phi), z};
}
/// Views as scenes have them, with the edges among them: along the normal, close to it, on the horizon.
inline V3<double> any_view(Random& random) {
  switch (random.below(6)) {
    case 0:
      return direction_at(random, 0);
    case 1:
      return direction_at(random, random.log_uniform(1e-30, 1e-3));
    case 2:
      return {0, 0, 1};
    case 3: {
      double s = random.log_uniform(1e-12, 1e-2);
      return direction_at(random, std::sqrt(1 - s * s));
    }
    default:
      return direction_at(random, random.uniform(0, 1));
  }
}
/// Any number of [0, 1], its ends and what is next to them more often than not.
inline float any_number(Random& random) {
  static const float edges[] = {0.f, 0x1p-32f, 0x1p-24f, 0x1p-12f, 0.5f, 1 - 0x1p-12f, 1 - 0x1p-24f, 1.f};
  if (random.below(2)) return random.unit();
  return random.below(3) ? edges[random.below(std::size(edges))] : 1 - float(1 + random.below(64)) * float(kEps);
}

/// What a density and a weight are in every case.
inline bool bounded_result(float pdf, float weight) {
  return pdf >= 0 && pdf <= kLargestPdf && weight >= 0 && weight <= 1;
}

/// Views at the edges and three random numbers each, above the surface or on both sides.
struct Batch {
  Directions wo;
  Numbers u;

  Batch(std::size_t count, bool both_sides) : wo(count), u(count, 1) {
    for (std::size_t i = 0; i < count; ++i) {
      Random random(2, i);
      V3<double> v = any_view(random);
      if (both_sides && random.below(2)) v.z = -v.z;
      wo.set(i, v);
      for (auto* column : {&u.a, &u.b, &u.c}) (*column)[i] = any_number(random);
    }
  }
  std::size_t size() const { return wo.size(); }
  Columns2 pairs() const { return {u.a.data(), u.b.data()}; }
  std::string at(std::size_t i) const {
    char text[200];
    std::snprintf(text, sizeof text, "wo %a %a %a u %a %a %a", wo.x[i], wo.y[i], wo.z[i], u.a[i], u.b[i], u.c[i]);
    return text;
  }
};

/// The two heuristics, as renderers write them, for a density and what another technique has.
inline bool survives_mis(float pdf) {
  for (float other : {0.f, 1e-20f, 1.f, 1e10f, kLargestPdf}) {
    if (pdf + other == 0) continue;
    float balance = pdf / (pdf + other), power = pdf * pdf / (pdf * pdf + other * other);
    if (pdf * pdf + other * other == 0) power = 0;  // both under the root of the smallest number
    if (!(balance >= 0 && balance <= 1 && power >= 0 && power <= 1)) return false;
  }
  return true;
}

inline void expect_finite(const Samples& s, const Values& value, const Batch& batch, const std::string& what) {
  for (std::size_t i = 0; i < batch.size(); ++i) {
    ASSERT_TRUE(finite(s.wi.at(i)) && bounded_result(s.pdf[i], s.weight[i]) && survives_mis(s.pdf[i]))
        << what << ": " << batch.at(i) << ": " << s.pdf[i] << " " << s.weight[i];
    ASSERT_TRUE(value.f_cos[i] >= 0 && std::isfinite(value.f_cos[i]) && value.pdf[i] >= 0 &&
                value.pdf[i] <= kLargestPdf && survives_mis(value.pdf[i]))
        << what << ": " << batch.at(i) << ": " << value.f_cos[i] << " " << value.pdf[i];
  }
}

}  // namespace vndf::edges
