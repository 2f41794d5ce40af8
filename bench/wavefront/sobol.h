// Owen-scrambled Sobol points, four dimensions at a time. Each use of random numbers (the camera, a vertex's BSDF, its
// light) is one set of four; sets are decorrelated by scrambling the order of the points, Burley 2020, Practical
// Hash-based Owen Scrambling, section 4.
#pragma once

#include <cstdint>

#include <ImathVec.h>
#include <boost/random/sobol.hpp>

namespace wavefront {

/// Samples a pixel can have before its points repeat.
constexpr std::uint32_t kMostSamples = 1u << 16;

inline std::uint32_t reversed_bits(std::uint32_t a) {
  a = (a >> 1 & 0x55555555u) | (a & 0x55555555u) << 1;
  a = (a >> 2 & 0x33333333u) | (a & 0x33333333u) << 2;
  a = (a >> 4 & 0x0f0f0f0fu) | (a & 0x0f0f0f0fu) << 4;
  return __builtin_bswap32(a);
}
/// A hash of 32 bits in which every input bit reaches every output bit.
inline std::uint32_t mixed(std::uint32_t a) {
  a = (a ^ (a >> 16)) * 0x7feb352du;  // the multipliers of Wellons' lowbias32
  a = (a ^ (a >> 15)) * 0x846ca68bu;
  return a ^ (a >> 16);
}
/// Owen's nested scrambling of a number whose bits are reversed: every step carries information from low bits to high
/// ones alone, Laine and Karras 2011, so a bit is flipped by a hash of the bits that are more significant in the
/// number.
inline std::uint32_t scrambled(std::uint32_t a, std::uint32_t seed) {
  a += seed;
  a ^= a * 0x6c50b47cu;  // the even multipliers of Burley 2020
  a ^= a * 0xb82f1e52u;
  a ^= a * 0xc7afe638u;
  return a ^ a * 0x8d22f6e6u;
}

/// The first points of the sequence, bits reversed, by either half of a 16-bit index that is reversed itself. The one
/// of any index is the exclusive or of two.
inline const struct SobolPoints {
  std::uint32_t high[256][4] = {}, low[256][4] = {};

  SobolPoints() {
    boost::random::sobol_engine<std::uint32_t, 32> engine(4);  // from point 1 on
    for (std::uint32_t i = 1; i < kMostSamples; ++i)
      for (int d = 0; d < 4; ++d) {
        std::uint32_t x = reversed_bits(static_cast<std::uint32_t>(engine()));
        if (i < 256) high[reversed_bits(i) >> 24][d] = x;
        if (i % 256 == 0) low[reversed_bits(i) >> 16][d] = x;
      }
  }
} kSobolPoints;

/// Set number `set` of a sample, in [0, 1). The number of the sample comes with its bits reversed.
inline Imath::V4f random4(std::uint32_t reversed_sample, std::uint32_t seed, std::uint32_t set) {
  std::uint32_t key = mixed(seed ^ set * 0x9e3779b9u);
  // The order of the points is scrambled as the points are, so that any power of two of them stays a net.
  std::uint32_t index = scrambled(reversed_sample, key);
  const std::uint32_t *high = kSobolPoints.high[index >> 24], *low = kSobolPoints.low[index >> 16 & 255];
  Imath::V4f result;
  for (int d = 0; d < 4; ++d) {
    std::uint32_t bits = reversed_bits(scrambled(high[d] ^ low[d], key * (2 * d + 3) ^ d * 0x85ebca6bu));
    result[d] = static_cast<float>(static_cast<std::int32_t>(bits >> 8)) * 0x1p-24f;
  }
  return result;
}

}  // namespace wavefront
