// The lane functions of the shading step give the bits of the batch functions, for float and for a vector of the set
// that the test is compiled for: plain GGX, and shapes that lean.
#include <gtest/gtest.h>

#include <vndf/ellipsoid.h>
#include <vndf/lanes.h>

#include "reference/random.h"
#include "shading/inputs.h"
#include "support/bits.h"

namespace vndf::shading {
namespace {

using testing::same_bits;
using testing::Table;

constexpr std::size_t kCount = 1 << 12;

Table random_inputs() {
  reference::Random random(3);
  Table in(12, std::vector<float>(kCount));
  for (std::size_t i = 0; i < kCount; ++i)
    for (std::size_t c = 0; c < in.size(); ++c) {
      bool alpha = c == 6 || c == 7, eta = c == 11;
      in[c][i] = alpha ? float(random.log_uniform(1e-3, 1))
                 : eta ? float(random.uniform(0.4, 2.5))
                       : (c < 6 ? float(random.uniform(-1, 1)) : random.unit());
    }
  return in;
}

/// f(the lanes' warp).
template <class Function>
auto with_warp(Warp warp, Function f) {
  return warp == Warp::polar        ? f(lanes::Polar())
         : warp == Warp::concentric ? f(lanes::Concentric())
                                    : f(lanes::SphericalCap());
}

/// What sample_reflection writes.
template <class F>
struct Reflected {
  lanes::Vec3<F> wi;
  F pdf, weight;
  lanes::Vec3<F> wm;
  F wo_dot_wm;
};
template <class F>
Reflected<F> all_of(const lanes::ReflectionSample<F>& s) {
  auto normal = unit_normal(s.normal);
  return {s.wi, s.pdf, s.weight, normal.wm, normal.cos};
}

template <class F>
class Lanes {
 public:
  template <class Masked>
  void expect_bits_of_plain_ggx(Masking masking, const Masked& masked) {
    const Columns2 alpha{column(6), column(7)}, u{column(8), column(9)};
    for (Warp warp : kWarps)
      for (bool bounded : {false, true}) {
        sample_reflection(warp, kCount, wo(), alpha, u, reflection(), {masking, bounded});
        each([&](const V& wo, const V&, const A& alpha, const A& u, F, F) {
          return with_warp(warp, [&](auto w) {
            using W = decltype(w);
            return all_of(bounded ? lanes::sample_reflection<lanes::Bounded<W>>(wo, alpha, u, masked)
                                  : lanes::sample_reflection<W>(wo, alpha, u, masked));
          });
        });
        EXPECT_TRUE(same_bits(batch_, lane_)) << "reflection " << int(warp) << " bounded " << bounded;
      }
    for (bool bounded : {false, true}) {
      evaluate_reflection(kCount, wo(), wi(), alpha, {out(0), out(1)}, {masking, bounded});
      each([&](const V& wo, const V& wi, const A& alpha, const A&, F, F) {
        return bounded ? lanes::evaluate_reflection_bounded(wo, wi, alpha, masked)
                       : lanes::evaluate_reflection(wo, wi, alpha, masked);
      });
      EXPECT_TRUE(same_bits(batch_, lane_)) << "evaluation, bounded " << bounded;
    }
    for (Warp warp : kWarps) {
      sample_dielectric(warp, kCount, wo(), alpha, column(11), {u.x, u.y, column(10)},
                        {{out(0), out(1), out(2)}, out(3), out(4), out(5)}, masking);
      each([&](const V& wo, const V&, const A& alpha, const A& u, F u3, F eta) {
        auto sample = with_warp(warp, [&](auto w) {
          return lanes::sample_dielectric<decltype(w)>(wo, alpha, eta, V{u.x, u.y, u3}, masked);
        });
        return Refracted{sample.wi, sample.pdf, sample.weight, sample.side};
      });
      EXPECT_TRUE(same_bits(batch_, lane_)) << "dielectric " << int(warp);
    }
    evaluate_dielectric(kCount, wo(), wi(), alpha, column(11), {out(0), out(1)}, masking);
    each([&](const V& wo, const V& wi, const A& alpha, const A&, F, F eta) {
      return lanes::evaluate_dielectric(wo, wi, alpha, eta, masked);
    });
    EXPECT_TRUE(same_bits(batch_, lane_)) << "evaluation of the dielectric";
    pdf_normals(kCount, wo(), wi(), alpha, out(0));
    each([&](const V& wo, const V& wm, const A& alpha, const A&, F, F) {
      return lanes::visible_normal_pdf(wo, wm, alpha);
    });
    EXPECT_TRUE(same_bits(batch_, lane_)) << "density of normals";
  }

  void expect_bits_of_ellipsoids() {
    const Ellipsoid ellipsoid({column(6), column(7)}, column(3), column(4), column(5));
    for (Warp warp : kWarps) {
      sample_reflection(warp, kCount, wo(), ellipsoid, {column(8), column(9)}, reflection());
      each([&](const V& wo, const V& theta, const A& alpha, const A& u, F, F) {
        auto shape = lanes::tilted_shape(alpha, theta.x, theta.y, theta.z);
        return with_warp(
            warp, [&](auto w) { return all_of(lanes::sample_reflection<decltype(w)>(wo, shape, u, lanes::kLunes)); });
      });
      EXPECT_TRUE(same_bits(batch_, lane_)) << "ellipsoids " << int(warp);
    }
  }

 private:
  using V = lanes::Vec3<F>;
  using A = lanes::Vec2<F>;
  struct Refracted {
    V wi;
    F pdf, weight, side;
  };

  const float* column(std::size_t c) const { return in_[c].data(); }
  float* out(std::size_t c) { return batch_[c].data(); }
  Columns3 wo() const { return {column(0), column(1), column(2)}; }
  Columns3 wi() const { return {column(3), column(4), column(5)}; }
  ReflectionSamples reflection() {
    return {{out(0), out(1), out(2)}, out(3), out(4), {out(5), out(6), out(7)}, out(8)};
  }

  /// Stores the members of f's result, in order, and takes the other columns as they are.
  template <class Function>
  void each(Function f) {
    lane_ = batch_;
    for (std::size_t i = 0; i < kCount; i += lanes::kWidth<F>) {
      auto load = [&](std::size_t c) { return lanes::op::load<F>(column(c) + i); };
      auto result = f(V{load(0), load(1), load(2)}, V{load(3), load(4), load(5)}, A{load(6), load(7)},
                      A{load(8), load(9)}, load(10), load(11));
      F members[sizeof result / sizeof(F)];
      std::memcpy(members, &result, sizeof result);
      for (std::size_t c = 0; c < std::size(members); ++c) lanes::op::store(members[c], lane_[c].data() + i);
    }
  }

  Table in_ = random_inputs();  // wo, wi, alpha, u, eta
  Table batch_{9, std::vector<float>(kCount)}, lane_ = batch_;
};

template <class F>
void expect_bits() {
  Lanes<F> test;
  test.expect_bits_of_plain_ggx(Masking::height_correlated, lanes::kHeightCorrelated);
  test.expect_bits_of_plain_ggx(Masking::separable, lanes::kSeparable);
  test.expect_bits_of_ellipsoids();
}
TEST(ShadingLanes, Float) {
  expect_bits<float>();
}
TEST(ShadingLanes, Batch) {
  expect_bits<xsimd::batch<float>>();
}
TEST(ShadingLanes, ManyBatches) {
  expect_bits<lanes::Many<xsimd::batch<float>, 2>>();
}

}  // namespace
}  // namespace vndf::shading
