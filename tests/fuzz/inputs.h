// What the columns of a call hold, and which lanes the documentation promises something for.
#pragma once

#include "fuzz/source.h"
#include "support/operations.h"

namespace vndf::fuzz {

/// What a column holds.
struct Values {
  bool constant;           ///< one value for the batch
  std::vector<float> all;  ///< count of them in any case
};

/// For a row of the table of functions.
std::vector<Values> make_inputs(Source& source, const testing::Operation& row, std::size_t count);

/// Of any matrix that make_shape takes.
Shape make_shape(Source& source);

/// Whether all inputs of a lane lie in the documented domain.
bool in_domain(const testing::Operation& row, const std::vector<Values>& in, std::size_t lane);

/// |v| of the direction that begins at a column.
double length(const std::vector<Values>& in, std::size_t column, std::size_t lane);

}  // namespace vndf::fuzz
