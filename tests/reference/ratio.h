// The yardstick that holds where a problem is steep too: the error of a result over what the exact result moves by when
// each input moves by half a unit of its last place, the moves added up, and half a unit of the result's. It is what a
// formula loses, apart from what its inputs had lost before.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "reference/exact.h"

namespace vndf::reference {

/// How an input moves: away from 0 by half a unit, but a random number that is 1 moves inwards.
enum class Moves { outwards, within_one };

inline Quad moved_by_half_a_unit(float value, Moves moves) {
  if (moves == Moves::within_one && value == 1) return Quad(1) - Quad(0x1p-25);
  int exponent;
  std::frexp(value, &exponent);  // value is in [2^(exponent - 1), 2^exponent)
  Quad half = value == 0 ? Quad(0x1p-150) : Quad(std::ldexp(1., std::max(exponent - 25, -150)));
  return value < 0 ? Quad(value) - half : Quad(value) + half;
}

/// An exact result, a vector or, in x, a number; and what half a unit of its last place is 2^-25 of. What is not
/// compared, since the library's result may jump there, has no ratio.
struct Exact {
  exact::Vec value;
  Quad size;
  bool compared = true;
};
inline Exact exact_vector(const exact::Vec& value, bool compared = true) {
  return {value, length(value), compared};
}
inline Exact exact_number(Quad value, bool compared = true) {
  constexpr Quad kSubnormal = 0x1p-125;  // whose half units are all the same
  Quad size = value < 0 ? -value : value;
  return {{value, 0, 0}, size > kSubnormal ? size : kSubnormal, compared};
}
/// A cosine is as good as the directions that it is between.
inline Exact exact_cosine(Quad value, bool compared = true) {
  return {{value, 0, 0}, 1, compared};
}

/// A result of the library, compared or not.
struct Found {
  std::array<float, 3> value;
  bool compared = true;
};

/// The ratio of each result, or -1 for what is not compared. NaN and infinity among the results give infinity.
///
/// `exact` takes inputs as Quad and returns the exact results. As it is slow, a ratio that even without any moves is
/// below 2 is given without them: then it is a bound of the ratio.
template <std::size_t inputs, std::size_t results, class Function>
std::array<double, results> ratios(const std::array<float, inputs>& in, const std::array<Moves, inputs>& moves,
                                   const std::array<Found, results>& found, Function exact) {
  constexpr double kEnough = 2;
  std::array<Quad, inputs> at;
  for (std::size_t i = 0; i < inputs; ++i) at[i] = Quad(in[i]);
  const std::array<Exact, results> right = exact(at);
  std::array<double, results> ratio;
  std::array<Quad, results> error{}, moved{};
  bool enough = true;
  for (std::size_t r = 0; r < results; ++r) {
    const auto& v = found[r].value;
    bool finite = std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
    if (!found[r].compared || !right[r].compared || !finite) {
      ratio[r] = finite ? -1 : INFINITY;
      continue;
    }
    error[r] = distance({Quad(v[0]), Quad(v[1]), Quad(v[2])}, right[r].value);
    moved[r] = std::max(right[r].size * Quad(0x1p-25), Quad(0x1p-150));
    ratio[r] = double(error[r] / moved[r]);
    enough = enough && ratio[r] <= kEnough;
  }
  if (enough) return ratio;
  for (std::size_t i = 0; i < inputs; ++i) {
    at[i] = moved_by_half_a_unit(in[i], moves[i]);
    const std::array<Exact, results> there = exact(at);
    at[i] = Quad(in[i]);
    for (std::size_t r = 0; r < results; ++r)
      if (ratio[r] >= 0 && ratio[r] < INFINITY) moved[r] += distance(there[r].value, right[r].value);
  }
  for (std::size_t r = 0; r < results; ++r)
    if (ratio[r] >= 0 && ratio[r] < INFINITY) ratio[r] = double(error[r] / moved[r]);
  return ratio;
}

/// The ratios of many samples; NaN counts as infinite.
class Ratios {
 public:
  void add(double ratio, std::size_t sample) {
    if (ratio < 0) return;
    if (std::isnan(ratio)) ratio = INFINITY;
    if (all_.empty() || ratio > max_) {
      max_ = ratio;
      worst_ = sample;
    }
    all_.push_back(ratio);
  }
  std::size_t size() const { return all_.size(); }
  double max() const { return max_; }
  std::size_t worst() const { return worst_; }  ///< the sample that max() is of
  double mean() const {
    double sum = 0;
    for (double ratio : all_) sum += ratio;
    return all_.empty() ? 0 : sum / double(all_.size());
  }
  double p999() const {
    if (all_.empty()) return 0;
    std::vector<double> sorted = all_;
    auto at = sorted.begin() + std::ptrdiff_t(double(sorted.size() - 1) * 0.999);
    std::nth_element(sorted.begin(), at, sorted.end());
    return *at;
  }

 private:
  std::vector<double> all_;
  double max_ = 0;
  std::size_t worst_ = 0;
};

}  // namespace vndf::reference
