// How a kernel walks its columns: in blocks that stay in the first-level cache, so that each stage of the mathematics
// is a loop of its own. One loop over all stages is one long chain of dependent operations, several square roots and
// divisions deep, of which a core can keep only a few in flight; short loops run up to 1.5 times as fast.
#pragma once

#include <vndf/lanes/simd.h>
#include <vndf/vndf.h>

namespace {

using F = VNDF_BATCH;
constexpr std::size_t kWidth = vndf::lanes::kWidth<F>;
constexpr std::size_t kBlock = 256;

/// The inputs of one block: columns, or constants that are a vector wide and do not advance.
template <std::size_t N>
struct Inputs {
  const float* column[N];
  std::size_t step[N];  // 1, or 0 for a constant

  template <std::size_t C>
  VNDF_INLINE F load(std::size_t lane) const {
    return vndf::lanes::op::load<F>(column[C] + lane * step[C]);
  }
};

/// Calls block(inputs, outputs, lanes) over all of `count` indices; `lanes` is a multiple of the vector width and at
/// most kBlock. What is left over goes through a padded copy, in a block of its own.
template <std::size_t N, std::size_t M, class Block>
VNDF_INLINE void for_each_block(std::size_t count, const vndf::Column (&columns)[N], float* const (&results)[M],
                                Block block) {
  alignas(64) float constants[N][kWidth];
  Inputs<N> in;
  float* out[M];
  for (std::size_t c = 0; c < N; ++c) {
    bool constant = columns[c].data() == nullptr;
    if (constant) vndf::lanes::op::store(F(columns[c].value()), constants[c]);
    in.column[c] = constant ? constants[c] : columns[c].data();
    in.step[c] = constant ? 0 : 1;
  }
  for (std::size_t c = 0; c < M; ++c) out[c] = results[c];

  std::size_t whole = count - count % kWidth;
  for (std::size_t begin = 0; begin < whole; begin += kBlock) {
    std::size_t lanes = whole - begin < kBlock ? whole - begin : kBlock;
    block(in, out, lanes);
    for (std::size_t c = 0; c < N; ++c) in.column[c] += lanes * in.step[c];
    for (std::size_t c = 0; c < M; ++c) out[c] += lanes;
  }
  if (std::size_t rest = count - whole) {
    alignas(64) float padded[N][kWidth], results_padded[M][kWidth];
    Inputs<N> tail;
    float* tail_out[M];
    for (std::size_t c = 0; c < N; ++c) {
      for (std::size_t i = 0; i < kWidth; ++i) padded[c][i] = in.column[c][(i < rest ? i : 0) * in.step[c]];
      tail.column[c] = padded[c];
      tail.step[c] = 1;
    }
    for (std::size_t c = 0; c < M; ++c) tail_out[c] = results_padded[c];
    block(tail, tail_out, kWidth);
    for (std::size_t c = 0; c < M; ++c)
      for (std::size_t i = 0; i < rest; ++i) out[c][i] = results_padded[c][i];
  }
}

/// A block of what one stage hands the next: T is an aggregate of lanes.
template <class T>
class Staged {
 public:
  VNDF_INLINE void store(std::size_t lane, const T& value) {
    F members[kMembers];
    std::memcpy(members, &value, sizeof value);
    for (std::size_t c = 0; c < kMembers; ++c) vndf::lanes::op::store(members[c], lanes_[c] + lane);
  }
  VNDF_INLINE T load(std::size_t lane) const {
    F members[kMembers];
    for (std::size_t c = 0; c < kMembers; ++c) members[c] = vndf::lanes::op::load<F>(lanes_[c] + lane);
    T value;
    std::memcpy(&value, members, sizeof value);
    return value;
  }

 private:
  static constexpr std::size_t kMembers = sizeof(T) / sizeof(F);
  alignas(64) float lanes_[kMembers][kBlock];
};

/// One stage: f(lane) for each vector of the block.
template <class Stage>
VNDF_INLINE void stage(std::size_t lanes, Stage f) {
  for (std::size_t lane = 0; lane < lanes; lane += kWidth) f(lane);
}

}  // namespace
