// A column between two guards, at any alignment a float may have.
#pragma once

#include <cstdint>
#include <cstring>
#include <memory>
#include <vector>

namespace vndf::testing {

class GuardedColumn {
 public:
  /// `misalignment` floats past a multiple of 64 bytes.
  GuardedColumn(std::size_t count, std::size_t misalignment) : count_(count), storage_(count + 3 * kGuard, kPattern) {
    void* start = storage_.data() + kGuard;
    std::size_t space = kGuard * sizeof(float);
    std::align(64, 1, start, space);
    data_ = static_cast<float*>(start) + misalignment;
  }
  GuardedColumn(const std::vector<float>& values, std::size_t misalignment)
      : GuardedColumn(values.size(), misalignment) {
    if (count_) std::memcpy(data_, values.data(), count_ * sizeof(float));
  }

  float* data() { return data_; }
  std::vector<float> values() const { return {data_, data_ + count_}; }
  /// Nothing before or after the column was written.
  bool intact() const {
    for (const float* p = storage_.data(); p != storage_.data() + storage_.size(); ++p)
      if ((p < data_ || p >= data_ + count_) && std::memcmp(p, &kPattern, sizeof kPattern) != 0) return false;
    return true;
  }

 private:
  static constexpr std::size_t kGuard = 64;
  static constexpr float kPattern = -0x1.abcdefp77f;
  std::size_t count_;
  std::vector<float> storage_;
  float* data_;
};

}  // namespace vndf::testing
