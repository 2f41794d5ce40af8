// Suites of tests that run for every row of the table.
#pragma once

#include "support/inputs.h"

namespace vndf::testing {

class EveryOperation : public ::testing::TestWithParam<std::string> {
 protected:
  const Operation& operation() const { return operation_; }

 private:
  const Operation& operation_ = testing::operation(GetParam());
  KeepIsa keep_;
};

inline std::vector<std::string> operation_names() {
  std::vector<std::string> names;
  for (const Operation& row : operations()) names.push_back(row.name);
  return names;
}

}  // namespace vndf::testing

#define VNDF_FOR_EVERY_OPERATION(suite)                                                    \
  INSTANTIATE_TEST_SUITE_P(, suite, ::testing::ValuesIn(vndf::testing::operation_names()), \
                           [](const auto& info) { return info.param; })
