// How a kernel gets the shape of each lane: what it is templated on, so that there is one kernel for all of them.
//
//   at(in, i)               from the columns
//   prepare(in, begin, end) before the stages of a block, and then
//   load(in, i)             in its stages
//
// kAlpha is the column of alpha_x, alpha_y follows it; kTheta the first one of the angles.
#pragma once

namespace {

/// Plain GGX: the columns of alpha.
template <std::size_t kAlpha>
struct AlphaColumns {
  template <std::size_t N>
  static VNDF_INLINE Vec2<F> at(const Inputs<N>& in, std::size_t i) {
    return {in.template load<kAlpha>(i), in.template load<kAlpha + 1>(i)};
  }
  template <std::size_t N>
  VNDF_INLINE void prepare(const Inputs<N>&, std::size_t, std::size_t) {}
  template <std::size_t N>
  static VNDF_INLINE Vec2<F> load(const Inputs<N>& in, std::size_t i) {
    return at(in, i);
  }
};

/// One shape for all lanes.
class OneShape {
 public:
  void set(const Shape& shape) {
    const float* from = reinterpret_cast<const float*>(&shape);
    for (std::size_t c = 0; c < kMembers; ++c) lanes::op::store(F(from[c]), values_[c]);
  }
  template <std::size_t N>
  VNDF_INLINE lanes::Tilted<F> at(const Inputs<N>&, std::size_t) const {
    lanes::Tilted<F> shape;
    for (std::size_t c = 0; c < kMembers; ++c) reinterpret_cast<F*>(&shape)[c] = lanes::op::load<F>(values_[c]);
    return shape;
  }
  template <std::size_t N>
  VNDF_INLINE void prepare(const Inputs<N>&, std::size_t, std::size_t) {}
  template <std::size_t N>
  VNDF_INLINE lanes::Tilted<F> load(const Inputs<N>& in, std::size_t i) const {
    return at(in, i);
  }

 private:
  static constexpr std::size_t kMembers = sizeof(Shape) / sizeof(float);
  static_assert(sizeof(Shape) == sizeof(lanes::Tilted<float>));
  alignas(64) float values_[kMembers][kWidth];
};

/// Shapes that take some computing, once for a block.
template <class Columns, class T, std::size_t kLanes>
struct StagedShapes : Columns {
  Staged<T, kLanes> shapes;

  template <std::size_t N>
  VNDF_INLINE void prepare(const Inputs<N>& in, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i += kWidth) {
      in.template prefetch<Columns::kFirst>(i);
      shapes.store(i, Columns::at(in, i));
    }
  }
  template <std::size_t N>
  VNDF_INLINE T load(const Inputs<N>&, std::size_t i) const {
    return shapes.load(i);
  }
};

template <std::size_t kAlpha, std::size_t kTheta>
struct TurnedColumns {
  static constexpr std::size_t kFirst = kTheta;
  template <std::size_t N>
  static VNDF_INLINE lanes::Turned<F> at(const Inputs<N>& in, std::size_t i) {
    return lanes::turned_shape(AlphaColumns<kAlpha>::at(in, i), in.template load<kTheta>(i));
  }
};
template <std::size_t kAlpha, std::size_t kTheta, std::size_t kLanes>
using TurnedShapes = StagedShapes<TurnedColumns<kAlpha, kTheta>, lanes::Turned<F>, kLanes>;

template <std::size_t kAlpha, std::size_t kTheta>
struct TiltedColumns {
  static constexpr std::size_t kFirst = kTheta;
  template <std::size_t N>
  static VNDF_INLINE lanes::Tilted<F> at(const Inputs<N>& in, std::size_t i) {
    return lanes::tilted_shape(AlphaColumns<kAlpha>::at(in, i), in.template load<kTheta>(i),
                               in.template load<kTheta + 1>(i), in.template load<kTheta + 2>(i));
  }
};
template <std::size_t kAlpha, std::size_t kTheta, std::size_t kLanes>
using TiltedShapes = StagedShapes<TiltedColumns<kAlpha, kTheta>, lanes::Tilted<F>, kLanes>;

}  // namespace
