// Memory of a column between two pages that nobody may touch: who reads or writes past the column's end, or before its
// beginning, is stopped there. What is left of the pages in between is filled with a pattern.
#pragma once

#include <cstring>

#include <sys/mman.h>
#include <unistd.h>

namespace vndf::fuzz {

class Fence {
 public:
  explicit Fence(std::size_t floats) : page_(std::size_t(sysconf(_SC_PAGESIZE))) {
    size_ = (floats * sizeof(float) + page_ - 1) / page_ * page_;
    void* all = mmap(nullptr, size_ + 2 * page_, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    inside_ = static_cast<char*>(all) + page_;
    if (all == MAP_FAILED || mprotect(inside_, size_, PROT_READ | PROT_WRITE) != 0) __builtin_trap();
  }
  ~Fence() { munmap(inside_ - page_, size_ + 2 * page_); }
  Fence(const Fence&) = delete;
  Fence& operator=(const Fence&) = delete;

  /// A column of `count` floats, `gap` floats from the end or from the beginning.
  float* place(std::size_t count, std::size_t gap, bool at_end) {
    bytes_ = count * sizeof(float);
    column_ = at_end ? inside_ + size_ - bytes_ - gap * sizeof(float) : inside_ + gap * sizeof(float);
    for (char* p = from(); p < to(); ++p)
      if (p < column_ || p >= column_ + bytes_) *p = kPattern;
    return reinterpret_cast<float*>(column_);
  }
  /// Whether the surroundings of the column are as they were.
  bool intact() const {
    for (const char* p = from(); p < to(); ++p)
      if ((p < column_ || p >= column_ + bytes_) && *p != kPattern) return false;
    return true;
  }

 private:
  static constexpr char kPattern = 0x5a;
  static constexpr std::size_t kSurroundings = 256;

  char* from() const { return column_ - inside_ > std::ptrdiff_t(kSurroundings) ? column_ - kSurroundings : inside_; }
  char* to() const {
    char *end = column_ + bytes_, *last = inside_ + size_;
    return last - end > std::ptrdiff_t(kSurroundings) ? end + kSurroundings : last;
  }

  std::size_t page_, size_, bytes_ = 0;
  char *inside_, *column_ = nullptr;
};

}  // namespace vndf::fuzz
