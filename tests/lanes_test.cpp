// The lane functions give the bits of the batch functions, in all rows of the table whose surface is made of columns.
// Compiled for float, for a vector of the set that the compiler has, and for several of those at once.
#include <map>

#include <vndf/lanes.h>

#include "support/inputs.h"

namespace vndf::testing {
namespace {

/// The columns of a call at an index.
template <class F>
struct Lane {
  using V3 = lanes::Vec3<F>;
  using V2 = lanes::Vec2<F>;
  const In& in;
  const Out& out;
  std::size_t i;

  F load(const Column& column) const { return lanes::op::load<F>(column.data + i); }
  V3 load(const Columns3& columns) const { return {load(columns.x), load(columns.y), load(columns.z)}; }
  V2 load(const Columns2& columns) const { return {load(columns.x), load(columns.y)}; }
  void store(float* column, F value) const { lanes::op::store(value, column + i); }
  void store(const Out3& columns, const V3& v) const {
    store(columns.x, v.x);
    store(columns.y, v.y);
    store(columns.z, v.z);
  }
};

// The surfaces: a frame, and a shape in it for views and for pairs of directions.
template <class F>
struct Plain {
  const Lane<F>& lane;
  auto view() const { return lane.load(lane.in.wo); }
  auto shape() const { return lane.load(lane.in.alpha); }
  auto for_pair() const { return shape(); }
  auto theta_z() const { return lanes::XAxis(); }
};
template <class F>
struct Turned {
  const Lane<F>& lane;
  auto rotation() const { return lanes::rotation_of(lane.load(lane.in.theta.z)); }
  auto view() const { return turn(lane.load(lane.in.wo), rotation()); }
  auto shape() const { return lane.load(lane.in.alpha); }
  auto for_pair() const { return turned_shape(shape(), rotation()); }
  auto theta_z() const { return lanes::angle_of<F>(rotation()); }
};
template <class F>
struct Tilted {
  const Lane<F>& lane;
  auto view() const { return lane.load(lane.in.wo); }
  auto shape() const {
    auto theta = lane.load(lane.in.theta);
    return lanes::tilted_shape(lane.load(lane.in.alpha), theta.x, theta.y, theta.z);
  }
  auto for_pair() const { return for_pairs(shape()); }
  auto theta_z() const { return lanes::XAxis(); }
};

/// What a row asks of the lobes of a dielectric.
struct Asked {
  bool radiance = false, given = false;
};

using Calls = std::map<std::string, decltype(Operation::call)>;

/// Calls of the lane functions by the names of the rows.
template <class F, template <class> class Surface>
class LaneCalls {
 public:
  LaneCalls(Calls& calls, std::string kind) : calls_(calls), kind_(std::move(kind)) {}

