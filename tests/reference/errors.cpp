#include "reference/errors.h"

#include <algorithm>
#include <cmath>

namespace vndf::reference {

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
    if (keep_larger(errors.max, distance)) errors.worst = i;
    double slope = std::sqrt(slope_x * slope_x + slope_y * slope_y);
    double steepness = std::hypot(oracle.x[i] / in.alpha_x[i], oracle.y[i] / in.alpha_y[i]);
    keep_larger(errors.max_slope, slope);
    if (keep_larger(errors.max_resolved_slope, slope / std::max(1., steepness / 1000))) errors.worst_slope = i;
    if (keep_larger(errors.max_norm, std::fabs(std::sqrt(x * x + y * y + z * z) - 1) / kEps)) errors.worst_norm = i;
  }
  if (distances.empty()) return errors;
  errors.mean /= double(in.size());
  auto p999 = distances.begin() + std::ptrdiff_t(double(distances.size() - 1) * 0.999);
  std::nth_element(distances.begin(), p999, distances.end());
  errors.p999 = *p999;
  return errors;
}

}  // namespace vndf::reference
