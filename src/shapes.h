// How a kernel gets the shape of each lane: what it is templated on, so that there is one kernel for all of them.
//
//   prepare(in, begin, end)  before the stages of a block: what takes some computing
//   at(in, i)                A for the products with what the caller gives, in two parts where it is not plain GGX
//   load(in, i)              A narrowed
//
// kAlpha is the column of alpha_x, alpha_y follows it; kTheta the first one of the angles. T is Split<F>, or F where
// `at` is not needed.
#pragma once

#include "shape_access.h"

namespace {

/// Plain GGX: the columns of alpha.
template <std::size_t kAlpha>
struct AlphaColumns {
  using Type = Vec2<F>;

  template <std::size_t N>
  VNDF_INLINE void prepare(const Inputs<N>&, std::size_t, std::size_t) {}
  template <std::size_t N>
  static VNDF_INLINE Vec2<F> at(const Inputs<N>& in, std::size_t i) {
    return {in.template load<kAlpha>(i), in.template load<kAlpha + 1>(i)};
  }
  template <std::size_t N>
  static VNDF_INLINE Vec2<F> load(const Inputs<N>& in, std::size_t i) {
    return at(in, i);
  }
};

/// One shape for all lanes.
class OneShape {
 public:
  using Type = lanes::Tilted<F>;

  VNDF_INLINE void set(const Shape& shape) {
    shape_ = ShapeAccess::get(shape);
    narrowed_ = narrowed(shape_);
  }

  template <std::size_t N>
  VNDF_INLINE void prepare(const Inputs<N>&, std::size_t, std::size_t) {}
  template <std::size_t N>
  VNDF_INLINE lanes::Tilted<F> at(const Inputs<N>&, std::size_t) const {
    auto each = [](const lanes::Split<float>& a) { return lanes::Split<F>{F(a.high), F(a.low)}; };
    const auto& a = shape_;
    return {each(a.xx), each(a.xy), each(a.yx), each(a.yy), each(a.zx), each(a.zy), det()};
  }
  template <std::size_t N>
  VNDF_INLINE lanes::Tilted<F, F> load(const Inputs<N>&, std::size_t) const {
    const auto& a = narrowed_;
    return {F(a.xx), F(a.xy), F(a.yx), F(a.yy), F(a.zx), F(a.zy), det()};
  }

 private:
  VNDF_INLINE Vec2<F> det() const { return {F(shape_.det.x), F(shape_.det.y)}; }

  lanes::Tilted<float> shape_;
  lanes::Tilted<float, float> narrowed_;
};

template <std::size_t kAlpha, std::size_t kTheta, std::size_t kLanes, class T>
class TurnedColumns {
 public:
  using Type = lanes::Turned<F>;

  template <std::size_t N>
  VNDF_INLINE void prepare(const Inputs<N>& in, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i += kWidth) {
      in.template prefetch<kTheta>(i);
      auto z = lanes::angle_of(in.template load<kTheta>(i));
      angles_.store(i, {lanes::as<T>(z.cos), lanes::as<T>(z.sin)});
    }
  }
  template <std::size_t N>
  VNDF_INLINE lanes::Turned<F, T> at(const Inputs<N>& in, std::size_t i) const {
    return {angles_.load(i), AlphaColumns<kAlpha>::at(in, i)};
  }
  template <std::size_t N>
  VNDF_INLINE lanes::Turned<F, F> load(const Inputs<N>& in, std::size_t i) const {
    return narrowed(at(in, i));
  }

 private:
  Staged<lanes::Angle<T>, kLanes> angles_;
};

template <std::size_t kAlpha, std::size_t kTheta, std::size_t kLanes, class T>
class TiltedColumns {
 public:
  using Type = lanes::Tilted<F>;

  template <std::size_t N>
  VNDF_INLINE void prepare(const Inputs<N>& in, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i += kWidth) {
      in.template prefetch<kTheta, kTheta + 1, kTheta + 2>(i);
      shapes_.store(
          i, lanes::as<T>(lanes::tilted_shape(AlphaColumns<kAlpha>::at(in, i), in.template load<kTheta>(i),
                                              in.template load<kTheta + 1>(i), in.template load<kTheta + 2>(i))));
    }
  }
  template <std::size_t N>
  VNDF_INLINE lanes::Tilted<F, T> at(const Inputs<N>&, std::size_t i) const {
    return shapes_.load(i);
  }
  template <std::size_t N>
  VNDF_INLINE lanes::Tilted<F, F> load(const Inputs<N>& in, std::size_t i) const {
    return narrowed(at(in, i));
  }

 private:
  Staged<lanes::Tilted<F, T>, kLanes> shapes_;
};

/// The view that is sampled for: the column's, or for a dielectric the one turned to the upper hemisphere.
struct AsGiven {
  template <std::size_t N>
  static VNDF_INLINE Vec3<F> view(const Inputs<N>& in, std::size_t i) {
    return load_wo(in, i);
  }
};
struct TurnedUp {
  template <std::size_t N>
  static VNDF_INLINE Vec3<F> view(const Inputs<N>& in, std::size_t i) {
    Vec3<F> wo = load_wo(in, i);
    return lanes::turned(wo.z < F(0.f), wo);
  }
};

/// A wo. For plain GGX that is two products, taken where they are needed; for other shapes a stage.
template <class Shapes, class View, std::size_t kLanes>
class StretchedViews {
 public:
  template <std::size_t N>
  VNDF_INLINE void prepare(const Inputs<N>& in, const Shapes& shapes, std::size_t i) {
    if constexpr (!kPlain) views_.store(i, stretch(View::view(in, i), shapes.at(in, i)));
  }
  template <std::size_t N>
  VNDF_INLINE Vec3<F> load(const Inputs<N>& in, const Shapes& shapes, std::size_t i) const {
    if constexpr (kPlain)
      return stretch(View::view(in, i), shapes.at(in, i));
    else
      return views_.load(i);
  }

 private:
  static constexpr bool kPlain = std::is_same_v<typename Shapes::Type, Vec2<F>>;
  Staged<Vec3<F>, kLanes> views_;
};

}  // namespace
