// One call of one function, on every set: what it may not do, and what its results must be.
#pragma once

#include <string>

#include "fuzz/source.h"

namespace vndf::fuzz {

struct Outcome {
  std::size_t lanes;  ///< on all sets
  std::string fault;  ///< what went wrong; empty where nothing did
};

/// Any function, count, inputs, alignment, mode of the thread.
Outcome make_call(Source& source);

}  // namespace vndf::fuzz
