#include "reference/errors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vndf::reference {
namespace {

void keep_larger(double error, std::size_t index, double& max, std::size_t& worst) {
  if (error <= max) return;
  max = error;
  worst = index;
}

double or_infinite(double error) {
  return std::isnan(error) ? std::numeric_limits<double>::infinity() : error;
}

}  // namespace

NormalErrors measure(const Inputs& in, const OracleNormals& oracle, const float* wm_x, const float* wm_y,
                     const float* wm_z) {
  NormalErrors errors;
  std::vector<float> distances(in.size());
  for (std::size_t i = 0; i < in.size(); ++i) {
    double x = wm_x[i], y = wm_y[i], z = wm_z[i];
    double dx = x - oracle.x[i], dy = y - oracle.y[i], dz = z - oracle.z[i];
    double distance = or_infinite(std::sqrt(dx * dx + dy * dy + dz * dz) / kEps);
    double slope_x = dx / in.alpha_x[i], slope_y = dy / in.alpha_y[i];
    distances[i] = float(distance);
    errors.mean += distance;
    keep_larger(distance, i, errors.max, errors.worst);
    double slope = or_infinite(std::sqrt(slope_x * slope_x + slope_y * slope_y));
    double steepness = std::hypot(oracle.x[i] / in.alpha_x[i], oracle.y[i] / in.alpha_y[i]);
    errors.max_slope = std::max(errors.max_slope, slope);
    keep_larger(slope / std::max(1., steepness / 1000), i, errors.max_resolved_slope, errors.worst_slope);
    keep_larger(or_infinite(std::fabs(std::sqrt(x * x + y * y + z * z) - 1) / kEps), i, errors.max_norm,
                errors.worst_norm);
  }
  if (distances.empty()) return errors;
  errors.mean /= double(in.size());
  auto p999 = distances.begin() + std::ptrdiff_t(double(distances.size() - 1) * 0.999);
  std::nth_element(distances.begin(), p999, distances.end());
  errors.p999 = *p999;
  return errors;
}

}  // namespace vndf::reference
