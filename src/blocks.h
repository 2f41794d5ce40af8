// How a kernel walks its columns: in blocks that stay in the first-level cache, so that each stage of the mathematics
// is a loop of its own. One loop over all stages is one long chain of dependent operations, several square roots and
// divisions deep, of which a core can keep only a few in flight; short loops run up to 1.5 times as fast.
#pragma once

#include <vndf/lanes/simd.h>
#include <vndf/vndf.h>

namespace {

using F = VNDF_BATCH;
constexpr std::size_t kWidth = vndf::lanes::kWidth<F>;

/// Lanes of a block: its columns and what its stages hand one another fit into 32 KiB.
constexpr std::size_t kBlock = 256;

/// The inputs of a kernel: columns, or constants that are a vector wide and do not advance.
template <std::size_t N>
struct Inputs {
  const float* column[N];
  std::size_t advance[N];  // all bits set, or 0 for a constant

  template <std::size_t C>
  VNDF_INLINE F load(std::size_t i) const {
    return vndf::lanes::op::load<F>(column[C] + (i & advance[C]));
  }
};

/// Calls block(inputs, outputs, begin, end) over all of `count` indices: `begin` is a multiple of kBlock, `end` at most
/// kBlock more and a multiple of the vector width. What is left over goes through a padded copy, in a block of its own.
template <std::size_t N, std::size_t M, class Block>
VNDF_INLINE void for_each_block(std::size_t count, const vndf::Column (&columns)[N], float* const (&out)[M],
                                Block& block) {
  alignas(64) float constants[N][kWidth];
  Inputs<N> in;
  for (std::size_t c = 0; c < N; ++c) {
    bool constant = columns[c].data == nullptr;
    if (constant) vndf::lanes::op::store(F(columns[c].value), constants[c]);
    in.column[c] = constant ? constants[c] : columns[c].data;
    in.advance[c] = constant ? 0 : ~std::size_t(0);
  }

  std::size_t whole = count - count % kWidth;
  for (std::size_t begin = 0; begin < whole; begin += kBlock)
    block(in, out, begin, whole - begin < kBlock ? whole : begin + kBlock);

  if (std::size_t rest = count - whole) {
    alignas(64) float padded[N][kWidth], padded_out[M][kWidth];
    Inputs<N> tail;
    float* tail_out[M];
    for (std::size_t c = 0; c < N; ++c) {
      const float* from = in.column[c] + (whole & in.advance[c]);
      for (std::size_t i = 0; i < kWidth; ++i) padded[c][i] = from[(i < rest ? i : 0) & in.advance[c]];
      tail.column[c] = padded[c];
      tail.advance[c] = ~std::size_t(0);
    }
    for (std::size_t c = 0; c < M; ++c) tail_out[c] = padded_out[c];
    block(tail, tail_out, std::size_t(0), kWidth);
    for (std::size_t c = 0; c < M; ++c)
      for (std::size_t i = 0; i < rest; ++i) out[c][whole + i] = padded_out[c][i];
  }
}

/// A block of what one stage hands the next: T is an aggregate of lanes.
template <class T>
class Staged {
 public:
  VNDF_INLINE void store(std::size_t i, const T& value) {
    F members[kMembers];
    std::memcpy(members, &value, sizeof value);
    for (std::size_t c = 0; c < kMembers; ++c) vndf::lanes::op::store(members[c], lanes_[c] + i % kBlock);
  }
  VNDF_INLINE T load(std::size_t i) const {
    F members[kMembers];
    for (std::size_t c = 0; c < kMembers; ++c) members[c] = vndf::lanes::op::load<F>(lanes_[c] + i % kBlock);
    T value;
    std::memcpy(&value, members, sizeof value);
    return value;
  }

 private:
  static constexpr std::size_t kMembers = sizeof(T) / sizeof(F);
  alignas(64) float lanes_[kMembers][kBlock];
};

}  // namespace