  template <class Warp>
  void normals(const std::string& warp) {
    add("normals" + kind_ + warp, [](const Lane<F>& lane, const auto& s) {
      auto u = lane.load(lane.in.pair());
      if constexpr (std::is_same_v<Surface<F>, Turned<F>>)
        lane.store(lane.out.wm,
                   lanes::sample_normal_turned<Warp>(lane.load(lane.in.wo), s.shape(), lane.load(lane.in.theta.z), u));
      else
        lane.store(lane.out.wm, lanes::sample_normal<Warp>(s.view(), s.shape(), u));
    });
  }
  void pdf_of_normals() {
    add("pdf_normals" + kind_, [](const Lane<F>& lane, const auto& s) {
      lane.store(lane.out.pdf, lanes::visible_normal_pdf(lane.load(lane.in.wo), lane.load(lane.in.wm), s.for_pair()));
    });
  }
  template <class Warp, class Masking>
  void reflection(const std::string& end, Masking masking) {
    add("reflection" + kind_ + end, [masking](const Lane<F>& lane, const auto& s) {
      auto sample = lanes::sample_reflection<Warp>(s.view(), s.shape(), lane.load(lane.in.pair()), masking);
      auto normal = unit_normal(sample.normal, s.theta_z());
      lane.store(lane.out.wi, turn_back(sample.wi, s.theta_z()));
      lane.store(lane.out.pdf, sample.pdf);
      lane.store(lane.out.weight, sample.weight);
      lane.store(lane.out.wm, normal.wm);
      lane.store(lane.out.wo_dot_wm, normal.cos);
    });
  }
  template <class Warp, class Masking>
  void dielectric(const std::string& end, Masking masking, Asked asked = {}) {
    add("dielectric" + kind_ + end, [masking, asked](const Lane<F>& lane, const auto& s) {
      auto sample = lanes::sample_dielectric<Warp>(s.view(), s.shape(), lane.load(lane.in.eta), lane.load(lane.in.u),
                                                   masking, lobes(lane, asked));
      lane.store(lane.out.wi, turn_back(sample, lane.load(lane.in.wo), s.theta_z()));
      lane.store(lane.out.pdf, sample.pdf);
      lane.store(lane.out.weight, sample.weight);
      lane.store(lane.out.side, sample.side);
      lane.store(lane.out.wm, turn_back(sample.wm, s.theta_z()));
      lane.store(lane.out.wo_dot_wm, sample.cos_o);
      lane.store(lane.out.wi_dot_wm, sample.cos_i);
      lane.store(lane.out.reflectance, sample.reflectance);
    });
  }
  template <class Masking>
  void evaluate_reflection(const std::string& end, Masking masking) {
    add("evaluate_reflection" + kind_ + end, [masking](const Lane<F>& lane, const auto& s) {
      auto wo = lane.load(lane.in.wo), wi = lane.load(lane.in.wi);
      store(lane, lanes::evaluate_reflection(wo, wi, s.for_pair(), masking));
      lane.store(lane.out.wo_dot_wm, lanes::half_cosine(wo, wi));
    });
  }
  template <class Masking>
  void evaluate_dielectric(const std::string& end, Masking masking, Asked asked = {}) {
    add("evaluate_dielectric" + kind_ + end, [masking, asked](const Lane<F>& lane, const auto& s) {
      auto wo = lane.load(lane.in.wo), wi = lane.load(lane.in.wi);
      F eta = lane.load(lane.in.eta);
      store(lane, lanes::evaluate_dielectric(wo, wi, s.for_pair(), eta, masking, lobes(lane, asked)));
    });
  }
  template <class Masking>
  void bounded_evaluation(const std::string& end, Masking masking) {
    add("evaluate_reflection" + kind_ + "_bounded" + end, [masking](const Lane<F>& lane, const auto& s) {
      auto wo = lane.load(lane.in.wo), wi = lane.load(lane.in.wi);
      store(lane, lanes::evaluate_reflection_bounded(wo, wi, s.for_pair(), masking));
      lane.store(lane.out.wo_dot_wm, lanes::half_cosine(wo, wi));
    });
  }
  template <class Warp>
  void disk(const std::string& warp) {
    add("disk" + warp, [](const Lane<F>& lane, const auto&) {
      auto t = cartesian(Warp::disk_point(lane.load(lane.in.pair())));
      lane.store(lane.out.t.x, t.x);
      lane.store(lane.out.t.y, t.y);
    });
  }

 private:
  static lanes::Lobes<F> lobes(const Lane<F>& lane, Asked asked) {
    return {asked.radiance, asked.given, asked.given ? lane.load(lane.in.reflection_probability) : F(0.f)};
  }
  static void store(const Lane<F>& lane, const lanes::Evaluation<F>& value) {
    lane.store(lane.out.f_cos, value.f_cos);
    lane.store(lane.out.pdf, value.pdf);
  }
  template <class Function>
  void add(const std::string& name, Function f) {
    calls_[name] = [f](std::size_t count, const In& in, const Out& out) {
      for (std::size_t i = 0; i < count; i += lanes::kWidth<F>) {
        Lane<F> lane{in, out, i};
        f(lane, Surface<F>{lane});
      }
    };
  }

