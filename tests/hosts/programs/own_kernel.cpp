// A fused kernel of one's own, from world-space hits to world-space directions, weights and densities, with a dispatch
// of its own: the bits are those of the batch function between steps in float.
#include "own_kernel.h"

#include <vndf/lanes.h>
#include <vndf/vndf.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace lanes = vndf::lanes;
constexpr std::size_t kCount = 1024;
using Column = std::vector<float>;
using Columns = std::vector<Column>;

static void point(const float* (&to)[3], const Columns& from, std::size_t first) {
  for (std::size_t c = 0; c < 3; ++c) to[c] = from[first + c].data();
}

int main() {
  Columns in(14, Column(kCount)), out(5, Column(kCount)), expected = out, local(4, Column(kCount)), wi = local;
  for (std::size_t i = 0; i < kCount; ++i) {
    // Hits around a sphere, seen from above its north pole's right.
    float phi = 0.1f * float(i), s = std::sin(phi), c = std::cos(phi), z = 0.9f * float(i) / kCount,
          r = std::sqrt(1 - z * z);
    const float values[] = {-s,
                            c,
                            0,
                            -z * c,
                            -z * s,
                            r,
                            r * c,
                            r * s,
                            z,
                            0.48f,
                            0.36f,
                            0.8f,
                            float(i * 37 % kCount) / kCount,
                            (float(i) + 0.5f) / kCount};
    for (std::size_t k = 0; k < in.size(); ++k) in[k][i] = values[k];
  }
  Hits hits = {kCount, {}, {}, {}, {}, {in[12].data(), in[13].data()}, 0.2f, 0.4f, 0.2f, 3.9f, {}, nullptr, nullptr};
  point(hits.x, in, 0), point(hits.y, in, 3), point(hits.z, in, 6), point(hits.wo, in, 9);

  // The same in three passes.
  auto at = [&](std::size_t first, std::size_t i) {
    return lanes::Vec3<float>{in[first][i], in[first + 1][i], in[first + 2][i]};
  };
  for (std::size_t i = 0; i < kCount; ++i) {
    auto wo = to_local(at(9, i), lanes::Frame<float>{at(0, i), at(3, i), at(6, i)});
    local[0][i] = wo.x, local[1][i] = wo.y, local[2][i] = wo.z;
  }
  vndf::ReflectionSamples samples{{wi[0].data(), wi[1].data(), wi[2].data()}, expected[4].data(), expected[3].data()};
  samples.wo_dot_wm = local[3].data();
  vndf::sample_reflection(vndf::Warp::concentric, kCount, {local[0].data(), local[1].data(), local[2].data()},
                          {hits.alpha_x, hits.alpha_y}, {hits.u[0], hits.u[1]}, samples);
  for (std::size_t i = 0; i < kCount; ++i) {
    auto v = to_world({wi[0][i], wi[1][i], wi[2][i]}, lanes::Frame<float>{at(0, i), at(3, i), at(6, i)});
    expected[0][i] = v.x, expected[1][i] = v.y, expected[2][i] = v.z;
    expected[3][i] *= lanes::conductor_reflectance(local[3][i], hits.eta, hits.k);
  }

  struct Kernel {
    const char* name;
    bool supported;
    void (*shade)(const Hits&);
  };
  const Kernel kernels[] = {
    {"scalar", true, shade_scalar},
#if defined(__x86_64__)
    {"sse42", bool(__builtin_cpu_supports("sse4.2")), shade_sse42},
    {"avx2", bool(__builtin_cpu_supports("avx2")), shade_avx2},  // a renderer takes the last one that is supported
#endif
  };
  bool good = true;
  const auto lit =
      std::size_t(std::count_if(expected[4].begin(), expected[4].end(), [](float pdf) { return pdf > 0; }));
  for (const Kernel& kernel : kernels) {
    if (!kernel.supported) continue;
    for (Column& column : out) column.assign(kCount, 0.f);
    for (std::size_t c = 0; c < 3; ++c) hits.wi[c] = out[c].data();
    hits.weight = out[3].data(), hits.pdf = out[4].data();
    kernel.shade(hits);
    bool same = out == expected && lit > kCount / 4;
    std::printf("%s: %s\n", kernel.name, same ? "the same bits" : "other bits");
    good &= same;
  }
  return good ? 0 : 1;
}
