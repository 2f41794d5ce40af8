// Heitz 2018, Listing 1, as a person helps a compiler to vectorise it: structure-of-arrays loops, no branches, short
// blocks, under -ffast-math and with the vector mathematics library. Compiled once per instruction set; VNDF_PEER is
// the name that the copy exports.
#include <math.h>

#include "table.h"

namespace peers {
namespace {

constexpr std::size_t kBlock = 256;

void sample_block(std::size_t count, const float* __restrict wo_x, const float* __restrict wo_y,
                  const float* __restrict wo_z, const float* __restrict alpha_x, const float* __restrict alpha_y,
                  const float* __restrict u1, const float* __restrict u2, float* __restrict wm_x,
                  float* __restrict wm_y, float* __restrict wm_z) {
  constexpr float kTwoPi = 6.28318530717958647692f;
  // Sine and cosine in loops of their own: side by side, a compiler makes one sincosf call of them, which has no vector
  // version.
  float sin_phi[kBlock], cos_phi[kBlock];
  for (std::size_t i = 0; i < count; ++i) sin_phi[i] = sinf(kTwoPi * u2[i]);
  for (std::size_t i = 0; i < count; ++i) cos_phi[i] = cosf(kTwoPi * u2[i]);
  for (std::size_t i = 0; i < count; ++i) {
    float hx = alpha_x[i] * wo_x[i], hy = alpha_y[i] * wo_y[i], hz = wo_z[i];
    float scale = 1.f / sqrtf(hx * hx + hy * hy + hz * hz);
    hx *= scale;
    hy *= scale;
    hz *= scale;
    float lensq = hx * hx + hy * hy;
    float inverse = 1.f / sqrtf(lensq > 0.f ? lensq : 1.f);
    float t1x = lensq > 0.f ? -hy * inverse : 1.f;
    float t1y = lensq > 0.f ? hx * inverse : 0.f;
    float t2x = -hz * t1y, t2y = hz * t1x, t2z = hx * t1y - hy * t1x;
    float r = sqrtf(u1[i]);
    float p1 = r * cos_phi[i];
    float p2 = r * sin_phi[i];
    float s = 0.5f * (1.f + hz);
    float chord2 = 1.f - p1 * p1;
    p2 = (1.f - s) * sqrtf(chord2) + s * p2;
    float height2 = chord2 - p2 * p2;
    float height = sqrtf(height2 > 0.f ? height2 : 0.f);
    float nx = alpha_x[i] * (p1 * t1x + p2 * t2x + height * hx);
    float ny = alpha_y[i] * (p1 * t1y + p2 * t2y + height * hy);
    float nz = p2 * t2z + height * hz;
    nz = nz > 0.f ? nz : 0.f;
    float length = 1.f / sqrtf(nx * nx + ny * ny + nz * nz);
    wm_x[i] = nx * length;
    wm_y[i] = ny * length;
    wm_z[i] = nz * length;
  }
}

}  // namespace

void VNDF_PEER(std::size_t count, const float* const in[7], float* const out[3]) {
  for (std::size_t i = 0; i < count; i += kBlock) {
    std::size_t block = count - i < kBlock ? count - i : kBlock;
    sample_block(block, in[0] + i, in[1] + i, in[2] + i, in[3] + i, in[4] + i, in[5] + i, in[6] + i, out[0] + i,
                 out[1] + i, out[2] + i);
  }
}

}  // namespace peers
