#include "reference/hard_cases.h"

#include <cmath>

namespace vndf::reference {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr float kEps = 0x1p-24f;
constexpr float kLast = 1 - kEps;

using View = std::array<double, 3>;
using Roughness = std::array<double, 2>;
using Square = std::array<float, 2>;

View direction(Random& random, double sin, double cos) {
  double phi = random.uniform(0, 2 * kPi);
  return {sin * std::cos(phi), sin * std::sin(phi), cos};
}
View direction(Random& random, double cos) {
  return direction(random, std::sqrt((1 - cos) * (1 + cos)), cos);
}

template <int from_percent, int to_percent>
View cos_uniform(Random& random) {
  return direction(random, random.uniform(from_percent * 0.01, to_percent * 0.01));
}
View grazing(Random& random) {
  return direction(random, random.uniform(0, 1e-3));
}
View normal_incidence(Random& random) {
  return direction(random, random.uniform(0.999999, 1));
}
View vanishing_cos(Random& random) {
  return direction(random, random.log_uniform(1e-30, 1e-3));
}
View vanishing_cos_below(Random& random) {
  return direction(random, -random.log_uniform(1e-30, 1e-3));
}
View near_plus_z(Random& random) {
  double sin = random.log_uniform(1e-12, 1e-3);
  return direction(random, sin, std::sqrt(1 - sin * sin));
}
View near_minus_z(Random& random) {
  double sin = random.log_uniform(1e-10, 1e-2);
  return direction(random, sin, -std::sqrt(1 - sin * sin));
}
View plus_z(Random&) {
  return {0, 0, 1};
}
View minus_z(Random&) {
  return {0, 0, -1};
}
View any_length(Random& random) {
  View wo = direction(random, random.uniform(-1, 1));
  double length = random.log_uniform(1e-20, 1e20);
  return {wo[0] * length, wo[1] * length, wo[2] * length};
}

Roughness moderate(Random& random) {
  return {random.uniform(0.05, 1), random.uniform(0.05, 1)};
}
Roughness small(Random& random) {
  return {random.log_uniform(1e-4, 1e-3), random.log_uniform(1e-4, 1e-3)};
}
Roughness tiny(Random& random) {
  return {random.log_uniform(1e-6, 1e-4), random.log_uniform(1e-6, 1e-4)};
}
Roughness large(Random& random) {
  return {random.log_uniform(1 + 1e-6, 100), random.log_uniform(1 + 1e-6, 100)};
}
Roughness four_decades_apart(Random& random) {
  double larger = random.log_uniform(0.05, 1);
  return random.below(2) ? Roughness{larger, larger * 1e-4} : Roughness{larger * 1e-4, larger};
}

Square anywhere(Random& random, Warp) {
  return {random.unit(), random.unit()};
}
/// Points whose normals lie on the boundary of the visible ones.
Square rim(Random& random, Warp warp) {
  float near_1 = 1 - float(1 + random.below(64)) * kEps;
  switch (warp) {
    case Warp::polar:
      return {near_1, random.unit()};
    case Warp::spherical_cap:
      return {random.unit(), near_1};
    default:
      float near_end = random.below(2) ? near_1 : 1 - near_1;
      return random.below(2) ? Square{near_end, random.unit()} : Square{random.unit(), near_end};
  }
}
Square ends(Random& random, Warp) {
  Square u{random.unit(), random.unit()};
  switch (random.below(8)) {
    case 0:
      return {0, u[1]};
    case 1:
      return {kLast, u[1]};
    case 2:
      return {u[0], 0};
    case 3:
      return {u[0], kLast};
    case 4:
      return {0, 0};
    case 5:
      return {0, kLast};
    case 6:
      return {kLast, 0};
    default:
      return {kLast, kLast};
  }
}
/// The borders between the wedges of the concentric map and their neighbours, and the axes and the centre within.
Square wedge_borders(Random& random, Warp) {
  float u = kEps + random.unit() * (1 - 2 * kEps);
  float beside = float(random.below(3)) * kEps - kEps;
  switch (random.below(5)) {
    case 0:
      return {u, u + beside};
    case 1:
      return {u, (1 - u) + beside};
    case 2:
      return {0.5f + beside, u};
    case 3:
      return {u, 0.5f + beside};
    default:
      return {0.5f, 0.5f + beside};
  }
}

// What renderers make.

/// A multiple of 2^-32 rounded to float; often one that rounds to 1 or is among the smallest.
float of_32_bits(Random& random) {
  std::uint64_t bits = random.bits() >> 32;
  if (random.below(16) == 0) bits = random.below(2) ? 0xffffffffu - (bits & 0xff) : bits & 0xff;
  return float(double(bits) * 0x1p-32);
}
Square multiples_of_2_to_minus_32(Random& random, Warp) {
  return {of_32_bits(random), of_32_bits(random)};
}
/// The additive recurrence of the plastic number, taken modulo 1 in double as is done.
Square r2_points(Random& random, Warp) {
  double n = random.below(1u << 20), x = 0.5 + 0.7548776662466927 * n, y = 0.5 + 0.5698402909980532 * n;
  return {float(x - std::floor(x)), float(y - std::floor(y))};
}
/// The first two dimensions of Sobol's sequence, scrambled by exclusive or for every other pixel.
Square sobol_points(Random& random, Warp) {
  std::uint32_t index = random.below(1u << 12), x = 0, y = 0, direction = 1u << 31;
  for (int bit = 0; bit < 12; ++bit, direction ^= direction >> 1)
    if (index >> bit & 1) {
      x ^= 1u << (31 - bit);
      y ^= direction;
    }
  if (random.below(2)) {
    x ^= std::uint32_t(random.bits());
    y ^= std::uint32_t(random.bits());
  }
  return {float(double(x) * 0x1p-32), float(double(y) * 0x1p-32)};
}
Square stratified(Random& random, Warp) {
  constexpr float kStrata = 16;
  return {(float(random.below(16)) + random.unit()) / kStrata, (float(random.below(16)) + random.unit()) / kStrata};
}
float tiny_number(Random& random) {
  return float(random.below(4) ? random.log_uniform(0x1p-149, 0x1p-24) : 0x1p-32);
}
Square tiny_numbers(Random& random, Warp) {
  switch (random.below(3)) {
    case 0:
      return {tiny_number(random), random.unit()};
    case 1:
      return {random.unit(), tiny_number(random)};
    default:
      return {tiny_number(random), tiny_number(random)};
  }
}
/// 0 and 1, a half, and what is next to them.
float end_of_interval(Random& random) {
  static const float ends[] = {0, 1, 0, 1, 0.5f, kLast, 0x1p-24f, 0x1p-32f, 0x1p-149f};
  return ends[random.below(9)];
}
Square exact_ends(Random& random, Warp) {
  switch (random.below(3)) {
    case 0:
      return {end_of_interval(random), of_32_bits(random)};
    case 1:
      return {of_32_bits(random), end_of_interval(random)};
    default:
      return {end_of_interval(random), end_of_interval(random)};
  }
}
Square any_numbers(Random& random, Warp warp) {
  using Numbers = Square (*)(Random&, Warp);
  static constexpr Numbers kinds[] = {
      anywhere, multiples_of_2_to_minus_32, r2_points, sobol_points, stratified, tiny_numbers, exact_ends, rim};
  return kinds[random.below(8)](random, warp);
}

double either_sign(Random& random, double x) {
  return random.below(2) ? -x : x;
}
/// Seen along an axis, in the plane of it or next to that plane, at 89 to 89.9999 degrees.
View floor_ahead(Random& random) {
  double from_horizon = random.log_uniform(1e-4, 1) * kPi / 180;
  double along = either_sign(random, std::cos(from_horizon));
  double across = random.below(2) ? 0 : either_sign(random, random.log_uniform(1e-12, 1e-3));
  return random.below(2) ? View{along, across, std::sin(from_horizon)} : View{across, along, std::sin(from_horizon)};
}
View floor_ahead_below(Random& random) {
  View wo = floor_ahead(random);
  return {wo[0], wo[1], -wo[2]};
}
/// The outermost 1 % of a sphere's picture.
View silhouette(Random& random) {
  return direction(random, std::sqrt(random.uniform(0, 0.01)));
}
View with_component(View wo, std::uint32_t index, double value) {
  wo[index] = 0;
  double length = std::sqrt(wo[0] * wo[0] + wo[1] * wo[1] + wo[2] * wo[2]);
  for (double& component : wo) component /= length;
  wo[index] = value;
  return wo;
}
View zero_component(Random& random) {
  View wo = with_component(direction(random, random.uniform(-1, 1)), random.below(3), either_sign(random, 0.));
  return random.below(4) ? wo : with_component(wo, random.below(3), 0.);
}
View denormal_component(Random& random) {
  double value = either_sign(random, random.log_uniform(0x1p-149, 0x1p-126));
  return with_component(direction(random, random.uniform(-1, 1)), random.below(3), value);
}
View off_unit(Random& random) {
  View wo = direction(random, random.uniform(0, 1));
  double length = 1 + either_sign(random, random.log_uniform(1e-6, 1e-3));
  return {wo[0] * length, wo[1] * length, wo[2] * length};
}
View any_view(Random& random) {
  using Views = View (*)(Random&);
  static constexpr Views kinds[] = {
      cos_uniform<0, 100>, cos_uniform<-100, 0>, floor_ahead, floor_ahead_below, silhouette,
      zero_component,      denormal_component,   off_unit,    near_plus_z,       grazing,
      near_minus_z,        vanishing_cos};
  return kinds[random.below(12)](random);
}

/// The square of a roughness of 8 bits. That of 0 is a mirror, which special values are about.
Roughness squared_8_bits(Random& random) {
  float r = float(1 + random.below(random.below(2) ? 255 : 16)) / 255;
  return {r * r, r * r};
}
/// The same stretched by an aspect of sqrt(1 - 0.9 a).
Roughness anisotropy_slider(Random& random) {
  float r = float(1 + random.below(255)) / 255, a = float(random.below(256)) / 255, aspect = std::sqrt(1 - 0.9f * a);
  return random.below(2) ? Roughness{r * r / aspect, r * r * aspect} : Roughness{r * r * aspect, r * r / aspect};
}
Roughness whole_domain(Random& random) {
  return {random.log_uniform(1e-6, 100), random.log_uniform(1e-6, 100)};
}
Roughness ends_of_domain(Random& random) {
  auto end = [&] { return random.below(2) ? random.log_uniform(1e-6, 1e-5) : random.log_uniform(10, 100); };
  return {end(), end()};
}
Roughness any_alpha(Random& random) {
  using Alphas = Roughness (*)(Random&);
  static constexpr Alphas kinds[] = {moderate, squared_8_bits, anisotropy_slider, whole_domain, ends_of_domain};
  return kinds[random.below(5)](random);
}

}  // namespace

