// Every instruction set gives the bits of the scalar one, whatever the inputs and the mode of the thread are.
#include <algorithm>

#include "support/every_operation.h"

namespace vndf::testing {
namespace {

constexpr std::size_t kChunk = std::size_t(1) << 16;

class Bits : public EveryOperation {
 protected:
  void expect_same_bits(const Table& in) const {
    Table expected = on_scalar([&] { return evaluate(operation(), in); });
    on_every_isa([&] { ASSERT_TRUE(same_bits(operation(), expected, evaluate(operation(), in), in)); });
  }
  /// As powers of two. The normals and the disks of plain GGX are what all other functions begin with.
  int samples() const {
    Result first = operation().outputs[0].result;
    bool plain = operation().takes(Kind::alpha) && !operation().takes(Kind::theta);
    return first == Result::point || (first == Result::normal && plain) ? 24 : 19;
  }
};
VNDF_FOR_EVERY_OPERATION(Bits);

TEST_P(Bits, HardCases) {
  const auto& rows = reference::hard_cases();
  const std::size_t chunk = std::min(kChunk, (std::size_t(1) << samples()) / rows.size() + 1);
  const std::size_t chunks = (std::size_t(1) << samples()) / chunk / rows.size() + 1;
  for (const auto& row : rows)
    for (std::size_t k = 0; k < chunks && !HasFailure(); ++k) {
      SCOPED_TRACE(row.name);
      expect_same_bits(hard_inputs(operation(), row, chunk, k));
    }
}

TEST_P(Bits, BadInputs) {
  for (std::uint64_t seed = 0; seed < 8 && !HasFailure(); ++seed) {
    expect_same_bits(bad_inputs(operation(), kChunk, seed));
    expect_same_bits(mixed_inputs(operation(), kChunk, seed));
  }
}

#if defined(__x86_64__)
/// Sets bits of the SSE control register for a while.
class ControlBits {
 public:
  explicit ControlBits(unsigned bits) : before_(__builtin_ia32_stmxcsr()) { __builtin_ia32_ldmxcsr(before_ | bits); }
  ~ControlBits() { __builtin_ia32_ldmxcsr(before_); }
  ControlBits(const ControlBits&) = delete;
  ControlBits& operator=(const ControlBits&) = delete;

 private:
  unsigned before_;
};

// Ray tracers ask renderers to flush denormals and to take them as zeros.
TEST_P(Bits, FlushToZeroAndDenormalsAreZero) {
  const Table in = mixed_inputs(operation(), kChunk, 20), bad = bad_inputs(operation(), kChunk, 21);
  for (const Table* table : {&in, &bad}) {
    Table expected = on_scalar([&] { return evaluate(operation(), *table); });
    for (unsigned bits : {0x8000u, 0x0040u, 0x8040u})
      on_every_isa([&] {
        Table out;
        {
          ControlBits control(bits);
          out = evaluate(operation(), *table);
        }
        ASSERT_TRUE(same_bits(operation(), expected, out, *table)) << std::hex << bits;
      });
  }
}
#endif

}  // namespace
}  // namespace vndf::testing
