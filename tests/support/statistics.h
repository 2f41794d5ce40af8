// Tests of significance, on the gamma functions of Boost.Math.
#pragma once

#include <vector>

namespace vndf::testing {

/// The probability that chi-square of so many degrees of freedom is larger.
double chi_square_tail(double statistic, double degrees);

/// Pearson's test of a histogram against what is expected; bins that expect fewer than 10 are pooled.
double p_value(const std::vector<double>& counts, const std::vector<double>& expected);

/// Whether two histograms of one distribution would differ so much.
double two_sample_p_value(const std::vector<double>& a, const std::vector<double>& b);

/// The least p-value for so many tests that are together to fail by chance once in a hundred times (Sidak).
double least_p_value(double tests);

}  // namespace vndf::testing