const std::vector<HardCase>& renderer_cases() {
  // clang-format off
  static const std::vector<HardCase> rows = {
    {"u_of_24_bits", "u a multiple of 2^-24", any_view, any_alpha, anywhere, true},
    {"u_of_32_bits", "u a multiple of 2^-32 rounded to float, 1 among them", any_view, any_alpha, multiples_of_2_to_minus_32, true},
    {"u_r2", "points of the R2 sequence", any_view, any_alpha, r2_points, true},
    {"u_sobol", "Sobol points times 2^-32", any_view, any_alpha, sobol_points, true},
    {"u_stratified", "16 x 16 strata", any_view, any_alpha, stratified, true},
    {"u_tiny", "u of 2^-32 and from 2^-24 to the smallest denormal, one or both", any_view, any_alpha, tiny_numbers, true},
    {"u_exact_ends", "u at 0, 1 and 1/2 and next to them, one or both", any_view, any_alpha, exact_ends, true},
    {"u_rim", "u within 64 eps of the rim", any_view, any_alpha, rim, true},
    {"floor_ahead", "89 to 89.9999 degrees, along an axis", floor_ahead, any_alpha, any_numbers, true},
    {"floor_ahead_below", "the same below the horizon", floor_ahead_below, any_alpha, any_numbers, true},
    {"silhouette", "the outermost 1 % of a sphere", silhouette, any_alpha, any_numbers, true},
    {"zero_component", "one or two components of wo are 0", zero_component, any_alpha, any_numbers, true},
    {"denormal_component", "a component of wo is denormal", denormal_component, any_alpha, any_numbers, true},
    {"off_unit", "wo 1e-6 to 1e-3 off unit length", off_unit, any_alpha, any_numbers, true},
    {"squared_8_bits", "alpha the square of k / 255", any_view, squared_8_bits, any_numbers},
    {"anisotropy_slider", "the same with an aspect of sqrt(1 - 0.9 a)", any_view, anisotropy_slider, any_numbers, true},
    {"whole_domain", "alpha_x and alpha_y from 1e-6 to 100", any_view, whole_domain, any_numbers, true},
    {"ends_of_domain", "alpha_x and alpha_y at 1e-6 or at 100", any_view, ends_of_domain, any_numbers, true},
  };
  // clang-format on
  return rows;
}

