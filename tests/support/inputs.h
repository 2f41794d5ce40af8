// Inputs for any row of the table. All are the same for the same arguments, and a prefix for a smaller count.
#pragma once

#include "reference/hard_cases.h"
#include "support/bits.h"

namespace vndf::testing {

/// 2^exponent samples, or 2^VNDF_TEST_SAMPLES where that is less: for builds with sanitizers, which are slow.
std::size_t samples(int exponent);

/// A hard case, with what the row asks for besides. Light and normals are sampled ones; one light in four is any.
Table hard_inputs(const Operation& operation, const reference::HardCase& hard_case, std::size_t count,
                  std::uint64_t seed);
/// All hard cases, dealt in turn.
Table good_inputs(const Operation& operation, std::size_t count, std::uint64_t seed);

/// Values that the library has to survive, mixed with good ones: zeros, infinities, NaN, subnormals, any 32 bits.
float bad_value(reference::Random& random, Kind kind);
Table bad_inputs(const Operation& operation, std::size_t count, std::uint64_t seed);
Table random_bits(const Operation& operation, std::size_t count, std::uint64_t seed);

/// Hard cases, bad values, and any bits, dealt in turn.
Table mixed_inputs(const Operation& operation, std::size_t count, std::uint64_t seed);

/// Compares bit by bit, and says for which inputs the first difference is.
::testing::AssertionResult same_bits(const Operation& operation, const Table& expected, const Table& actual,
                                     const Table& in);
/// The inputs of an index, for people.
std::string describe(const Operation& operation, const Table& in, std::size_t index);

}  // namespace vndf::testing
