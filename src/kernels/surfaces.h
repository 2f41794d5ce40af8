// The kinds of surfaces, as kernels get them: a frame, which theta_z turns, and a shape in it.
//   prepare(n)          works out what the kernel then loads, for a block of n lanes
//   view(wo, i)         wo in the frame
//   shape<F>(i)         A for the view
//   theta_z<F>(i)       what turns directions back from the frame
//   for_pair<F>(i)      what evaluates a given pair of directions, in the frame of the columns
//   masking(...)        how it is masked: what a call asked for, or the one that there is
#pragma once

#include "../kernel_tables.h"
#include "../shape_access.h"
#include "columns.h"

#include <utility>

namespace {

/// Plain GGX: A = diag(alpha_x, alpha_y, 1).
struct Alpha {
  using Given = vndf::Columns2;
  struct Room {};
  InColumns2 alpha;

  VNDF_INLINE Alpha(const Given& given, std::size_t, Room&) : alpha(given) {}
  static VNDF_INLINE constexpr lanes::Smith masking(vndf::Masking above, vndf::AcrossMasking across = {}) {
    return {above, across};
  }
  template <class Function>
  VNDF_INLINE void each(Function f) {
    alpha.each(f);
  }
  VNDF_INLINE void prepare(std::size_t) const {}

  template <class F>
  VNDF_INLINE Vec3<F> view(const Vec3<F>& wo, std::size_t) const {
    return wo;
  }
  template <class F, class Place>
  VNDF_INLINE Vec2<F> shape(Place i) const {
    return alpha.load<F>(i);
  }
  template <class F>
  VNDF_INLINE lanes::XAxis theta_z(std::size_t) const {
    return {};
  }
  template <class F, class Place>
  VNDF_INLINE Vec2<F> for_pair(Place i) const {
    return alpha.load<F>(i);
  }
};

/// Plain GGX whose axes theta_z turns about n.
struct TurnedAlpha {
  using Given = vndf::Ellipsoid;
  struct Room {};
  InColumns2 alpha;
  InColumn angle;

  VNDF_INLINE TurnedAlpha(const Given& given, std::size_t, Room&) : alpha(given.alpha), angle(given.theta_z) {}
  /// What eq. 6 of Walter et al. 2015 is without theta_x and theta_y.
  static VNDF_INLINE constexpr lanes::Smith masking(vndf::Masking, vndf::AcrossMasking = {}) {
    return lanes::kSeparable;
  }
  template <class Function>
  VNDF_INLINE void each(Function f) {
    alpha.each(f), f(angle);
  }
  VNDF_INLINE void prepare(std::size_t) const {}

  template <class F, class Place>
  VNDF_INLINE Vec3<F> view(const Vec3<F>& wo, Place i) const {
    return turn(wo, lanes::rotation_of(angle.load<F>(i)));
  }
  template <class F, class Place>
  VNDF_INLINE Vec2<F> shape(Place i) const {
    return alpha.load<F>(i);
  }
  template <class F, class Place>
  VNDF_INLINE lanes::Angle<F> theta_z(Place i) const {
    return lanes::angle_of<F>(angle.load<F>(i));
  }
  template <class F, class Place>
  VNDF_INLINE lanes::TurnedAlpha<F> for_pair(Place i) const {
    return turned_shape(alpha.load<F>(i), lanes::rotation_of(angle.load<F>(i)));
  }
};

/// A block of an aggregate of lanes, such as a triangle.
template <template <class> class Lanes>
class Staged {
 public:
  template <class F>
  VNDF_INLINE void store(std::size_t i, const Lanes<F>& value) {
    store<F>(i, value, Members());
  }
  template <class F>
  VNDF_INLINE Lanes<F> load(std::size_t i) const {
    return load<F>(i, Members());
  }

 private:
  static constexpr std::size_t kMembers = sizeof(Lanes<float>) / sizeof(float);
  using Members = std::make_index_sequence<kMembers>;

