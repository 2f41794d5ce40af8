// How a kernel gets the surface of each lane: what it is templated on, so that there is one kernel for all of them. A
// surface is a frame, which theta_z turns, and a shape in it.
//
// Frames:
//   prepare(in, n)   before the stages of a block
//   wo(in, i)        the view in the frame
//   theta_z(i)       what turns directions back from it
// Shapes:
//   prepare(in, n)
//   at(in, i)        A for the products with the view, in two parts where it is not plain GGX
//   load(in, i)      A narrowed
//   for_pair(in, i)  what evaluates a given pair of directions
//
// and kUpright, whether (A v).z is v.z. Those that only serve given pairs have no at and load.
//
// kAlpha is the column of alpha_x, alpha_y follows it; kTheta that of the first angle.
#pragma once

#include "shape_access.h"

namespace {

/// That of the columns.
struct GivenFrame {
  template <std::size_t N>
  VNDF_INLINE void prepare(const Inputs<N>&, std::size_t) {}
  template <std::size_t N>
  static VNDF_INLINE Vec3<F> wo(const Inputs<N>& in, std::size_t i) {
    return load_wo(in, i);
  }
  static VNDF_INLINE lanes::XAxis theta_z(std::size_t) { return {}; }
};

/// Calls f(i, rotation) for the angles of a column.
template <std::size_t kTheta, std::size_t N, class Function>
VNDF_INLINE void for_each_rotation(const Inputs<N>& in, std::size_t n, Function f) {
  for_each_ahead(
      n, [&](std::size_t i) { return lanes::reduce_angle(in.template load<kTheta>(i)); },
      [&](std::size_t i, const lanes::ReducedAngle<F>& theta) {
        in.template prefetch<kTheta>(i);
        f(i, lanes::rotation_of(theta));
      });
}

template <std::size_t kTheta, std::size_t kLanes>
class TurnedFrame {
 public:
  template <std::size_t N>
  VNDF_INLINE void prepare(const Inputs<N>& in, std::size_t n) {
    for_each_rotation<kTheta>(in, n, [&](std::size_t i, const lanes::Rotation<F>& rotation) {
      angles_.store(i, lanes::angle_of<F>(rotation));
      Vec3<F> wo = lanes::turn(load_wo(in, i), rotation);
      turned_.store(i, {wo.x, wo.y});
    });
  }
  template <std::size_t N>
  VNDF_INLINE Vec3<F> wo(const Inputs<N>& in, std::size_t i) const {
    auto turned = turned_.load(i);
    return {turned.x, turned.y, in.template load<2>(i)};
  }
  VNDF_INLINE lanes::Angle<F> theta_z(std::size_t i) const { return angles_.load(i); }

 private:
  Staged<Vec2<F>, kLanes> turned_;  // wo, of which theta_z leaves z as it is
  Staged<lanes::Angle<F>, kLanes> angles_;
};

/// Plain GGX: the columns of alpha.
template <std::size_t kAlpha>
struct AlphaColumns {
  static constexpr bool kUpright = true;

  template <std::size_t N>
  VNDF_INLINE void prepare(const Inputs<N>&, std::size_t) {}
  template <std::size_t N>
  static VNDF_INLINE Vec2<F> at(const Inputs<N>& in, std::size_t i) {
    return {in.template load<kAlpha>(i), in.template load<kAlpha + 1>(i)};
  }
  template <std::size_t N>
  static VNDF_INLINE Vec2<F> load(const Inputs<N>& in, std::size_t i) {
    return at(in, i);
  }
  template <std::size_t N>
  static VNDF_INLINE Vec2<F> for_pair(const Inputs<N>& in, std::size_t i) {
    return at(in, i);
  }
};

/// One shape for all lanes.
VNDF_INLINE lanes::Tilted<F> for_all_lanes(const Shape& shape) {
  auto a = ShapeAccess::get(shape);
  auto all = [](const lanes::Split<float>& element) { return lanes::Split<F>{F(element.high), F(element.low)}; };
  return {F(a.xx), all(a.yx), all(a.yy), all(a.zx), all(a.zy), {F(a.azimuth.cos), F(a.azimuth.sin)}};
}

class OneShape {
 public:
  static constexpr bool kUpright = false;

