// The functions of the shading step, for plain GGX and for shapes of every kind, columns in and columns out, so that a
// promise that all of them make is tested on all of them.
#pragma once

#include <functional>
#include <ostream>
#include <string>

#include "reference/random.h"
#include "support/bits.h"

namespace vndf::shading {

using testing::Table;

struct Operation {
  std::string name;
  std::string inputs;  // a letter each: w view, l light, m normal, a alpha, t theta, u, e eta
  std::size_t outputs;
  std::function<void(std::size_t, const std::vector<Column>&, const std::vector<float*>&)> run;
};
const std::vector<Operation>& operations();
void PrintTo(const Operation& operation, std::ostream* out);

/// Values that the library has to survive, mixed with good ones, for a column of this letter.
float bad_value(reference::Random& random, char kind);

/// Hard cases with what the operation asks for besides, bad values, any bits: dealt in turn. Directions of light are
/// sampled ones, or any.
Table inputs(const Operation& operation, std::size_t count, std::uint64_t seed, bool good_only = false);

/// On the set in use.
Table evaluate(const Operation& operation, const Table& in);

}  // namespace vndf::shading
