// How a kernel walks its columns: in blocks that stay in the first-level cache, so that each stage of the mathematics
// is a loop of its own. One loop over all stages is one long chain of dependent operations, several square roots and
// divisions deep, of which a core can keep only a few in flight; short loops run up to 1.5 times as fast.
#pragma once

#include <vndf/lanes/simd.h>
#include <vndf/vndf.h>

namespace {

using F = VNDF_BATCH;
constexpr std::size_t kWidth = vndf::lanes::kWidth<F>;

constexpr std::size_t kCacheLine = 64 / sizeof(float);

/// Lanes of a block: for plain GGX its columns and what its stages hand one another fit into 32 KiB.
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

  /// Asks for what the next block but one will load. A kernel spreads these over its stages: the loops that only
  /// compute are when the memory would idle, and hardware prefetchers do not see a column that is read in bursts.
  template <std::size_t... C>
  VNDF_INLINE void prefetch(std::size_t i) const {
    if (i % kCacheLine == 0) (vndf::lanes::op::prefetch(column[C] + (i & advance[C]) + 2 * kBlock), ...);
  }
};

/// The outputs of a kernel.
template <std::size_t M>
struct Outputs {
  float* column[M];
  bool streaming;  // past the caches

  template <std::size_t C>
  VNDF_INLINE void store(std::size_t i, F value) const {
    if (streaming)
      vndf::lanes::op::stream(value, column[C] + i);
    else
      vndf::lanes::op::store(value, column[C] + i);
  }
};

/// Batches of this many lanes write past the caches where their columns are aligned for it: their columns are larger
/// than a core's share of any last-level cache, and a line that is only written need not be read first.
constexpr std::size_t kStreaming = std::size_t(1) << 20;

/// Calls kernel(inputs, outputs, begin, end) for block after block of all `count` indices: `begin` is a multiple of
/// kBlock, `end` at most kBlock more and a multiple of the vector width. What is left over goes through a padded copy.
/// A result that is a null pointer stays one, and the kernel must not store to it.
template <std::size_t N, std::size_t M, class Kernel>
VNDF_INLINE void for_each_block(std::size_t count, const vndf::Column* const (&columns)[N], float* const (&results)[M],
                                Kernel& kernel) {
  alignas(64) float constants[N][kWidth];
  Inputs<N> in;
  for (std::size_t c = 0; c < N; ++c) {
    const float* data = columns[c]->data;
    if (!data) vndf::lanes::op::store(F(columns[c]->value), constants[c]);
    in.column[c] = data ? data : constants[c];
    in.advance[c] = std::size_t(0) - (data != nullptr);
  }
  Outputs<M> out;
  out.streaming = count >= kStreaming;
  for (std::size_t c = 0; c < M; ++c) {
    out.column[c] = results[c];
    out.streaming &= reinterpret_cast<std::uintptr_t>(results[c]) % sizeof(F) == 0;
  }

  std::size_t whole = count - count % kWidth;
  for (std::size_t begin = 0; begin < whole; begin += kBlock)
    kernel(in, out, begin, whole - begin < kBlock ? whole : begin + kBlock);
  if (out.streaming) vndf::lanes::op::finish_streaming();

  if (std::size_t rest = count - whole) {
    alignas(64) float padded[N][kWidth], padded_results[M][kWidth];
    Inputs<N> tail;
    Outputs<M> tail_out;
    for (std::size_t c = 0; c < N; ++c) {
      const float* from = in.column[c] + (whole & in.advance[c]);
      for (std::size_t i = 0; i < kWidth; ++i) padded[c][i] = from[(i < rest ? i : 0) & in.advance[c]];
      tail.column[c] = padded[c];
      tail.advance[c] = ~std::size_t(0);
    }
    tail_out.streaming = false;
    for (std::size_t c = 0; c < M; ++c) tail_out.column[c] = results[c] ? padded_results[c] : nullptr;
    kernel(tail, tail_out, std::size_t(0), kWidth);
    for (std::size_t c = 0; c < M; ++c)
      for (std::size_t i = 0; i < rest && results[c]; ++i) results[c][whole + i] = padded_results[c][i];
  }
}

/// A block of what one stage hands the next: T is an aggregate of lanes.
template <class T, std::size_t kLanes = kBlock>
class Staged {
 public:
  // Member by member: a copy of the whole aggregate may go through memory, in pieces that stall its reads.
  VNDF_INLINE void store(std::size_t i, const T& value) {
    for (std::size_t c = 0; c < kMembers; ++c)
      vndf::lanes::op::store(reinterpret_cast<const F*>(&value)[c], lanes_[c] + i % kLanes);
  }
  VNDF_INLINE T load(std::size_t i) const {
    T value;
    for (std::size_t c = 0; c < kMembers; ++c)
      reinterpret_cast<F*>(&value)[c] = vndf::lanes::op::load<F>(lanes_[c] + i % kLanes);
    return value;
  }

 private:
  static constexpr std::size_t kMembers = sizeof(T) / sizeof(F);
  alignas(64) float lanes_[kMembers][kLanes];
};

}  // namespace
