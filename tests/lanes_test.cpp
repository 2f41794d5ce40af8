// The lane API gives the bits of the batch API, for float and for a vector of the set that the test is compiled for.
#include <vndf/ellipsoid.h>
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

// And for ellipsoids: a shape for what leans, and a turned frame where only theta_z is there.
template <class F>
void expect_bits_of_ellipsoids() {
  constexpr std::size_t kCount = 1 << 12;
  reference::Random random(3);
  Table in(10, std::vector<float>(kCount));  // wo, alpha, theta, u
  for (std::size_t i = 0; i < kCount; ++i) {
    for (std::size_t c : {0, 1, 2}) in[c][i] = float(random.uniform(-1, 1));
    for (std::size_t c : {3, 4}) in[c][i] = float(random.log_uniform(1e-3, 1));
    for (std::size_t c : {5, 6, 7}) in[c][i] = float(random.uniform(-3, 3));
    for (std::size_t c : {8, 9}) in[c][i] = random.unit();
  }
  Columns3 wo{in[0].data(), in[1].data(), in[2].data()};
  Columns2 alpha{in[3].data(), in[4].data()}, u{in[8].data(), in[9].data()};
  Table batch(3, std::vector<float>(kCount)), lane = batch;
  auto compare = [&](Warp warp, bool turned, auto sample) {
    sample_normals(
        warp, kCount, wo,
        turned ? Ellipsoid(alpha, 0.f, 0.f, in[7].data()) : Ellipsoid(alpha, in[5].data(), in[6].data(), in[7].data()),
        u, {batch[0].data(), batch[1].data(), batch[2].data()});
    for (std::size_t i = 0; i < kCount; i += lanes::kWidth<F>) {
      auto load = [&](std::size_t c) { return lanes::op::load<F>(in[c].data() + i); };
      lanes::Vec3<F> v{load(0), load(1), load(2)};
      lanes::Vec2<F> a{load(3), load(4)}, uv{load(8), load(9)};
      lanes::Vec3<F> wm;
      if (turned) {
        auto theta_z = lanes::rotation_of(load(7));
        wm = turn_back(sample(turn(v, theta_z), a, uv), lanes::angle_of<F>(theta_z));
      } else {
        wm = sample(v, lanes::tilted_shape(a, load(5), load(6), load(7)), uv);
      }
      lanes::op::store(wm.x, lane[0].data() + i);
      lanes::op::store(wm.y, lane[1].data() + i);
      lanes::op::store(wm.z, lane[2].data() + i);
    }
    EXPECT_TRUE(same_bits(batch, lane)) << int(warp) << " " << turned;
  };
  for (bool turned : {false, true}) {
    compare(Warp::polar, turned, [](auto v, auto s, auto uv) { return lanes::sample_normal_polar(v, s, uv); });
    compare(Warp::concentric, turned,
            [](auto v, auto s, auto uv) { return lanes::sample_normal_concentric(v, s, uv); });
  }
  compare(Warp::spherical_cap, false, [](auto v, auto s, auto uv) { return lanes::sample_normal_cap(v, s, uv); });
}
TEST(Ellipsoids, Float) {
  expect_bits_of_ellipsoids<float>();
}
TEST(Ellipsoids, Batch) {
  expect_bits_of_ellipsoids<xsimd::batch<float>>();
}

}  // namespace
}  // namespace vndf::testing
