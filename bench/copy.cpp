// The roofline: the sampling functions' traffic, seven columns read and three written, with nothing computed. Compiled
// once per instruction set, for its vector width; VNDF_COPY_PLAIN and VNDF_COPY_STREAMING are the names exported.
//
// Every column has to be read, so those that have no column to be copied to are folded into the third with an integer
// OR: four of the cheapest instructions there are for seven loads and three stores, which bound the loop by themselves.
#include <cstddef>

#if defined(__AVX512F__)
#define VNDF_COPY_BYTES 64
#elif defined(__AVX2__)
#define VNDF_COPY_BYTES 32
#elif defined(__SSE4_2__)
#define VNDF_COPY_BYTES 16
#else
#define VNDF_COPY_BYTES 4
#endif

namespace {

constexpr std::size_t kWidth = VNDF_COPY_BYTES / sizeof(float);

#if VNDF_COPY_BYTES == 4
using Bits = int;
using UnalignedBits = int __attribute__((may_alias));
#else
typedef int Bits __attribute__((vector_size(VNDF_COPY_BYTES)));
typedef int UnalignedBits __attribute__((vector_size(VNDF_COPY_BYTES), aligned(4), may_alias));
#endif

inline Bits load(const float* p) {
  return *reinterpret_cast<const UnalignedBits*>(p);
}

struct PlainStore {
  void operator()(Bits a, float* p) const { *reinterpret_cast<UnalignedBits*>(p) = a; }
};

/// Past the caches; p is aligned to the vector.
struct StreamingStore {
  void operator()(Bits a, float* p) const {
#if defined(__clang__)
    __builtin_nontemporal_store(a, reinterpret_cast<Bits*>(p));
#elif VNDF_COPY_BYTES == 64
    typedef float Floats __attribute__((vector_size(64)));
    __builtin_ia32_movntps512(p, (Floats)a);
#elif VNDF_COPY_BYTES == 32
    typedef float Floats __attribute__((vector_size(32)));
    __builtin_ia32_movntps256(p, (Floats)a);
#elif VNDF_COPY_BYTES == 16
    typedef float Floats __attribute__((vector_size(16)));
    __builtin_ia32_movntps(p, (Floats)a);
#elif defined(__SSE2__)
    __builtin_ia32_movnti(reinterpret_cast<int*>(p), a);
#else
    PlainStore()(a, p);
#endif
  }
};

template <class Store>
void copy(std::size_t count, const float* const in[7], float* const out[3], Store store) {
  // The addresses in locals: the stores might otherwise change them.
  const float *a = in[0], *b = in[1], *c = in[2], *d = in[3], *e = in[4], *f = in[5], *g = in[6];
  float *x = out[0], *y = out[1], *z = out[2];
  // What is left over of a vector is not worth a thought in a roofline: the benchmark's counts are multiples.
  for (std::size_t i = 0; i + kWidth <= count; i += kWidth) {
    store(load(a + i), x + i);
    store(load(b + i), y + i);
    store((load(c + i) | load(d + i)) | (load(e + i) | load(f + i)) | load(g + i), z + i);
  }
}

}  // namespace

void VNDF_COPY_PLAIN(std::size_t count, const float* const in[7], float* const out[3]) {
  copy(count, in, out, PlainStore());
}

void VNDF_COPY_STREAMING(std::size_t count, const float* const in[7], float* const out[3]) {
  copy(count, in, out, StreamingStore());
#if defined(__SSE2__)
  // Streaming stores are ordered by a fence only; a copy is done when it is visible.
  __builtin_ia32_sfence();
#endif
}
