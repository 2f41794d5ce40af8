// The hard cases of plain GGX with angles added, for the accuracy of the ellipsoid NDF.
#pragma once

#include <cstdlib>
#include <vector>

#include "ellipsoid/model.h"
#include "reference/hard_cases.h"

namespace vndf::ellipsoid {

/// theta_x and theta_y are uniform up to `lean` either way, or the constant 0 if that is 0; any theta_z.
struct Case {
  reference::HardCase inputs;
  double lean;
};

inline std::vector<Case> cases() {
  using reference::HardCase;
  using reference::Random;
  constexpr double kLean = 0.5, kAny = 3.1415;
  auto known = [&](const char* name) {
    for (const HardCase& row : reference::hard_cases())
      if (std::string(row.name) == name) return row;
    std::abort();
  };
  auto small = [](Random& random) {
    return std::array<double, 2>{random.log_uniform(1e-3, 1e-2), random.log_uniform(1e-3, 1e-2)};
  };
  auto any = [](Random& random) {
    return std::array<double, 2>{random.log_uniform(1e-3, 1), random.log_uniform(1e-3, 1)};
  };
  auto changed = [&](const char* from, const char* name, const char* description,
                     std::array<double, 2> (*alpha)(Random&)) {
    HardCase row = known(from);
    row.name = name;
    row.description = description;
    if (alpha) row.alpha = alpha;
    return row;
  };
  return {
      {known("typical"), kLean},
      {known("grazing"), kLean},
      {known("vanishing_cos"), kLean},
      {known("normal_incidence"), kLean},
      {known("near_plus_z"), kLean},
      {known("below_horizon"), kLean},
      {known("near_minus_z"), kLean},
      {known("unnormalised"), kLean},
      {known("rim"), kLean},
      {known("u_ends"), kLean},
      {changed("typical", "small_alpha", "cos in [0, 1], alpha in [1e-3, 1e-2]", small), kLean},
      {changed("typical", "any_alpha", "cos in [0, 1], alpha in [1e-3, 1]", any), kLean},
      {changed("below_horizon", "any_alpha_below", "the same below the horizon", any), kLean},
      {changed("typical", "turned", "theta_z alone, cos in [0, 1], alpha in [1e-3, 1]", any), 0},
      {changed("grazing", "turned_grazing", "theta_z alone, cos < 1e-3, alpha in [1e-3, 1]", any), 0},
      {changed("below_horizon", "turned_below", "theta_z alone, below the horizon, alpha in [1e-3, 1]", any), 0},
      {changed("typical", "any_angle", "typical, leaning up to half a turn", nullptr), kAny},
      {changed("typical", "any_angle_small_alpha", "small alpha, leaning up to half a turn", small), kAny},
  };
}

/// Beyond what normals are promised for.
inline Case alpha_up_to_100() {
  Case row = cases().front();
  row.inputs.name = "alpha_up_to_100";
  row.inputs.alpha = [](reference::Random& random) {
    return std::array<double, 2>{random.log_uniform(1e-3, 100), random.log_uniform(1e-3, 100)};
  };
  return row;
}

struct Angles {
  std::vector<float> x, y, z;
  bool turned;

  Angles(std::size_t count, double lean, std::uint64_t seed) : turned(lean == 0) {
    for (std::size_t i = 0; i < count; ++i) {
      reference::Random random(seed, i);
      x.push_back(float(random.uniform(-lean, lean)));
      y.push_back(float(random.uniform(-lean, lean)));
      z.push_back(float(random.uniform(-kPi<double>, kPi<double>)));
    }
  }
  Ellipsoid with(const Columns2& alpha) const {
    return turned ? Ellipsoid(alpha, 0.f, 0.f, z.data()) : Ellipsoid(alpha, x.data(), y.data(), z.data());
  }
};

inline Parameters parameters(const reference::Inputs& in, const Angles& theta, std::size_t i) {
  return {in.alpha_x[i], in.alpha_y[i], theta.x[i], theta.y[i], theta.z[i]};
}

/// Walter's plain equations in quadruple precision.
inline Vec3<double> exact_normal(Warp warp, const Vec3<float>& wo, const Parameters& p, const float (&u)[2]) {
  Vec3<Quad> psi{wo.x, wo.y, wo.z};
  Quad u1 = u[0], u2 = u[1];
  M3<Quad> a = matrix<Quad>(p);
  Vec3<Quad> m =
      warp == Warp::spherical_cap ? sample_cap(psi, a, u1, u2) : sample_version_3(psi, a, disk_point(warp, u1, u2));
  return {double(m.x), double(m.y), double(m.z)};
}
inline Vec3<double> exact_normal(Warp warp, const reference::Inputs& in, const Angles& theta, std::size_t i) {
  return exact_normal(warp, {in.wo_x[i], in.wo_y[i], in.wo_z[i]}, parameters(in, theta, i), {in.u_x[i], in.u_y[i]});
}

}  // namespace vndf::ellipsoid
