// Tables of columns, evaluated and compared bit by bit, on every instruction set.
#pragma once

#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/operations.h"

namespace vndf::testing {

/// Columns of equal length.
using Table = std::vector<std::vector<float>>;

inline std::vector<Column> columns(const Table& table, std::size_t from = 0) {
  std::vector<Column> result;
  for (const auto& column : table) result.push_back(column.data() + from);
  return result;
}
inline std::vector<float*> results(Table& table, std::size_t from = 0) {
  std::vector<float*> result;
  for (auto& column : table) result.push_back(column.data() + from);
  return result;
}

/// A row on all of `in`, on the set in use.
inline Table evaluate(const Operation& operation, const Table& in, const std::vector<Column>& columns) {
  Table out(operation.outputs.size(), std::vector<float>(in[0].size()));
  operation.run(in[0].size(), columns.data(), results(out).data());
  return out;
}
inline Table evaluate(const Operation& operation, const Table& in) {
  return evaluate(operation, in, columns(in));
}

/// What a row gives, by the names of its columns.
class Results {
 public:
  Results(const Operation& row, const Table& in) : Results(row, evaluate(row, in)) {}
  Results(const std::string& row, const Table& in) : Results(operation(row), in) {}
  Results(const Operation& row, const Table& in, const std::vector<Column>& columns)
      : Results(row, evaluate(row, in, columns)) {}

  std::size_t size() const { return table_[0].size(); }
  const std::vector<float>& column(const std::string& name) const { return table_[row_->output(name)]; }
  float operator()(const std::string& name, std::size_t i) const { return column(name)[i]; }
  std::array<float, 3> vector(const std::string& name, std::size_t i) const {
    std::size_t c = row_->output(name + ".x");
    return {table_[c][i], table_[c + 1][i], table_[c + 2][i]};
  }

 private:
  explicit Results(const Operation& row, Table&& table) : row_(&row), table_(std::move(table)) {}
  const Operation* row_;
  Table table_;
};

/// Equal bits where not NaN, and NaN in the same places.
inline bool same_bits(float a, float b) {
  return std::memcmp(&a, &b, sizeof a) == 0 || (std::isnan(a) && std::isnan(b));
}
inline ::testing::AssertionResult same_bits(const Table& expected, const Table& actual) {
  for (std::size_t c = 0; c < expected.size(); ++c)
    for (std::size_t i = 0; i < expected[c].size(); ++i)
      if (!same_bits(expected[c][i], actual[c][i]))
        return ::testing::AssertionFailure()
               << "output " << c << " at " << i << ": " << actual[c][i] << " instead of " << expected[c][i];
  return ::testing::AssertionSuccess();
}

/// Puts the set in use back at the end of a test.
class KeepIsa {
 public:
  KeepIsa() : name_(active_isa()) {}
  ~KeepIsa() { (void)set_isa(name_.c_str()); }
  KeepIsa(const KeepIsa&) = delete;
  KeepIsa& operator=(const KeepIsa&) = delete;

 private:
  std::string name_;
};

inline std::vector<std::string> isa_names() {
  std::vector<std::string> names;
  for (const Isa& isa : isas()) names.push_back(isa.name);
  return names;
}

/// Calls f with each set in use that is supported here.
template <class F>
void on_every_isa(F f) {
  KeepIsa keep;
  for (const Isa& isa : isas())
    if (isa.supported) {
      ASSERT_EQ(set_isa(isa.name), IsaError::none);
      SCOPED_TRACE(isa.name);
      f();
    }
}

/// Calls f on the scalar set.
template <class F>
auto on_scalar(F f) {
  KeepIsa keep;
  EXPECT_EQ(set_isa("scalar"), IsaError::none);
  return f();
}

}  // namespace vndf::testing
