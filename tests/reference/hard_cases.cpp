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

}  // namespace

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
