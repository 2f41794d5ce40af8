// What a caller must not do: debug builds say so. The dispatch is compiled here with its assertions.
#include <cstdint>

#include <gtest/gtest.h>

#include "support/operations.h"

namespace vndf::testing {
namespace {

constexpr std::size_t kCount = 4;
// A count whose columns no address space holds, and one that wraps as bytes.
constexpr std::size_t kImpossible[] = {SIZE_MAX, SIZE_MAX / 4 + 2, std::size_t(PTRDIFF_MAX) / sizeof(float) + 1};

template <class F>
void expect_assertion(F f) {
  EXPECT_DEATH(f(), "ssertion");
}

/// A row with constants for its inputs, and all of its outputs.
struct Call {
  const Operation& row;
  std::vector<Column> in;
  std::vector<std::vector<float>> columns;
  std::vector<float*> out;

  explicit Call(const Operation& row_)
      : row(row_), in(row.inputs.size(), 0.5f), columns(row.outputs.size(), std::vector<float>(kCount, -7.f)) {
    for (auto& column : columns) out.push_back(column.data());
  }
  void operator()(std::size_t count = kCount) const { row.run(count, in.data(), out.data()); }
};

TEST(Preconditions, Outputs) {
  for (const Operation& row : operations()) {
    SCOPED_TRACE(row.name);
    for (std::size_t c = 0; c < row.outputs.size(); ++c) {
      Call call(row);
      call.out[c] = nullptr;
      if (row.outputs[c].optional)
        call();
      else
        expect_assertion(call);
    }
  }
}

// A pointer that was forgotten is not a constant.
TEST(Preconditions, Inputs) {
  for (const Operation& row : operations()) {
    SCOPED_TRACE(row.name);
    for (std::size_t c = 0; c < row.inputs.size(); ++c) {
      Call call(row);
      call.in[c] = Column(nullptr);
      expect_assertion(call);
    }
  }
}

TEST(Preconditions, Counts) {
  for (const Operation& row : operations()) {
    SCOPED_TRACE(row.name);
    Call call(row);
    for (std::size_t count : kImpossible) expect_assertion([&] { call(count); });
    // Nothing is written, nor needed, for a count of 0.
    call(0);
    for (const auto& column : call.columns) EXPECT_EQ(column[0], -7);
    call.out.assign(call.out.size(), nullptr);
    call(0);
  }
}

TEST(Preconditions, Enumerators) {
  float columns[6][kCount];
  const Columns3 wo{0.6f, 0.f, 0.8f};
  const Columns2 alpha{0.3f, 0.3f}, u{0.5f, 0.5f};
  const Ellipsoid ellipsoid{alpha, 0.1f, 0.2f, 0.3f};
  const Out3 out{columns[0], columns[1], columns[2]};
  const ReflectionSamples reflection{out, columns[3], columns[4]};
  const DielectricSamples dielectric{out, columns[3], columns[4], columns[5]};
  const Evaluations values{columns[0], columns[1]};
  auto warp = static_cast<Warp>(7);
  auto masking = static_cast<Masking>(2);
  expect_assertion([&] { sample_normals(warp, kCount, wo, alpha, u, out); });
  expect_assertion([&] { sample_normals(warp, kCount, wo, ellipsoid, u, out); });
  expect_assertion([&] { sample_normals(static_cast<Warp>(-1), kCount, wo, Shape(), u, out); });
  expect_assertion([&] { sample_disk(static_cast<DiskMap>(2), kCount, u, {columns[0], columns[1]}); });
  expect_assertion([&] { sample_reflection(warp, kCount, wo, alpha, u, reflection); });
  for (bool bounded : {false, true}) {
    ReflectionOptions options{masking, bounded};
    expect_assertion([&] { sample_reflection(Warp::polar, kCount, wo, alpha, u, reflection, options); });
    expect_assertion([&] { evaluate_reflection(kCount, wo, wo, alpha, values, options); });
  }
  expect_assertion([&] { sample_dielectric(warp, kCount, wo, alpha, 1.5f, wo, dielectric); });
  expect_assertion([&] { sample_dielectric(Warp::polar, kCount, wo, alpha, 1.5f, wo, dielectric, masking); });
  expect_assertion([&] { evaluate_dielectric(kCount, wo, wo, alpha, 1.5f, values, masking); });
  DielectricOptions options;
  options.across = static_cast<AcrossMasking>(3);
  expect_assertion([&] { sample_dielectric(Warp::polar, kCount, wo, alpha, 1.5f, wo, dielectric, options); });
  expect_assertion([&] { evaluate_dielectric(kCount, wo, wo, alpha, 1.5f, values, options); });
  // What there is not: bounded ellipsoids, and a cosine of the dielectric's pairs.
  const ReflectionOptions bounded{Masking::separable, true};
  expect_assertion([&] { sample_reflection(Warp::polar, kCount, wo, ellipsoid, u, reflection, bounded); });
  expect_assertion([&] { evaluate_reflection(kCount, wo, wo, Shape(), values, bounded); });
  expect_assertion([&] { evaluate_dielectric(kCount, wo, wo, alpha, 1.5f, {columns[0], columns[1], columns[2]}); });
}

}  // namespace
}  // namespace vndf::testing
