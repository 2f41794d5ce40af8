// Batches in the tests' own shape.
#pragma once

#include <vector>

#include <vndf/vndf.h>

#include "reference/random.h"
#include "shading/model.h"
#include "support/operations.h"

namespace vndf::shading {

/// Directions as columns.
struct Directions {
  std::vector<float> x, y, z;

  explicit Directions(std::size_t count = 0) : x(count), y(count), z(count) {}
  std::size_t size() const { return x.size(); }
  Columns3 in() const { return {x.data(), y.data(), z.data()}; }
  Out3 out() { return {x.data(), y.data(), z.data()}; }
  template <class R = double>
  Vec3<R> at(std::size_t i) const {
    return {R(x[i]), R(y[i]), R(z[i])};
  }
  template <class R>
  void set(std::size_t i, const Vec3<R>& v) {
    x[i] = float(v.x);
    y[i] = float(v.y);
    z[i] = float(v.z);
  }
};

inline Vec3<double> direction_of(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}
/// A direction of this height.
inline Vec3<double> random_direction(reference::Random& random, double z) {
  double phi = random.uniform(0, 2 * kPi<double>), s = std::sqrt((1 - z) * (1 + z));
  return {s * std::cos(phi), s * std::sin(phi), z};
}

/// Random numbers: two for the normal and one for the side.
struct Numbers {
  std::vector<float> a, b, c;
  Numbers(std::size_t count, std::uint64_t seed) : a(count), b(count), c(count) {
    for (std::size_t i = 0; i < count; ++i) {
      reference::Random random(seed, i);
      a[i] = random.unit();
      b[i] = random.unit();
      c[i] = random.unit();
    }
  }
  Columns2 pairs() const { return {a.data(), b.data()}; }
  Columns3 in() const { return {a.data(), b.data(), c.data()}; }
};

struct Samples {
  Directions wi, wm;
  std::vector<float> pdf, weight, cos, side;

  explicit Samples(std::size_t count) : wi(count), wm(count), pdf(count), weight(count), cos(count), side(count) {}
  ReflectionSamples reflection() { return {wi.out(), pdf.data(), weight.data(), {nullptr, nullptr, nullptr}, nullptr}; }
  ReflectionSamples with_normals() { return {wi.out(), pdf.data(), weight.data(), wm.out(), cos.data()}; }
  DielectricSamples dielectric() { return {wi.out(), pdf.data(), weight.data(), side.data()}; }
};

struct Values {
  std::vector<float> f_cos, pdf;

  explicit Values(std::size_t count) : f_cos(count), pdf(count) {}
  Evaluations out() { return {f_cos.data(), pdf.data()}; }
};

using testing::kWarpNames;
using testing::kWarps;

}  // namespace vndf::shading
