// The lanes without the library: float and the widest batch agree.
#include <vndf/lanes.h>

#if defined(XSIMD_OF_HOST) && !defined(THIS_IS_THE_XSIMD_OF_THE_HOST)
#error "another xsimd than the host's"
#endif

int main() {
  using F = xsimd::batch<float>;
  namespace lanes = vndf::lanes;
  float u[lanes::kWidth<F>], x[lanes::kWidth<F>];
  for (std::size_t i = 0; i < lanes::kWidth<F>; ++i) u[i] = (float(i) + 0.5f) / 64;
  const F v = F::load_unaligned(u);
  lanes::sample_normal<lanes::Polar, F>({F(0.6f), F(0.f), F(0.8f)}, {F(0.3f), F(0.2f)}, {v, v}).x.store_unaligned(x);
  for (std::size_t i = 0; i < lanes::kWidth<F>; ++i)
    if (x[i] != lanes::sample_normal<lanes::Polar, float>({0.6f, 0.f, 0.8f}, {0.3f, 0.2f}, {u[i], u[i]}).x) return 1;
  return 0;
}
