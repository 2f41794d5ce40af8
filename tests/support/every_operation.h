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

inline std::vector<std::string> operation_names(bool beyond_the_domain) {
  std::vector<std::string> names;
  for (const Operation& row : operations())
    if (row.in_domain || beyond_the_domain) names.push_back(row.name);
  return names;
}

}  // namespace vndf::testing

// With surfaces beyond what is promised, which have bits all the same, or without.
#define VNDF_FOR_EVERY_OPERATION(suite, beyond_the_domain)                                                  \
  INSTANTIATE_TEST_SUITE_P(, suite, ::testing::ValuesIn(vndf::testing::operation_names(beyond_the_domain)), \
                           [](const auto& info) { return info.param; })
