// The lane API gives the bits of the batch API, for float and for a vector of the set that the test is compiled for.
#include <vndf/ellipsoid.h>
#include <vndf/lanes.h>

#include "support/inputs.h"

namespace vndf::testing {
namespace {

/// f(the lanes' warp).
template <class Function>
auto with_warp(Warp warp, Function f) {
  return warp == Warp::polar        ? f(lanes::Polar())
         : warp == Warp::concentric ? f(lanes::Concentric())
                                    : f(lanes::SphericalCap());
}

template <class F>
void run_lanes(const Operation& operation, const Table& in, Table& out, std::size_t i) {
  auto load = [&](std::size_t c) { return lanes::op::load<F>(in[c].data() + i); };
  auto store = [&](F value, std::size_t c) { lanes::op::store(value, out[c].data() + i); };
  if (operation.inputs.size() == 2) {
    lanes::Vec2<F> u{load(0), load(1)};
    auto t = lanes::cartesian(operation.warp == Warp::polar ? lanes::polar_map(u) : lanes::concentric_map(u));
    store(t.x, 0);
    store(t.y, 1);
    return;
  }
  lanes::Vec3<F> wo{load(0), load(1), load(2)};
  lanes::Vec2<F> alpha{load(3), load(4)}, u{load(5), load(6)};
  auto wm = with_warp(operation.warp, [&](auto warp) { return lanes::sample_normal<decltype(warp)>(wo, alpha, u); });
  store(wm.x, 0);
  store(wm.y, 1);
  store(wm.z, 2);
}

std::vector<Operation> plain_normals() {
  std::vector<Operation> rows;
  for (const char* name :
       {"normals_polar", "normals_concentric", "normals_spherical_cap", "disk_polar", "disk_concentric"})
    rows.push_back(operation(name));
  return rows;
}

class Lanes : public ::testing::TestWithParam<Operation> {
 protected:
  template <class F>
  static void expect_bits_of_the_batch_api() {
    constexpr std::size_t kCount = 1 << 16;
    Table in = mixed_inputs(GetParam(), kCount, 1);
    Table out(GetParam().outputs.size(), std::vector<float>(kCount));
    for (std::size_t i = 0; i < kCount; i += lanes::kWidth<F>) run_lanes<F>(GetParam(), in, out, i);
    EXPECT_TRUE(same_bits(GetParam(), evaluate(GetParam(), in), out, in));
  }
};
INSTANTIATE_TEST_SUITE_P(, Lanes, ::testing::ValuesIn(plain_normals()),
                         [](const auto& info) { return info.param.name; });

TEST_P(Lanes, Float) {
  expect_bits_of_the_batch_api<float>();
}
TEST_P(Lanes, Batch) {
  expect_bits_of_the_batch_api<xsimd::batch<float>>();
}
TEST_P(Lanes, ManyBatches) {
  expect_bits_of_the_batch_api<lanes::Many<xsimd::batch<float>, 4>>();
}

// And for ellipsoids: a shape for what leans, and a turned frame where only theta_z is there.
template <class F>
class EllipsoidLanes {
 public:
  EllipsoidLanes() {
    reference::Random random(3);
    for (std::size_t i = 0; i < kCount; ++i) {
      for (std::size_t c : {0, 1, 2}) in_[c][i] = float(random.uniform(-1, 1));
      for (std::size_t c : {3, 4}) in_[c][i] = float(random.log_uniform(1e-3, 1));
      for (std::size_t c : {5, 6, 7}) in_[c][i] = float(random.uniform(-3, 3));
      for (std::size_t c : {8, 9}) in_[c][i] = random.unit();
      for (std::size_t c : {10, 11, 12}) in_[c][i] = float(random.uniform(-1, 1));
    }
  }
  void expect_bits() {
    for (Warp warp : {Warp::polar, Warp::concentric, Warp::spherical_cap}) expect_normals(warp);
    for (bool turned : {false, true}) {
      evaluate_reflection(kCount, wo(), {column(10), column(11), column(12)}, ellipsoid(turned),
                          {batch_[0].data(), batch_[1].data()});
      each([&](std::size_t i, const V& v, const A& alpha) {
        V wi{load(10, i), load(11, i), load(12, i)};
        auto value = turned ? lanes::evaluate_reflection(v, wi, turned_shape(alpha, lanes::rotation_of(load(7, i))),
                                                         lanes::kSeparable)
                            : lanes::evaluate_reflection(v, wi, for_pairs(shape(alpha, i)), lanes::kLunes);
        return V{value.f_cos, value.pdf, F(0.f)};
      });
      batch_[2].assign(kCount, 0.f);
      EXPECT_TRUE(same_bits(batch_, lane_)) << "evaluation " << turned;
    }
  }

 private:
  static constexpr std::size_t kCount = 1 << 12;
  using V = lanes::Vec3<F>;
  using A = lanes::Vec2<F>;

  const float* column(std::size_t c) const { return in_[c].data(); }
  F load(std::size_t c, std::size_t i) const { return lanes::op::load<F>(column(c) + i); }
  Columns3 wo() const { return {column(0), column(1), column(2)}; }
  Ellipsoid ellipsoid(bool turned) const {
    Columns2 alpha{column(3), column(4)};
    return turned ? Ellipsoid(alpha, 0.f, 0.f, column(7)) : Ellipsoid(alpha, column(5), column(6), column(7));
  }
  lanes::Triangle<F> shape(const A& alpha, std::size_t i) const {
    return lanes::tilted_shape(alpha, load(5, i), load(6, i), load(7, i));
  }
  template <class Function>
  void each(Function f) {
    for (std::size_t i = 0; i < kCount; i += lanes::kWidth<F>) {
      V result = f(i, V{load(0, i), load(1, i), load(2, i)}, A{load(3, i), load(4, i)});
      lanes::op::store(result.x, lane_[0].data() + i);
      lanes::op::store(result.y, lane_[1].data() + i);
      lanes::op::store(result.z, lane_[2].data() + i);
    }
  }
  void expect_normals(Warp warp) {
    for (bool turned : {false, true}) {
      sample_normals(warp, kCount, wo(), ellipsoid(turned), {column(8), column(9)},
                     {batch_[0].data(), batch_[1].data(), batch_[2].data()});
      each([&](std::size_t i, const V& v, const A& alpha) {
        A u{load(8, i), load(9, i)};
        return with_warp(warp, [&](auto w) {
          return turned ? lanes::sample_normal_turned<decltype(w)>(v, alpha, load(7, i), u)
                        : lanes::sample_normal<decltype(w)>(v, shape(alpha, i), u);
        });
      });
      EXPECT_TRUE(same_bits(batch_, lane_)) << int(warp) << " " << turned;
    }
  }

  Table in_{13, std::vector<float>(kCount)};  // wo, alpha, theta, u, wi
  Table batch_{3, std::vector<float>(kCount)}, lane_ = batch_;
};
TEST(Ellipsoids, Float) {
  EllipsoidLanes<float>().expect_bits();
}
TEST(Ellipsoids, Batch) {
  EllipsoidLanes<xsimd::batch<float>>().expect_bits();
}
TEST(Ellipsoids, ManyBatches) {
  EllipsoidLanes<lanes::Many<xsimd::batch<float>, 2>>().expect_bits();
}

}  // namespace
}  // namespace vndf::testing
