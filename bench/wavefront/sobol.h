// Owen-scrambled Sobol points, four dimensions at a time. Each use of random numbers (the camera, a vertex's BSDF, its
// light) is one set of four; sets are decorrelated by scrambling the order of the points, Burley 2020, Practical
// Hash-based Owen Scrambling, section 4.
#pragma once

#include <cstdint>

namespace wavefront {

/// Samples a pixel can have before its points repeat.
constexpr std::uint32_t kMostSamples = 1u << 16;

struct Random4 {
  float x[4];
};

/// `sample` as the functions below take it: its bits reversed, once per path.
std::uint32_t reversed(std::uint32_t sample);
/// A seed for every pixel.
std::uint32_t pixel_seed(std::uint32_t x, std::uint32_t y, std::uint32_t seed);
/// Point `reversed_sample` of set number `set`, in [0, 1).
Random4 random4(std::uint32_t reversed_sample, std::uint32_t seed, std::uint32_t set);

}  // namespace wavefront
