#include "fuzz/inputs.h"

#include <limits>

namespace vndf::fuzz {
namespace {

using testing::Kind;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity(),
                kMax = std::numeric_limits<float>::max();
constexpr float kSpecial[] = {0.f,   -0.f,  1.f,    -1.f,    0x1p-149f, -0x1p-149f, 0x1p-126f, 1e-30f,
                              1e-6f, 1e20f, -1e30f, 0x1p75f, kMax,      -kMax,      kInf,      -kInf,
                              kNan,  0.5f,  2.f,    100.f,   0x1p24f,   -0.3f,      0x1p-24f,  1 - 0x1p-24f};

/// A value as it is, its neighbour, a special one or any 32 bits: `wild` of 64 are not what they were.
float spoil(Source& source, std::uint32_t wild, double value) {
  auto f = float(value);
  if (source.below(64) >= wild) return f;
  switch (source.below(3)) {
    case 0:
      return kSpecial[source.below(sizeof kSpecial / sizeof *kSpecial)];
    case 1:
      return std::nextafterf(f, source.one_in(2) ? kMax : -kMax);
    default:
      return source.any_float();
  }
}

double number(Source& source, Kind kind, bool any_roughness) {
  switch (kind) {
    case Kind::u:
      switch (source.below(8)) {
        case 0:
          return source.log_uniform(0x1p-60, 1);
        case 1:
          return 1 - source.log_uniform(0x1p-24, 1);
        case 2:
          return source.below(5) / 4.;  // the corners of the maps
        default:
          return double(source.bits() >> 40) * 0x1p-24;
      }
    case Kind::alpha:
      if (!any_roughness) return source.log_uniform(1e-6, 100);
      return source.one_in(8) ? -source.log_uniform(1e-30, 1) : source.log_uniform(1e-30, 0x1p24);
    case Kind::theta:
      return source.one_in(3) ? 0 : source.uniform(-3.2, 3.2);
    case Kind::probability:
      return source.one_in(4) ? source.below(2) : source.uniform(0, 1);
    default:  // an index of refraction
      return source.one_in(4) ? 1 + source.uniform(-1e-4, 1e-4) : source.log_uniform(0.1, 10);
  }
}

/// A direction: any, along the horizon, near the normal, or along an axis.
void direction(Source& source, double (&v)[3]) {
  double tilt = source.one_in(3) ? source.log_uniform(1e-12, 1) : source.uniform(0, 1);
  double azimuth = source.one_in(4) ? 0.25 * source.below(8) : source.uniform(0, 2);
  double sine = std::sqrt(1 - tilt * tilt);
  if (source.one_in(3)) std::swap(tilt, sine);
  v[0] = sine * std::cos(M_PI * azimuth);
  v[1] = sine * std::sin(M_PI * azimuth);
  v[2] = source.one_in(4) ? -tilt : tilt;
}

bool is_direction(Kind kind) {
  return kind == Kind::view || kind == Kind::light || kind == Kind::normal;
}

/// Normals are promised for views of any length, and those of plain GGX for any roughness.
bool takes_any_view(const testing::Operation& row) {
  return row.outputs[0].result == testing::Result::normal;
}
bool takes_any_roughness(const testing::Operation& row) {
  return takes_any_view(row) && !row.takes(Kind::theta);
}

}  // namespace

std::vector<Values> make_inputs(Source& source, const testing::Operation& row, std::size_t count) {
  constexpr std::uint32_t kWild[] = {0, 1, 8, 64};
  const std::uint32_t wild = kWild[source.below(4)];
  std::vector<Values> in(row.inputs.size());
  for (std::size_t c = 0, together; c < in.size(); c += together) {
    const Kind kind = row.inputs[c].kind;
    together = is_direction(kind) ? 3 : 1;
    const bool constant = source.one_in(4);
    for (std::size_t k = 0; k < together; ++k) in[c + k] = {constant, std::vector<float>(count)};
    for (std::size_t i = 0; i < count; ++i) {
      if (constant && i > 0) {
        for (std::size_t k = 0; k < together; ++k) in[c + k].all[i] = in[c + k].all[0];
        continue;
      }
      double v[3] = {};
      if (together == 1) {
        v[0] = number(source, kind, takes_any_roughness(row));
      } else {
        direction(source, v);
        double scale = takes_any_view(row) && source.one_in(2) ? source.log_uniform(1e-37, 1e37) : 1;
        for (double& x : v) x *= scale;
      }
      for (std::size_t k = 0; k < together; ++k) in[c + k].all[i] = spoil(source, wild, v[k]);
    }
  }
  return in;
}

Shape make_shape(Source& source) {
  Shape shape;
  float a[9];
  for (float& value : a) value = float(source.uniform(-1, 1) * source.log_uniform(1e-3, 1));
  for (std::size_t k : {0, 4, 8}) a[k] = std::fabs(a[k]) + 0.1f;
  for (float& value : a) value = spoil(source, source.one_in(4) ? 8 : 0, value);
  (void)vndf::make_shape(a, shape);  // what it does not take leaves the unit sphere
  return shape;
}

double length(const std::vector<Values>& in, std::size_t column, std::size_t lane) {
  double x = in[column].all[lane], y = in[column + 1].all[lane], z = in[column + 2].all[lane];
  return std::sqrt(x * x + y * y + z * z);
}

bool in_domain(const testing::Operation& row, const std::vector<Values>& in, std::size_t lane) {
  auto value_is_good = [&](std::size_t c) {
    const double value = in[c].all[lane];
    switch (row.inputs[c].kind) {
      case Kind::alpha:
        return takes_any_roughness(row) ? std::fabs(value) <= 0x1p24 : value >= 1e-6 && value <= 100;
      case Kind::theta:
        return std::fabs(value) <= 100;
      case Kind::eta:
        return value >= 0.1 && value <= 10;
      case Kind::u:
        return value >= 0 && value <= 1;
      case Kind::probability:  // the weight is divided by it, or by what it is off 1
        return value == 0 || (value >= 0x1p-60 && value <= 1);
      case Kind::view:
      case Kind::light:
      case Kind::normal:
        if (takes_any_view(row)) return std::fabs(value) < 0x1p98;
        return row.inputs[c].index > 0 || std::fabs(length(in, c, lane) - 1) <= 8 * 0x1p-24;
    }
    return false;
  };
  for (std::size_t c = 0; c < in.size(); ++c)
    if (!value_is_good(c)) return false;
  return row.in_domain;
}

}  // namespace vndf::fuzz