  VNDF_INLINE void set(const Shape& shape) {
    shape_ = for_all_lanes(shape);
    narrowed_ = narrowed(shape_);
  }

  template <std::size_t N>
  VNDF_INLINE void prepare(const Inputs<N>&, std::size_t) {}
  // By reference: a copy of such aggregates may go through memory in pieces, see Staged.
  template <std::size_t N>
  VNDF_INLINE const lanes::Tilted<F>& at(const Inputs<N>&, std::size_t) const {
    return shape_;
  }
  template <std::size_t N>
  VNDF_INLINE const lanes::Tilted<F, F>& load(const Inputs<N>&, std::size_t) const {
    return narrowed_;
  }

 private:
  lanes::Tilted<F> shape_;
  lanes::Tilted<F, F> narrowed_;
};

/// The same for given pairs of directions.
class OneShapeForPairs {
 public:
  static constexpr bool kUpright = false;

  VNDF_INLINE void set(const Shape& shape) { shape_ = for_pairs(for_all_lanes(shape)); }

  template <std::size_t N>
  VNDF_INLINE void prepare(const Inputs<N>&, std::size_t) {}
  template <std::size_t N>
  VNDF_INLINE const lanes::TiltedForPairs<F>& for_pair(const Inputs<N>&, std::size_t) const {
    return shape_;
  }

 private:
  lanes::TiltedForPairs<F> shape_;
};

/// The columns of alpha and of all angles.
template <std::size_t kAlpha, std::size_t kTheta, std::size_t kLanes>
class TiltedColumns {
 public:
  static constexpr bool kUpright = false;

  template <std::size_t N>
  VNDF_INLINE void prepare(const Inputs<N>& in, std::size_t n) {
    for (std::size_t i = 0; i < n; i += kWidth) {
      in.template prefetch<kTheta, kTheta + 1, kTheta + 2>(i);
      shapes_.store(i, lanes::tilted_shape(AlphaColumns<kAlpha>::at(in, i), in.template load<kTheta>(i),
                                           in.template load<kTheta + 1>(i), in.template load<kTheta + 2>(i)));
    }
  }
  template <std::size_t N>
  VNDF_INLINE lanes::Tilted<F> at(const Inputs<N>&, std::size_t i) const {
    return shapes_.load(i);
  }
  template <std::size_t N>
  VNDF_INLINE lanes::Tilted<F, F> load(const Inputs<N>&, std::size_t i) const {
    return narrowed(shapes_.load(i));
  }
  template <std::size_t N>
  VNDF_INLINE lanes::TiltedForPairs<F> for_pair(const Inputs<N>&, std::size_t i) const {
    return for_pairs(shapes_.load(i));
  }

 private:
  Staged<lanes::Tilted<F>, kLanes> shapes_;
};

/// Plain GGX in turned frames, for given pairs of directions.
template <std::size_t kAlpha, std::size_t kTheta>
class TurnedColumns {
 public:
  static constexpr bool kUpright = true;

  template <std::size_t N>
  VNDF_INLINE void prepare(const Inputs<N>& in, std::size_t n) {
    for_each_rotation<kTheta>(in, n, [&](std::size_t i, const lanes::Rotation<F>& rotation) {
      shapes_.store(i, turned_shape(AlphaColumns<kAlpha>::at(in, i), rotation));
    });
  }
  template <std::size_t N>
  VNDF_INLINE lanes::Turned<F> for_pair(const Inputs<N>&, std::size_t i) const {
    return shapes_.load(i);
  }

 private:
  Staged<lanes::Turned<F>> shapes_;
};

/// What a kernel is templated on.
template <class Frame, class Shape>
struct Surface {
  static constexpr bool kUpright = Shape::kUpright;
  Frame frame;
  Shape shape;

  template <std::size_t N>
  VNDF_INLINE void prepare(const Inputs<N>& in, std::size_t n) {
    frame.prepare(in, n);
    shape.prepare(in, n);
  }
};

}  // namespace
