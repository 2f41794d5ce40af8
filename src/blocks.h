// How a kernel walks its columns: in blocks that stay in the first-level cache, so that each stage of the mathematics
// is a loop of its own. One loop over all stages is one long chain of dependent operations, several square roots and
// divisions deep, of which a core can keep only a few in flight; short loops run up to 1.5 times as fast.
#pragma once

#include <utility>

#include <vndf/lanes/simd.h>
#include <vndf/vndf.h>

namespace {

using F = VNDF_BATCH;
constexpr std::size_t kWidth = vndf::lanes::kWidth<F>;

constexpr std::size_t kCacheLine = 64 / sizeof(float);

/// Lanes of a block: for plain GGX its columns and what its stages hand one another fit into 32 KiB.
constexpr std::size_t kBlock = 256;

/// The inputs of a block: N columns.
template <std::size_t N>
struct Inputs {
  const float* column[N];

  template <std::size_t C>
  VNDF_INLINE F load(std::size_t i) const {
    return vndf::lanes::op::load<F>(column[C] + i);
  }

  /// Asks for what will be loaded two blocks on, or four of the shading step's. A kernel spreads these over its stages:
  /// the loops that only compute are when the memory would idle, and hardware prefetchers do not see a column that is
  /// read in bursts.
  template <std::size_t... C>
  VNDF_INLINE void prefetch(std::size_t i) const {
    if (i % kCacheLine == 0) (vndf::lanes::op::prefetch(column[C] + i + 2 * kBlock), ...);
  }
};

/// Its outputs.
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

/// Calls kernel(inputs, outputs, n) for block after block of all `count` lanes: n is at most Kernel::kLanes and a
/// multiple of the vector width, and the columns begin at 0. Constants are columns too, a block long. What is left over
/// goes through a padded copy. A result that is a null pointer stays one, and the kernel must not store to it.
template <std::size_t N, std::size_t M, class Kernel>
VNDF_INLINE void for_each_block(std::size_t count, const vndf::Column* const (&columns)[N], float* const (&results)[M],
                                Kernel& kernel) {
  constexpr std::size_t kLanes = Kernel::kLanes;
  auto at = [](auto* column, std::size_t i) { return column ? column + i : nullptr; };
  alignas(64) float constants[N][kLanes];
  Inputs<N> in;
  for (std::size_t c = 0; c < N; ++c) {
    if (columns[c]->data) continue;
    in.column[c] = constants[c];
    for (std::size_t i = 0; i < kLanes && i < count; i += kWidth)
      vndf::lanes::op::store(F(columns[c]->value), constants[c] + i);
  }
  Outputs<M> out;
  out.streaming = count >= kStreaming;
  for (float* result : results) out.streaming &= reinterpret_cast<std::uintptr_t>(result) % sizeof(F) == 0;

  std::size_t whole = count - count % kWidth;
  for (std::size_t begin = 0; begin < whole; begin += kLanes) {
    for (std::size_t c = 0; c < N; ++c)
      if (columns[c]->data) in.column[c] = columns[c]->data + begin;
    for (std::size_t c = 0; c < M; ++c) out.column[c] = at(results[c], begin);
    kernel(in, out, whole - begin < kLanes ? whole - begin : kLanes);
  }
  if (out.streaming) vndf::lanes::op::finish_streaming();

  if (std::size_t rest = count - whole) {
    alignas(64) float padded[N][kWidth], padded_results[M][kWidth];
    for (std::size_t c = 0; c < N; ++c) {
      if (!columns[c]->data) continue;
      const float* from = columns[c]->data + whole;
      for (std::size_t i = 0; i < kWidth; ++i) padded[c][i] = from[i < rest ? i : 0];
      in.column[c] = padded[c];
    }
    out.streaming = false;
    for (std::size_t c = 0; c < M; ++c) out.column[c] = results[c] ? padded_results[c] : nullptr;
    kernel(in, out, kWidth);
    for (std::size_t c = 0; c < M; ++c)
      for (std::size_t i = 0; i < rest && results[c]; ++i) results[c][whole + i] = padded_results[c][i];
  }
}

/// second(i, first(i)) for each vector of a block. The first of the next one is computed beside: one after the other
/// they are a chain too long for a core to overlap, and this way what is between them stays in registers.
template <class First, class Second>
VNDF_INLINE void for_each_ahead(std::size_t n, First first, Second second) {
  auto next = first(0);
  for (std::size_t i = 0; i < n; i += kWidth) {
    auto now = next;
    next = first(i + kWidth < n ? i + kWidth : 0);
    second(i, now);
  }
}

/// A block of what one stage hands the next: T is a lane, or an aggregate of lanes.
template <class T, std::size_t kLanes = kBlock>
class Staged {
 public:
  VNDF_INLINE void store(std::size_t i, const T& value) { store(i, value, Members()); }
  VNDF_INLINE T load(std::size_t i) const { return load(i, Members()); }

 private:
  static constexpr std::size_t kMembers = sizeof(T) / sizeof(F);
  using Members = std::make_index_sequence<kMembers>;

  // Member by member: a copy of the whole aggregate may go through memory, in pieces that stall its reads.
  template <std::size_t... C>
  VNDF_INLINE void store(std::size_t i, const T& value, std::index_sequence<C...>) {
    (vndf::lanes::op::store(reinterpret_cast<const F*>(&value)[C], lanes_[C] + i), ...);
  }
  template <std::size_t... C>
  VNDF_INLINE T load(std::size_t i, std::index_sequence<C...>) const {
    T value;
    ((reinterpret_cast<F*>(&value)[C] = vndf::lanes::op::load<F>(lanes_[C] + i)), ...);
    return value;
  }

  alignas(64) float lanes_[kMembers][kLanes];
};

}  // namespace
