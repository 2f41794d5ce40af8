// How a kernel walks its columns.
//
// A kernel is a struct of named columns, with
//   kVectors                how many vectors it takes at once
//   inputs(f), outputs(f)   f of each column
//   prepare(n)              what a surface works out before a block of n lanes
//   at<F>(i)                loads F from the inputs at lane i, computes, and stores. i is a Part for the last vectors.
//   All
//                           loads come before the first store, since an output may be the same column as an input
#pragma once

#include "columns.h"

namespace {

/// Batches of at least this many lanes are written past the caches, where their columns are aligned for it. Such
/// columns are larger than a core's share of any last-level cache, and a line written whole need not be read first.
constexpr std::size_t kStreaming = std::size_t(1) << 20;

/// A block for each column, where the column of the call will not do: for constants and for streaming. No function has
/// more than sample_dielectric of an ellipsoid, 13 inputs and 12 outputs.
using Buffers = float[25][kBlock];

/// A constant becomes a column of one block, which stays where it is.
VNDF_NOINLINE const float* fill(float* buffer, float value, std::size_t n) {
  for (std::size_t i = 0; i < n && i < kBlock; i += kWidth) op::store(Vector(value), buffer + i);
  return buffer;
}

/// Sends a block of an output on its way, line after line.
VNDF_NOINLINE void stream(const float* buffer, float* to, std::size_t n) {
  std::size_t i = 0;
  for (; i + kWidth <= n; i += kWidth) op::stream(op::load<Vector>(buffer + i), to + i);
  if (i < n) op::store_first(op::load<Vector>(buffer + i), to + i, n - i);
}

/// A block: several vectors at once, so that as many chains of dependent operations overlap, then one at a time.
template <class Kernel>
VNDF_INLINE void run_block(const Kernel& kernel, std::size_t n) {
  constexpr std::size_t kAtOnce = Kernel::kVectors * kWidth;
  static_assert(kBlock % kAtOnce == 0);
  kernel.prepare(n);
  std::size_t i = 0;
  if constexpr (Kernel::kVectors > 1)
    for (; i + kAtOnce <= n; i += kAtOnce) kernel.template at<lanes::Many<Vector, Kernel::kVectors>>(i);
  for (; i < n; i += kWidth) kernel.template at<Vector>(Part::at(i, n));
}

/// Block after block. The kernel is a copy whose address nobody has: so compilers keep its columns in registers, know
/// that no store to an output changes them, and a small call stores little but its results. A core holds some sixty
/// stores back until they are final; calls overlap as far as theirs fit.
template <class Kernel>
VNDF_INLINE void run(std::size_t count, Kernel kernel) {
  alignas(64) Buffers buffers;
  std::size_t constants = 0;
  kernel.inputs([&](InColumn& in) {
    if (in.constant()) in.stand_at(fill(buffers[constants++], in.value(), count));
  });
  bool streaming = count >= kStreaming;
  if (streaming) kernel.outputs([&](OutColumn& out) { streaming &= out.aligned(); });

  for (std::size_t begin = 0; begin < count; begin += kBlock) {
    const std::size_t n = count - begin < kBlock ? count - begin : kBlock;
    if (begin > 0) {
      kernel.inputs([&](InColumn& in) { in.move_to(begin); });
      kernel.outputs([&](OutColumn& out) { out.move_to(begin); });
    }
    if (streaming) {
      std::size_t buffer = constants;
      kernel.outputs([&](OutColumn& out) { out.stand_at(buffers[buffer++]); });
    }
    run_block(kernel, n);
    if (streaming) {
      std::size_t buffer = constants;
      kernel.outputs([&](OutColumn& out) {
        if (out.wanted()) stream(buffers[buffer], out.given() + begin, n);
        ++buffer;
      });
    }
  }
  if (streaming) op::finish_streaming();
}

}  // namespace