  Calls& calls_;
  std::string kind_;
};

/// f(the lanes' warp, its name).
template <class Function>
void for_each_warp(Function f) {
  f(lanes::Polar(), std::string("_polar"));
  f(lanes::Concentric(), std::string("_concentric"));
  f(lanes::SphericalCap(), std::string("_spherical_cap"));
}

template <class F>
Calls lane_calls() {
  Calls calls;
  LaneCalls<F, Plain> plain(calls, "");
  plain.template disk<lanes::Polar>("_polar");
  plain.template disk<lanes::Concentric>("_concentric");
  auto options = [&](const std::string& name, auto masking) {
    for_each_warp([&](auto w, const std::string& warp) {
      using Warp = decltype(w);
      plain.template reflection<Warp>(warp + name, masking);
      plain.template reflection<lanes::Bounded<Warp>>(warp + "_bounded" + name, masking);
      plain.template dielectric<Warp>(warp + name, masking);
    });
    plain.evaluate_reflection(name, masking);
    plain.evaluate_dielectric(name, masking);
    plain.bounded_evaluation(name, masking);
  };
  options("", lanes::kHeightCorrelated);
  options("_separable", lanes::kSeparable);
  auto across = [](auto functions, const std::string& name, auto masking, Asked asked) {
    functions.template dielectric<lanes::Concentric>("_concentric" + name, masking, asked);
    functions.evaluate_dielectric(name, masking, asked);
  };
  const lanes::Smith as_reflection{Masking::height_correlated, AcrossMasking::as_reflection},
      correlated{Masking::height_correlated, AcrossMasking::height_correlated};
  across(plain, "_as_reflection", as_reflection, {});
  across(plain, "_correlated_across", correlated, {});
  across(plain, "_radiance", lanes::kHeightCorrelated, {true, false});
  across(plain, "_probability", lanes::kHeightCorrelated, {false, true});
  across(plain, "_radiance_probability_separable", lanes::kSeparable, {true, true});
  auto normals = [](auto functions) {
    for_each_warp([&](auto w, const std::string& warp) { functions.template normals<decltype(w)>(warp); });
    functions.pdf_of_normals();
  };
  auto ellipsoid = [&](auto functions, auto masking) {
    for_each_warp([&](auto w, const std::string& warp) {
      functions.template reflection<decltype(w)>(warp, masking);
      functions.template dielectric<decltype(w)>(warp, masking);
    });
    functions.evaluate_reflection("", masking);
    functions.evaluate_dielectric("", masking);
    across(functions, "_radiance_probability", masking, {true, true});
    normals(functions);
  };
  normals(plain);
  ellipsoid(LaneCalls<F, Turned>(calls, "_turned"), lanes::kSeparable);
  ellipsoid(LaneCalls<F, Tilted>(calls, "_tilted"), lanes::kLunes);
  return calls;
}

TEST(Lanes, HaveTheBitsOfTheBatchFunctions) {
  constexpr std::size_t kCount = 3 << 12;
  Calls calls = lane_calls<VNDF_LANES>();
  for (const Operation& batch : operations()) {
    bool made_of_columns = batch.takes(Kind::alpha) || !batch.takes(Kind::view);
    bool two_sided = batch.name.find("_two_sided") != std::string::npos;  // batch functions turn views over
    ASSERT_EQ(calls.count(batch.name), made_of_columns && !two_sided) << batch.name << " has no lane function here";
    if (!calls.count(batch.name)) continue;
    Operation lane = batch;
    lane.call = calls[batch.name];
    Table in = mixed_inputs(batch, kCount, 1);
    EXPECT_TRUE(same_bits(batch, evaluate(batch, in), evaluate(lane, in), in));
  }
}

}  // namespace
}  // namespace vndf::testing
