// Counter-based random numbers (SplitMix64): the same on every machine and in any order.
#pragma once

#include <cmath>
#include <cstdint>

namespace vndf::reference {

class Random {
 public:
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0) : state_(mix(seed) ^ mix(~stream)) {}

  std::uint64_t bits() { return mix(state_ += 0x9e3779b97f4a7c15u); }
  /// An integer in [0, n).
  std::uint32_t below(std::uint32_t n) { return std::uint32_t(((bits() >> 32) * n) >> 32); }
  /// A multiple of 2^-24 in [0, 1), the random numbers that a renderer has.
  float unit() { return float(bits() >> 40) * 0x1p-24f; }
  double uniform(double from, double to) { return from + (to - from) * (double(bits() >> 11) * 0x1p-53); }
  double log_uniform(double from, double to) { return from * std::exp(uniform(0, std::log(to / from))); }

 private:
  static std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  std::uint64_t state_;
};

}  // namespace vndf::reference
