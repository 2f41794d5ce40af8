#include "support/statistics.h"

#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <numeric>

namespace vndf::testing {

double chi_square_tail(double statistic, double degrees) {
  return boost::math::gamma_q(degrees / 2, statistic / 2);
}

double p_value(const std::vector<double>& counts, const std::vector<double>& expected) {
  double statistic = 0, pooled_count = 0, pooled = 0;
  int bins = 0;
  auto add = [&](double count, double of) {
    statistic += (count - of) * (count - of) / of;
    ++bins;
  };
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (expected[i] >= 10) {
      add(counts[i], expected[i]);
    } else {
      pooled_count += counts[i];
      pooled += expected[i];
    }
  }
  if (pooled > 5)
    add(pooled_count, pooled);
  else if (pooled_count > pooled + 10 * std::sqrt(pooled + 1))
    return 0;  // samples where there should be none
  return chi_square_tail(statistic, std::max(1, bins - 1));
}

double two_sample_p_value(const std::vector<double>& a, const std::vector<double>& b) {
  double r = std::sqrt(std::accumulate(b.begin(), b.end(), 0.) / std::accumulate(a.begin(), a.end(), 0.));
  double statistic = 0;
  int bins = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] + b[i] > 10) {
      double d = r * a[i] - b[i] / r;
      statistic += d * d / (a[i] + b[i]);
      ++bins;
    }
  return chi_square_tail(statistic, std::max(1, bins - 1));
}

double least_p_value(double tests) {
  return 1 - std::pow(0.99, 1 / tests);
}

}  // namespace vndf::testing
