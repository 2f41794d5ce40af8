// The floating-point mode of a thread, as hosts set it: denormals flushed, other roundings.
#pragma once

#include <cstdint>

namespace vndf::testing {

#if defined(__SSE__)
inline unsigned float_mode() {
  return __builtin_ia32_stmxcsr() & ~0x3fu;  // without the flags of what has happened
}
inline void set_float_mode(unsigned mode) {
  __builtin_ia32_ldmxcsr(mode);
}
/// The usual one, FTZ, DAZ, both, and the other roundings.
constexpr unsigned kFloatModes[] = {0x1f80, 0x9f80, 0x1fc0, 0x9fc0, 0x3f80, 0x5f80, 0x7f80};
#elif defined(__aarch64__)
inline std::uint64_t float_mode() {
  std::uint64_t mode;
  __asm__ volatile("mrs %0, fpcr" : "=r"(mode));
  return mode;
}
inline void set_float_mode(std::uint64_t mode) {
  __asm__ volatile("msr fpcr, %0" : : "r"(mode));
}
constexpr std::uint64_t kFloatModes[] = {0, 1u << 24, 1u << 25, 3u << 24, 1u << 22, 2u << 22, 3u << 22};
#else
inline unsigned float_mode() {
  return 0;
}
inline void set_float_mode(unsigned) {}
constexpr unsigned kFloatModes[] = {0};
#endif

/// Puts the mode of the thread back at the end.
class InFloatMode {
 public:
  explicit InFloatMode(decltype(float_mode()) mode) : before_(float_mode()) { set_float_mode(mode); }
  ~InFloatMode() { set_float_mode(before_); }
  InFloatMode(const InFloatMode&) = delete;
  InFloatMode& operator=(const InFloatMode&) = delete;

 private:
  const decltype(float_mode()) before_;
};

}  // namespace vndf::testing
