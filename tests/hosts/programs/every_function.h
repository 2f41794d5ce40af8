// A call of every row of the table of public functions, for hosts that need all of them. The inputs are made with
// integers and powers of two, so that a host's own flags cannot change them.
#pragma once

#include <cstdint>

// The source itself, so that a host compiles one file and knows no folder of ours.
#include "../../support/operations.cpp"

struct EveryFunction {
  struct Call {
    std::string name;
    std::function<void()> run;  ///< writes the columns of output()
  };
  std::size_t count;
  std::vector<std::vector<float>> in, out;
  std::vector<Call> calls;

  /// On a line of the cache, where large batches are written past it.
  float* output(std::size_t c) {
    return out[c].data() + (64 - reinterpret_cast<std::uintptr_t>(out[c].data()) % 64) % 64 / sizeof(float);
  }

  explicit EveryFunction(std::size_t count_) : count(count_), in(15), out(12, std::vector<float>(count + 16)) {
    std::uint32_t state = 1;
    auto unit = [&] {  // in [0, 1), 24 bits
      state = state * 1664525u + 1013904223u;
      return static_cast<float>(state >> 8) * 0x1p-24f;
    };
    for (std::size_t i = 0; i < count; ++i) {
      const float scale = i % 2 ? 1.f : 0x1p-6f;
      for (std::size_t c = 0; c < 6; ++c) in[c].push_back(2 * unit() - 1);               // two directions
      for (std::size_t c = 6; c < 8; ++c) in[c].push_back((unit() + 0x1p-24f) * scale);  // alpha
      for (std::size_t c = 8; c < 14; ++c) in[c].push_back(unit());                      // u, angles
      in[14].push_back(1.5f);                                                            // eta
    }
    for (const auto& row : vndf::testing::operations()) {
      vndf::testing::In from;
      vndf::testing::Out to;
      for (const auto& input : row.inputs) input.in(from) = in[first(input.kind) + input.index].data();
      for (std::size_t c = 0; c < row.outputs.size(); ++c) row.outputs[c].out(to) = output(c);
      calls.push_back({row.name, [this, &row, from, to] { row.call(count, from, to); }});
    }
  }

 private:
  static std::size_t first(vndf::testing::Kind kind) {
    using vndf::testing::Kind;
    switch (kind) {
      case Kind::view:
        return 0;
      case Kind::light:
      case Kind::normal:
        return 3;
      case Kind::alpha:
        return 6;
      case Kind::u:
        return 8;
      case Kind::theta:
        return 11;
      default:
        return 14;
    }
  }
};
