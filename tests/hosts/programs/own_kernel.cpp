// The lane functions in a kernel of one's own, with the bits of the batch functions.
#include <vndf/lanes.h>
#include <vndf/vndf.h>

int main() {
  using F = xsimd::batch<float>;
  namespace lanes = vndf::lanes;
  float u1[64], u2[64], x[64], y[64], z[64], fused[3][64];
  for (int i = 0; i < 64; ++i) {
    u1[i] = (float(i) + 0.5f) / 64;
    u2[i] = float(i * 37 % 64) / 64;
  }
  vndf::sample_normals(vndf::Warp::concentric, 64, {0.6f, 0.f, 0.8f}, {0.3f, 0.2f}, {u1, u2}, {x, y, z});
  for (std::size_t i = 0; i < 64; i += lanes::kWidth<F>) {
    lanes::Vec2<F> u{F::load_unaligned(u1 + i), F::load_unaligned(u2 + i)};
    auto wm = lanes::sample_normal<lanes::Concentric, F>({F(0.6f), F(0.f), F(0.8f)}, {F(0.3f), F(0.2f)}, u);
    wm.x.store_unaligned(fused[0] + i);
    wm.y.store_unaligned(fused[1] + i);
    wm.z.store_unaligned(fused[2] + i);
  }
  for (int i = 0; i < 64; ++i)
    if (fused[0][i] != x[i] || fused[1][i] != y[i] || fused[2][i] != z[i]) return 1;
  return 0;
}
