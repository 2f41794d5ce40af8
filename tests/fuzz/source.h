// Where the choices of a call come from: bytes of a fuzzer that watches coverage, as far as they go, then random ones.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>

#include "reference/random.h"

namespace vndf::fuzz {

class Source {
 public:
  explicit Source(std::uint64_t seed, std::uint64_t call) : random_(seed, call) {}
  Source(const std::uint8_t* data, std::size_t size) : random_(size), data_(data), size_(size) {}

  std::uint64_t bits() {
    std::uint64_t value = random_.bits();
    if (std::size_t n = size_ < sizeof value ? size_ : sizeof value) {
      std::memcpy(&value, data_, n);
      data_ += n;
      size_ -= n;
    }
    return value;
  }
  /// A number in [0, n).
  std::uint32_t below(std::uint32_t n) { return std::uint32_t(bits() % n); }
  bool one_in(std::uint32_t n) { return below(n) == 0; }
  double uniform(double from, double to) { return from + (to - from) * (double(bits() >> 11) * 0x1p-53); }
  double log_uniform(double from, double to) { return std::exp(uniform(std::log(from), std::log(to))); }
  float any_float() {
    auto word = std::uint32_t(bits());
    float value;
    std::memcpy(&value, &word, sizeof value);
    return value;
  }

 private:
  reference::Random random_;
  const std::uint8_t* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace vndf::fuzz
