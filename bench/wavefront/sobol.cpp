#include "sobol.h"

#include <boost/random/sobol.hpp>

namespace wavefront {
namespace {

/// A hash of 32 bits in which every input bit reaches every output bit.
std::uint32_t mixed(std::uint32_t a) {
  a = (a ^ (a >> 16)) * 0x7feb352du;  // the multipliers of Wellons' lowbias32
  a = (a ^ (a >> 15)) * 0x846ca68bu;
  return a ^ (a >> 16);
}

/// Owen's nested scrambling of a number whose bits are reversed: every step carries information from low bits to high
/// ones alone, Laine and Karras 2011, so a bit is flipped by a hash of the bits that are more significant in the
/// number.
std::uint32_t scrambled(std::uint32_t a, std::uint32_t seed) {
  a += seed;
  a ^= a * 0x6c50b47cu;  // the even multipliers of Burley 2020
  a ^= a * 0xb82f1e52u;
  a ^= a * 0xc7afe638u;
  a ^= a * 0x8d22f6e6u;
  return a;
}

struct Point {
  std::uint32_t x[4];
};

/// The points of the sequence, bits reversed, for either half of a 16-bit index that is reversed itself.
struct Tables {
  Point high[256], low[256];
  Tables() {
    boost::random::sobol_engine<std::uint32_t, 32> engine(4);
    Point direction[16];
    for (unsigned bit = 0; bit < 16; ++bit) {
      engine.seed((2u << bit) - 2u);  // Gray's code of the next index has this bit alone
      for (auto& x : direction[bit].x) x = reversed(static_cast<std::uint32_t>(engine()));
    }
    for (unsigned i = 0; i < 256; ++i)
      for (int d = 0; d < 4; ++d) {
        high[i].x[d] = low[i].x[d] = 0;
        for (unsigned bit = 0; bit < 8; ++bit)
          if (i >> bit & 1) {
            high[i].x[d] ^= direction[7 - bit].x[d];
            low[i].x[d] ^= direction[15 - bit].x[d];
          }
      }
  }
};
const Tables kTables;

}  // namespace

std::uint32_t reversed(std::uint32_t a) {
  a = (a >> 1 & 0x55555555u) | (a & 0x55555555u) << 1;
  a = (a >> 2 & 0x33333333u) | (a & 0x33333333u) << 2;
  a = (a >> 4 & 0x0f0f0f0fu) | (a & 0x0f0f0f0fu) << 4;
  return __builtin_bswap32(a);
}

std::uint32_t pixel_seed(std::uint32_t x, std::uint32_t y, std::uint32_t seed) {
  return mixed(x ^ mixed(y ^ mixed(seed)));
}

Random4 random4(std::uint32_t reversed_sample, std::uint32_t seed, std::uint32_t set) {
  std::uint32_t key = mixed(seed ^ set * 0x9e3779b9u);
  // The order of the points is scrambled as the points are, so that any power of two of them stays a net.
  std::uint32_t index = scrambled(reversed_sample, key);
  const Point &high = kTables.high[index >> 24], &low = kTables.low[index >> 16 & 255];
  Random4 result;
  for (std::uint32_t d = 0; d < 4; ++d) {
    std::uint32_t bits = reversed(scrambled(high.x[d] ^ low.x[d], key * (2 * d + 3) ^ d * 0x85ebca6bu));
    result.x[d] = static_cast<float>(static_cast<std::int32_t>(bits >> 8)) * 0x1p-24f;
  }
  return result;
}

}  // namespace wavefront
