// Chi-square tests, and the hemisphere as a grid.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "shading/inputs.h"

namespace vndf::shading {

/// The probability that chi-square with k degrees of freedom exceeds x: Q(k/2, x/2).
inline double chi_square_tail(double x, double k) {
  double a = k / 2, t = x / 2;
  if (t <= 0) return 1;
  double scale = std::exp(a * std::log(t) - t - std::lgamma(a));
  if (t < a + 1) {  // the series of P
    double term = 1 / a, sum = term;
    for (int n = 1; n < 10000 && term > sum * 1e-16; ++n) sum += term *= t / (a + n);
    return 1 - sum * scale;
  }
  double b = t + 1 - a, c = 1e300, d = 1 / b, f = d;  // Lentz's continued fraction of Q
  for (int n = 1; n < 10000; ++n) {
    double an = -n * (n - a);
    b += 2;
    d = 1 / (an * d + b);
    c = b + an / c;
    double step = c * d;
    f *= step;
    if (std::fabs(step - 1) < 1e-15) break;
  }
  return f * scale;
}

/// Pearson's test; bins that expect fewer than 10 are pooled.
inline double p_value(const std::vector<double>& counts, const std::vector<double>& expected) {
  double statistic = 0, pooled_count = 0, pooled = 0;
  int bins = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (expected[i] < 10) {
      pooled_count += counts[i];
      pooled += expected[i];
      continue;
    }
    statistic += (counts[i] - expected[i]) * (counts[i] - expected[i]) / expected[i];
    ++bins;
  }
  if (pooled > 5) {
    statistic += (pooled_count - pooled) * (pooled_count - pooled) / pooled;
    ++bins;
  } else if (pooled_count > pooled + 10 * std::sqrt(pooled + 1)) {
    return 0;
  }
  return chi_square_tail(statistic, std::max(1, bins - 1));
}

/// Whether two histograms of the same distribution would differ so much.
inline double two_sample_p_value(const std::vector<double>& a, const std::vector<double>& b) {
  double sum_a = 0, sum_b = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum_a += a[i];
    sum_b += b[i];
  }
  double r = std::sqrt(sum_b / sum_a), statistic = 0;
  int bins = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] + b[i] > 10) {
      double d = r * a[i] - b[i] / r;
      statistic += d * d / (a[i] + b[i]);
      ++bins;
    }
  return chi_square_tail(statistic, std::max(1, bins - 1));
}

/// The least p-value for `tests` tests that are together to fail by chance once in a hundred times (Sidak).
inline double least_p_value(double tests) {
  return 1 - std::pow(0.99, 1 / tests);
}

/// Midpoints of a grid of the hemisphere configuration, with the normals they stand for and the solid angle of those:
/// d m = alpha_x alpha_y / |A Nh|^3 d Nh.
struct NormalGrid {
  Directions m;
  std::vector<double> solid_angle;

  /// For views below the horizon the grid covers only the polar angles where some normals are visible.
  NormalGrid(const Vec3<double>& wo, const Alpha<double>& alpha, int rings, int sectors)
      : m(std::size_t(rings) * std::size_t(sectors)), solid_angle(m.size()) {
    Vec3<double> vh = unit(stretch(wo, alpha));
    double from = vh.z < 0 ? std::atan2(-vh.z, std::hypot(vh.x, vh.y)) : 0;
    double d_theta = (kPi<double> / 2 - from) / rings, d_phi = 2 * kPi<double> / sectors;
    for (int i = 0; i < rings; ++i)
      for (int j = 0; j < sectors; ++j) {
        double theta = from + (i + 0.5) * d_theta, phi = (j + 0.5) * d_phi;
        Vec3<double> nh{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
        Vec3<double> ne = stretch(nh, alpha);
        double n = std::sqrt(dot(ne, ne));
        auto at = std::size_t(i) * std::size_t(sectors) + std::size_t(j);
        m.set(at, unit(ne));
        solid_angle[at] = alpha.x * alpha.y / (n * n * n) * std::sin(theta) * d_theta * d_phi;
      }
  }
};

constexpr int kRings = 16, kSectors = 24;

/// The bin of a normal in the hemisphere configuration.
inline std::size_t bin_of_normal(const Vec3<double>& m, const Alpha<double>& alpha) {
  Vec3<double> nh = unstretch(m, alpha);
  double theta = std::atan2(std::hypot(nh.x, nh.y), nh.z), phi = std::atan2(nh.y, nh.x);
  if (phi < 0) phi += 2 * kPi<double>;
  int ring = std::min(kRings - 1, int(theta / (kPi<double> / 2) * kRings));
  int sector = std::min(kSectors - 1, int(phi / (2 * kPi<double>)*kSectors));
  return std::size_t(ring * kSectors + sector);
}

}  // namespace vndf::shading