  // Member by member: a copy of the whole may go through memory, in pieces whose reads stall.
  template <class F, std::size_t... m>
  VNDF_INLINE void store(std::size_t i, const Lanes<F>& value, std::index_sequence<m...>) {
    (op::store(reinterpret_cast<const F*>(&value)[m], lanes_[m] + i), ...);
  }
  template <class F, std::size_t... m>
  VNDF_INLINE Lanes<F> load(std::size_t i, std::index_sequence<m...>) const {
    Lanes<F> value;
    ((reinterpret_cast<F*>(&value)[m] = op::load<F>(lanes_[m] + i)), ...);
    return value;
  }

  alignas(64) float lanes_[kMembers][kBlock];
};

/// What is kept of a matrix for sampling, and for given pairs of directions.
struct ForViews {
  template <class F>
  using Kept = lanes::Triangle<F>;
  template <class F>
  static VNDF_INLINE Kept<F> of(const lanes::Triangle<F>& a) {
    return a;
  }
};
struct ForPairs {
  template <class F>
  using Kept = lanes::TriangleForPairs<F>;
  template <class F>
  static VNDF_INLINE Kept<F> of(const lanes::Triangle<F>& a) {
    return for_pairs(a);
  }
};

/// The matrix A of any ellipsoid, leaning or not. One for the batch is worked out once; one for each lane is worked out
/// block by block, from its angles. A kernel loads it in the same way.
template <class For>
class Matrix {
 public:
  using Given = vndf::Matrices;
  using Room = Staged<For::template Kept>;

  VNDF_INLINE Matrix(const Given& given, std::size_t count, Room& room)
      : Matrix(given, given.per_lane ? *given.per_lane : kNone, count, room) {}

  static VNDF_INLINE constexpr lanes::Lunes masking(vndf::Masking, vndf::AcrossMasking = {}) { return lanes::kLunes; }

  template <class Function>
  VNDF_INLINE void each(Function f) {
    if (per_lane_) alpha_.each(f), f(theta_x_), f(theta_y_), f(theta_z_);
  }
  VNDF_INLINE void prepare(std::size_t n) const {
    if (per_lane_) work_out(n, alpha_, theta_x_, theta_y_, theta_z_, *room_);
  }

  template <class F>
  VNDF_INLINE Vec3<F> view(const Vec3<F>& wo, std::size_t) const {
    return wo;
  }
  template <class F>
  VNDF_INLINE auto shape(std::size_t i) const {
    return room_->template load<F>(i);
  }
  template <class F>
  VNDF_INLINE lanes::XAxis theta_z(std::size_t) const {
    return {};
  }
  template <class F>
  VNDF_INLINE auto for_pair(std::size_t i) const {
    return room_->template load<F>(i);
  }

 private:
  // A constant expression, since a call of Column's constructor could be linked to the copy of another set's object.
  static constexpr vndf::Ellipsoid kNone{vndf::Columns2{0.f, 0.f}};

  VNDF_INLINE Matrix(const Given& given, const vndf::Ellipsoid& e, std::size_t count, Room& room)
      : per_lane_(given.per_lane),
        alpha_(e.alpha),
        theta_x_(e.theta_x),
        theta_y_(e.theta_y),
        theta_z_(e.theta_z),
        room_(&room) {
    if (per_lane_) return;
    auto a = vndf::ShapeAccess::get(given.one);
    auto all = [](const lanes::Split<float>& x) { return lanes::Split<Vector>{Vector(x.high), Vector(x.low)}; };
    auto kept = For::of(lanes::Triangle<Vector>{
        Vector(a.xx), all(a.yx), all(a.yy), all(a.zx), all(a.zy), {Vector(a.azimuth.cos), Vector(a.azimuth.sin)}});
    for (std::size_t i = 0; i < kBlock && i < count; i += kWidth) room.store(i, kept);
  }

  // Not inlined: one function for all kernels of an object.
  VNDF_NOINLINE static void work_out(std::size_t n, InColumns2 alpha, InColumn theta_x, InColumn theta_y,
                                     InColumn theta_z, Room& room) {
    for (std::size_t i = 0; i < n; i += kWidth) {
      Part part = Part::at(i, n);
      room.store(i, For::of(lanes::tilted_shape(alpha.load<Vector>(part), theta_x.load<Vector>(part),
                                                theta_y.load<Vector>(part), theta_z.load<Vector>(part))));
    }
  }

  bool per_lane_;
  InColumns2 alpha_;
  InColumn theta_x_, theta_y_, theta_z_;
  Room* room_;
};

}  // namespace
