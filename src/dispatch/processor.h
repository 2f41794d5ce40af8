// What the processor has and the operating system saves, by the names that cmake/isa.cmake uses.
#pragma once

#if defined(_MSC_VER)

#include <intrin.h>
#include <cstring>

namespace vndf {

/// In place of __builtin_cpu_supports: Microsoft's compiler has none, and that of clang-cl needs LLVM's run-time
/// library.
inline bool processor_has(const char* feature) noexcept {
  int highest[4], first[4], seventh[4] = {};
  __cpuid(highest, 0);
  __cpuid(first, 1);
  if (highest[0] >= 7) __cpuidex(seventh, 7, 0);
  // Which registers the system saves. The question exists where bit 27 says so.
  const unsigned long long saved = first[2] >> 27 & 1 ? _xgetbv(0) : 0;
  const bool ymm = (saved & 0x6) == 0x6, zmm = (saved & 0xe6) == 0xe6;
  auto is = [&](const char* name) { return std::strcmp(feature, name) == 0; };
  if (is("sse4.2")) return first[2] >> 20 & 1;
  if (is("avx2")) return ymm && (seventh[1] >> 5 & 1);
  if (is("avx512f")) return zmm && (seventh[1] >> 16 & 1);
  if (is("avx512dq")) return zmm && (seventh[1] >> 17 & 1);
  if (is("avx512cd")) return zmm && (seventh[1] >> 28 & 1);
  if (is("avx512bw")) return zmm && (seventh[1] >> 30 & 1);
  return false;
}

}  // namespace vndf

#define VNDF_PROCESSOR_HAS(feature) vndf::processor_has(feature)

#else

/// Asked by a constructor that runs before libgcc's own, it would otherwise say no to everything. A macro, since the
/// builtin takes literals alone.
#define VNDF_PROCESSOR_HAS(feature) (__builtin_cpu_init(), __builtin_cpu_supports(feature))

#endif
