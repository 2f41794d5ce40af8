// Every instruction set gives the bits of the scalar one, on at least 2^24 samples per operation.
#include <cstdint>

#include "support/operations.h"

namespace vndf::testing {
namespace {

constexpr std::size_t kChunk = std::size_t(1) << 16;
constexpr std::size_t kTotal = std::size_t(1) << 24;

class IdenticalBits : public ::testing::TestWithParam<Operation> {
 protected:
  static void expect_same_bits_on_every_isa(const Table& in) {
    Table expected = evaluate_on("scalar", GetParam(), in);
    for (const std::string& isa : supported_isa_names()) {
      ASSERT_TRUE(same_bits(expected, evaluate_on(isa.c_str(), GetParam(), in), in)) << isa;
    }
  }
};

TEST_P(IdenticalBits, HardCases) {
  const auto& rows = reference::hard_cases();
  std::size_t chunks = kTotal / kChunk / rows.size() + 1;
  for (const auto& row : rows)
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
      ASSERT_NO_FATAL_FAILURE(expect_same_bits_on_every_isa(hard_inputs(GetParam(), row, kChunk, chunk))) << row.name;
    }
}

TEST_P(IdenticalBits, BadInputs) {
  for (std::uint64_t seed = 0; seed < 32; ++seed) {
    ASSERT_NO_FATAL_FAILURE(expect_same_bits_on_every_isa(bad_inputs(GetParam(), kChunk, seed)));
    ASSERT_NO_FATAL_FAILURE(expect_same_bits_on_every_isa(random_bits(GetParam(), kChunk, seed)));
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

// Ray tracers ask renderers to set both.
TEST_P(IdenticalBits, FlushToZeroAndDenormalsAreZero) {
  constexpr unsigned kFlushToZero = 0x8000, kDenormalsAreZero = 0x0040;
  for (unsigned bits : {kFlushToZero, kDenormalsAreZero, kFlushToZero | kDenormalsAreZero})
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
      Table mixed = mixed_inputs(GetParam(), kChunk, seed);
      Table bad = bad_inputs(GetParam(), kChunk, seed);
      ControlBits control(bits);
      ASSERT_NO_FATAL_FAILURE(expect_same_bits_on_every_isa(mixed)) << std::hex << bits;
      ASSERT_NO_FATAL_FAILURE(expect_same_bits_on_every_isa(bad)) << std::hex << bits;
    }
}
#endif

INSTANTIATE_TEST_SUITE_P(, IdenticalBits, ::testing::ValuesIn(operations()),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace vndf::testing
