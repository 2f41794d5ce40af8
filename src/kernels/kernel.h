// How a kernel walks its columns.
//
// A kernel is a struct of named columns, with
//   inputs(f), outputs(f)   f of each column
//   prepare(n)              what a surface works out before a block of n lanes
//   at<F>(i)                loads F from the inputs at lane i, computes, and stores. All loads come before the first
//                           store, since an output may be the same column as an input
#pragma once

#include "columns.h"

namespace {

/// Batches of at least this many lanes are written past the caches, where their columns are aligned for it. Such
/// columns are larger than a core's share of any last-level cache, and a line written whole need not be read first.
constexpr std::size_t kStreaming = std::size_t(1) << 20;

/// The columns of a kernel, and the function that runs it over n lanes, whole vectors.
struct Walk {
  InColumn* in[16];
  OutColumn* out[16];
  std::size_t ins = 0, outs = 0;
  void (*block)(const void* kernel, std::size_t n);
  const void* kernel;
};

/// A block for each column, where the column of the call will not do: for constants, tails and streaming.
using Buffers = float[16][kBlock];

/// A constant becomes a column of one block, which stays where it is.
VNDF_NOINLINE const float* fill(float* buffer, float value, std::size_t n) {
  for (std::size_t i = 0; i < n; i += kWidth) op::store(Vector(value), buffer + i);
  return buffer;
}

/// Walks a batch that is written past the caches. The kernel writes a block to buffers; from there each column goes out
/// line after line.
VNDF_NOINLINE void walk_streaming(std::size_t count, const Walk& w, Buffers& buffers) {
  for (std::size_t begin = 0, n; begin < count; begin += n) {
    n = count - begin < kBlock ? count - begin : kBlock;
    for (std::size_t c = 0; c < w.ins; ++c) w.in[c]->move_to(begin);
    for (std::size_t c = 0; c < w.outs; ++c) w.out[c]->stand_at(buffers[c]);
    w.block(w.kernel, n);
    for (std::size_t c = 0; c < w.outs; ++c)
      for (std::size_t i = 0; i < n && w.out[c]->wanted(); i += kWidth)
        op::stream(op::load<Vector>(buffers[c] + i), w.out[c]->given() + begin + i);
  }
  op::finish_streaming();
}

/// Walks block after block. The last lanes, fewer than a vector, are a block of copies. Not inlined: one function for
/// all kernels of an object.
VNDF_NOINLINE void walk(std::size_t count, const Walk& w) {
  alignas(64) float in[16][kWidth];
  alignas(64) Buffers out;
  const std::size_t rest = count % kWidth, whole = count - rest;
  std::size_t begin = 0;
  if (count >= kStreaming) {
    bool aligned = true;
    for (std::size_t c = 0; c < w.outs; ++c)
      aligned &= reinterpret_cast<std::uintptr_t>(w.out[c]->given()) % sizeof(Vector) == 0;
    if (aligned) {
      walk_streaming(whole, w, out);
      begin = whole;
    }
  }
  for (std::size_t n; begin < whole; begin += n) {
    n = whole - begin < kBlock ? whole - begin : kBlock;
    for (std::size_t c = 0; c < w.ins; ++c) w.in[c]->move_to(begin);
    for (std::size_t c = 0; c < w.outs; ++c) w.out[c]->stand_at(w.out[c]->given() + begin);
    w.block(w.kernel, n);
  }
  if (rest) {
    for (std::size_t c = 0; c < w.ins; ++c)
      if (const float* data = w.in[c]->given().data) {
        op::store(op::load_first<Vector>(data + whole, rest), in[c]);
        w.in[c]->stand_at(in[c]);
      }
    for (std::size_t c = 0; c < w.outs; ++c) w.out[c]->stand_at(out[c]);
    w.block(w.kernel, kWidth);
    for (std::size_t c = 0; c < w.outs; ++c)
      if (w.out[c]->wanted()) op::store_first(op::load<Vector>(out[c]), w.out[c]->given() + whole, rest);
  }
}

/// A kernel over a block: several vectors at once, so that as many chains of dependent operations overlap, then one at
/// a time.
template <class Kernel>
void run_block(const void* pointer, std::size_t n) {
  const Kernel kernel = *static_cast<const Kernel*>(pointer);  // so that no store can be one to its columns
  kernel.prepare(n);
  std::size_t i = 0;
  if constexpr (kVectors > 1)
    for (; i + kAtOnce <= n; i += kAtOnce) kernel.template at<lanes::Many<Vector, kVectors>>(i);
  for (; i < n; i += kWidth) kernel.template at<Vector>(i);
}

template <class Kernel>
VNDF_INLINE void run(std::size_t count, Kernel& kernel) {
  alignas(64) Buffers constants;
  std::size_t c = 0;
  kernel.inputs([&](InColumn& in) {
    if (!in.given().data) in.stand_at(fill(constants[c++], in.given().value, count < kBlock ? count : kBlock));
  });
  if (count <= kBlock && count % kWidth == 0) return run_block<Kernel>(&kernel, count);

  Walk w;
  kernel.inputs([&](InColumn& in) { w.in[w.ins++] = &in; });
  kernel.outputs([&](OutColumn& out) { w.out[w.outs++] = &out; });
  w.block = run_block<Kernel>;
  w.kernel = &kernel;
  walk(count, w);
}

}  // namespace
