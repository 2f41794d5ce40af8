// The public batch functions in one shape, columns in and columns out, so that a promise that all of them make is
// tested on all of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "reference/hard_cases.h"
#include "support/bits.h"

namespace vndf::testing {

/// The inputs of sample_normals are wo x, y, z, alpha x, y, u x, y; those of sample_disk u x, y.
struct Operation {
  const char* name;
  std::size_t inputs, outputs;
  Warp warp;  ///< for a disk, the warp that uses it
  void (*run)(std::size_t count, const Column* in, float* const* out);
};
const std::vector<Operation>& operations();
void PrintTo(const Operation& operation, std::ostream* out);

// Inputs of an operation. A smaller count gives a prefix.
Table hard_inputs(const Operation& operation, const reference::HardCase& hard_case, std::size_t count,
                  std::uint64_t seed);
/// Values that the library has to survive, mixed with good ones.
Table bad_inputs(const Operation& operation, std::size_t count, std::uint64_t seed);
/// Any 32 bits.
Table random_bits(const Operation& operation, std::size_t count, std::uint64_t seed);
/// All of the above, dealt in turn.
Table mixed_inputs(const Operation& operation, std::size_t count, std::uint64_t seed);

/// On the set in use.
Table evaluate(const Operation& operation, const Table& in);
Table evaluate_on(const char* isa, const Operation& operation, const Table& in);

/// With the inputs of what differs.
::testing::AssertionResult same_bits(const Table& expected, const Table& actual, const Table& in);
/// One row of the inputs, for people.
std::string describe(const Table& in, std::size_t index);

std::vector<std::string> isa_names();
std::vector<std::string> supported_isa_names();

/// Tests that run for every operation on every set.
class EveryOperation : public ::testing::TestWithParam<std::tuple<Operation, std::string>> {
 protected:
  void SetUp() override {
    if (set_isa(isa().c_str()) == IsaError::unsupported) GTEST_SKIP() << isa() << " is not supported here";
  }
  static const Operation& operation() { return std::get<0>(GetParam()); }
  static const std::string& isa() { return std::get<1>(GetParam()); }

 private:
  KeepIsa keep_;
};
std::string operation_and_isa(const ::testing::TestParamInfo<EveryOperation::ParamType>& info);

}  // namespace vndf::testing

#define VNDF_FOR_EVERY_OPERATION(suite)                                                         \
  INSTANTIATE_TEST_SUITE_P(, suite,                                                             \
                           ::testing::Combine(::testing::ValuesIn(vndf::testing::operations()), \
                                              ::testing::ValuesIn(vndf::testing::isa_names())), \
                           vndf::testing::operation_and_isa)
