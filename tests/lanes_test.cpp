// The lane API gives the bits of the batch API, for float and for a vector of the set that the test is compiled for.
#include <vndf/lanes.h>

#include "support/operations.h"

namespace vndf::testing {
namespace {

template <class F>
void run_lanes(const Operation& operation, const Table& in, Table& out, std::size_t i) {
  auto load = [&](std::size_t c) { return lanes::op::load<F>(in[c].data() + i); };
  auto store = [&](F value, std::size_t c) { lanes::op::store(value, out[c].data() + i); };
  if (operation.inputs == 2) {
    lanes::Vec2<F> u{load(0), load(1)};
    auto t = lanes::cartesian(operation.warp == Warp::polar ? lanes::polar_map(u) : lanes::concentric_map(u));
    store(t.x, 0);
    store(t.y, 1);
    return;
  }
  lanes::Vec3<F> wo{load(0), load(1), load(2)};
  lanes::Vec2<F> alpha{load(3), load(4)}, u{load(5), load(6)};
  auto wm = operation.warp == Warp::polar        ? lanes::sample_normal_polar(wo, alpha, u)
            : operation.warp == Warp::concentric ? lanes::sample_normal_concentric(wo, alpha, u)
                                                 : lanes::sample_normal_cap(wo, alpha, u);
  store(wm.x, 0);
  store(wm.y, 1);
  store(wm.z, 2);
}

class Lanes : public ::testing::TestWithParam<Operation> {
 protected:
  template <class F>
  static void expect_bits_of_the_batch_api() {
    constexpr std::size_t kCount = 1 << 16;
    Table in = mixed_inputs(GetParam(), kCount, 1);
    Table out(GetParam().outputs, std::vector<float>(kCount));
    for (std::size_t i = 0; i < kCount; i += lanes::kWidth<F>) run_lanes<F>(GetParam(), in, out, i);
    EXPECT_TRUE(same_bits(evaluate(GetParam(), in), out, in));
  }
};
INSTANTIATE_TEST_SUITE_P(, Lanes, ::testing::ValuesIn(operations()),
                         [](const auto& info) { return std::string(info.param.name); });

TEST_P(Lanes, Float) {
  expect_bits_of_the_batch_api<float>();
}
TEST_P(Lanes, Batch) {
  expect_bits_of_the_batch_api<xsimd::batch<float>>();
}

}  // namespace
}  // namespace vndf::testing
