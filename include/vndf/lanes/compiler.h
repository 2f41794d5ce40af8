// What is a compiler's own, in one place: attributes and builtins as GCC and Clang spell them, clang-cl too, and as
// Microsoft's compiler does.
#pragma once

#if defined(__MINGW32__) && !defined(__clang__)
#error "GCC keeps vectors of 32 bytes on a stack that is aligned to 16 on Windows (its bug 54412): use Clang"
#endif

#if defined(_MSC_VER) && !defined(__clang__)

#include <intrin.h>
#include <cmath>

#define VNDF_INLINE __forceinline
#define VNDF_NOINLINE __declspec(noinline)
#define VNDF_SQRT std::sqrt  // an instruction
#define VNDF_SQRTF std::sqrt
#define VNDF_PREFETCH(p) _mm_prefetch(reinterpret_cast<const char*>(p), _MM_HINT_T0)
#define VNDF_GET_MXCSR _mm_getcsr
#define VNDF_SET_MXCSR _mm_setcsr

#else

#define VNDF_INLINE inline __attribute__((always_inline))
// One function for all kernels of an object; GCC would make a copy for each number of columns.
#if defined(__clang__)
#define VNDF_NOINLINE __attribute__((noinline))
#else
#define VNDF_NOINLINE __attribute__((noinline, noclone))
#endif
#define VNDF_SQRT __builtin_sqrt
#define VNDF_SQRTF __builtin_sqrtf
#define VNDF_PREFETCH(p) __builtin_prefetch(p, 0, 3)
#define VNDF_GET_MXCSR __builtin_ia32_stmxcsr
#define VNDF_SET_MXCSR __builtin_ia32_ldmxcsr

#endif
