// What a caller must not do: debug builds say so. The dispatch is compiled here with its assertions.
#include <cstdint>

#include <gtest/gtest.h>

#include <vndf/ellipsoid.h>

namespace vndf {
namespace {

constexpr std::size_t kCount = 4;
// A count whose columns no address space holds, and one that wraps as bytes.
constexpr std::size_t kImpossible[] = {SIZE_MAX, SIZE_MAX / 4 + 2, std::size_t(PTRDIFF_MAX) / sizeof(float) + 1};

struct Preconditions : ::testing::Test {
  float columns[9][kCount] = {};
  const Columns3 wo{0.6f, 0.f, 0.8f};
  const Columns2 alpha{0.3f, 0.3f}, u{0.5f, 0.5f};
  const Ellipsoid ellipsoid{alpha, 0.1f, 0.2f, 0.3f};
  const Out3 out{columns[0], columns[1], columns[2]};
  const ReflectionSamples reflection{out, columns[3], columns[4]};
  const DielectricSamples dielectric{out, columns[3], columns[4], columns[5]};
  const Evaluations values{columns[0], columns[1]};

  template <class F>
  static void expect_assertion(F f) {
    EXPECT_DEATH(f(), "ssertion");
  }
};

TEST_F(Preconditions, Enumerators) {
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
}

TEST_F(Preconditions, Outputs) {
  float* const none = nullptr;
  expect_assertion([&] { sample_normals(Warp::polar, kCount, wo, alpha, u, {columns[0], none, columns[1]}); });
  expect_assertion([&] { sample_disk(DiskMap::polar, kCount, u, {none, columns[0]}); });
  expect_assertion([&] { sample_reflection(Warp::polar, kCount, wo, alpha, u, {out, none, columns[3]}); });
  expect_assertion([&] { sample_reflection(Warp::polar, kCount, wo, ellipsoid, u, {out, columns[3], none}); });
  expect_assertion([&] { evaluate_reflection(kCount, wo, wo, alpha, {columns[0], none}); });
  expect_assertion([&] { pdf_normals(kCount, wo, wo, alpha, none); });
  expect_assertion([&] {
    sample_dielectric(Warp::polar, kCount, wo, alpha, 1.5f, wo, {out, columns[3], columns[4], none});
  });
  expect_assertion([&] { evaluate_dielectric(kCount, wo, wo, Shape(), 1.5f, {none, columns[0]}); });
}

TEST_F(Preconditions, Counts) {
  for (std::size_t count : kImpossible) {
    expect_assertion([&] { sample_normals(Warp::polar, count, wo, alpha, u, out); });
    expect_assertion([&] { sample_disk(DiskMap::polar, count, u, {columns[0], columns[1]}); });
    expect_assertion([&] { sample_reflection(Warp::polar, count, wo, alpha, u, reflection); });
    expect_assertion([&] { evaluate_reflection(count, wo, wo, alpha, values); });
    expect_assertion([&] { pdf_normals(count, wo, wo, ellipsoid, columns[0]); });
    expect_assertion([&] { sample_dielectric(Warp::polar, count, wo, alpha, 1.5f, wo, dielectric); });
    expect_assertion([&] { evaluate_dielectric(count, wo, wo, alpha, 1.5f, values); });
  }
}

// Nothing is written for a count of 0, nor where an output that is not wanted would be.
TEST_F(Preconditions, AreNoMoreThanThose) {
  const Out3 nowhere{nullptr, nullptr, nullptr};
  sample_normals(Warp::polar, 0, wo, alpha, u, nowhere);
  evaluate_reflection(0, wo, wo, alpha, {nullptr, nullptr});
  sample_reflection(Warp::polar, kCount, wo, alpha, u, reflection);
  EXPECT_GT(columns[3][kCount - 1], 0);
}

}  // namespace
}  // namespace vndf