const std::vector<Refraction>& refractions() {
  static const std::vector<Refraction> rows = {
      {"glass", "eta from 1.3 to 2.5, or its reciprocal",
       [](Random& random) {
         double eta = random.uniform(1.3, 2.5);
         return random.below(2) ? eta : 1 / eta;
       }},
      {"near_1", "eta from 1.0001 to 1.01, or its reciprocal",
       [](Random& random) {
         double eta = 1 + random.log_uniform(1e-4, 1e-2);
         return random.below(2) ? eta : 1 / eta;
       }},
      {"any_index", "eta from 0.1 to 10", [](Random& random) { return random.log_uniform(0.1, 10); }},
  };
  return rows;
}

const std::vector<HardCase>& hard_cases() {
  // clang-format off
  static const std::vector<HardCase> rows = {
    {"typical", "cos in [0, 1], alpha in [0.05, 1]", cos_uniform<0, 100>, moderate, anywhere},
    {"grazing", "cos < 1e-3", grazing, moderate, anywhere},
    {"vanishing_cos", "cos from 1e-3 down to 1e-30", vanishing_cos, moderate, anywhere},
    {"vanishing_cos_below", "cos from -1e-3 up to -1e-30", vanishing_cos_below, moderate, anywhere},
    {"normal_incidence", "cos > 0.999999", normal_incidence, moderate, anywhere},
    {"near_plus_z", "sin from 1e-3 down to 1e-12", near_plus_z, moderate, anywhere},
    {"plus_z", "exactly +z", plus_z, moderate, anywhere},
    {"below_horizon", "cos in [-1, 0]", cos_uniform<-100, 0>, moderate, anywhere},
    {"near_minus_z", "sin from 1e-2 down to 1e-10, below the horizon", near_minus_z, moderate, anywhere},
    {"minus_z", "exactly -z", minus_z, moderate, anywhere, false, false, true},
    {"small_alpha", "alpha in [1e-4, 1e-3]", cos_uniform<0, 100>, small, anywhere, false, true},
    {"grazing_small_alpha", "cos < 1e-3, alpha in [1e-4, 1e-3]", grazing, small, anywhere, false, true},
    {"small_alpha_below", "cos in [-1, 0], alpha in [1e-4, 1e-3]", cos_uniform<-100, 0>, small, anywhere, false, true},
    {"tiny_alpha", "alpha in [1e-6, 1e-4]", cos_uniform<0, 100>, tiny, anywhere, false, true},
    {"vanishing_cos_tiny_alpha", "cos from 1e-3 down to 1e-30, alpha in [1e-6, 1e-4]", vanishing_cos, tiny, anywhere, false, true},
    {"anisotropic", "alpha_x and alpha_y four decades apart", cos_uniform<0, 100>, four_decades_apart, anywhere},
    {"anisotropic_below", "the same below the horizon", cos_uniform<-100, 0>, four_decades_apart, anywhere},
    {"large_alpha", "alpha in (1, 100]", cos_uniform<0, 100>, large, anywhere, true},
    {"large_alpha_below", "alpha in (1, 100], cos in [-1, 0]", cos_uniform<-100, 0>, large, anywhere, true},
    {"unnormalised", "cos in [-1, 1], lengths from 1e-20 to 1e20", any_length, moderate, anywhere},
    {"rim", "u within 64 eps of the rim of the disk", cos_uniform<0, 100>, moderate, rim},
    {"rim_below", "the same below the horizon", cos_uniform<-100, 0>, moderate, rim},
    {"rim_small_alpha", "u within 64 eps of the rim, alpha in [1e-4, 1e-3]", cos_uniform<0, 100>, small, rim, false, true},
    {"u_ends", "u at 0 and at 1 - eps, one or both", cos_uniform<-100, 100>, moderate, ends},
    {"wedge_borders", "u1 = u2, u1 = 1 - u2, u1 = 1/2, u2 = 1/2", cos_uniform<-100, 100>, moderate, wedge_borders},
  };
  // clang-format on
  return rows;
}

Inputs generate(const HardCase& hard_case, Warp warp, std::size_t count, std::uint64_t seed) {
  // Rows of the same seed share nothing.
  for (const char* c = hard_case.name; *c; ++c) seed = seed * 0x100000001b3u + std::uint64_t(*c);
  Inputs in(count);
  for (std::size_t i = 0; i < count; ++i) {
    Random random(seed, i);
    View wo = hard_case.wo(random);
    Roughness alpha = hard_case.alpha(random);
    Square u = hard_case.u(random, warp);
    in.wo_x[i] = float(wo[0]);
    in.wo_y[i] = float(wo[1]);
    in.wo_z[i] = float(wo[2]);
    in.alpha_x[i] = float(alpha[0]);
    in.alpha_y[i] = float(alpha[1]);
    in.u_x[i] = u[0];
    in.u_y[i] = u[1];
  }
  return in;
}

}  // namespace vndf::reference
