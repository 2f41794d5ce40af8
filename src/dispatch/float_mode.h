// The bits are those of C++'s own floating-point mode. A program may run in another one without knowing: GCC links code
// that flushes denormals into whatever is linked with -ffast-math, and renderers set it in their threads.
#pragma once

#include <cstdint>

#include <vndf/lanes/compiler.h>

namespace vndf {

/// To nearest, denormals kept, no traps, for as long as it lives; what is computed must be a call that is not inlined.
/// Where the mode is so already, as mostly, it costs a read.
class FloatMode {
#if defined(__SSE__) || defined(_M_X64)
  using Bits = unsigned;
  // Flush to zero, rounding, masks, denormals are zero; the flags below are not a mode.
  static constexpr Bits kMode = 0xffc0, kExact = 0x1f80;
  static Bits get() noexcept {
    return VNDF_GET_MXCSR();
  }
  static void set(Bits bits) noexcept {
    VNDF_SET_MXCSR(bits);
  }
#elif defined(__aarch64__)
  using Bits = std::uint64_t;
  // Alternative and default NaN, flush to zero, rounding, traps, and what emulators of x86 set.
  static constexpr Bits kMode = 0x07c89f07, kExact = 0;
  static Bits get() noexcept {
    Bits bits;
    __asm__ volatile("mrs %0, fpcr" : "=r"(bits));
    return bits;
  }
  static void set(Bits bits) noexcept {
    __asm__ volatile("msr fpcr, %0" : : "r"(bits));
  }
#else
  using Bits = unsigned;
  static constexpr Bits kMode = 0, kExact = 0;
  static Bits get() noexcept {
    return 0;
  }
  static void set(Bits) noexcept {}
#endif

 public:
  FloatMode() noexcept : before_(get()) {
    if ((before_ & kMode) != kExact) set((before_ & ~kMode) | kExact);
  }
  ~FloatMode() {
    if ((before_ & kMode) != kExact) set(before_);
  }
  FloatMode(const FloatMode&) = delete;
  FloatMode& operator=(const FloatMode&) = delete;

 private:
  const Bits before_;
};

}  // namespace vndf
