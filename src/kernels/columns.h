// The columns of a call as a kernel sees them. They stand at the beginning of a block, and load(i) and store(i) count
// from there.
#pragma once

#include <vndf/lanes.h>
#include <vndf/vndf.h>

namespace {

namespace lanes = vndf::lanes;
namespace op = lanes::op;
using lanes::Vec2;
using lanes::Vec3;

/// A vector of the instruction set.
using Vector = VNDF_BATCH;
constexpr std::size_t kWidth = lanes::kWidth<Vector>;
/// How many vectors a kernel takes at once, see cmake/isa.cmake.
constexpr int kVectors = VNDF_VECTORS;
constexpr std::size_t kAtOnce = kVectors * kWidth;

/// Lanes of a block.
constexpr std::size_t kBlock = 256;
static_assert(kBlock % kAtOnce == 0);

/// An input column of a call, and where it stands. It holds nothing but pointers, and run_block copies it with its
/// kernel: so compilers know that no store to an output changes it.
class InColumn {
 public:
  VNDF_INLINE InColumn(const vndf::Column& given) : given_(&given), at_(given.data) {}

  VNDF_INLINE const vndf::Column& given() const { return *given_; }
  VNDF_INLINE void stand_at(const float* at) { at_ = at; }
  /// A constant stays where it stands: all its values are the same.
  VNDF_INLINE void move_to(std::size_t begin) {
    if (given_->data) at_ = given_->data + begin;
  }

  template <class F>
  VNDF_INLINE F load(std::size_t i) const {
    return op::load<F>(at_ + i);
  }

 private:
  const vndf::Column* given_;
  const float* at_;
};

class OutColumn {
 public:
  /// A null pointer is a column that is not wanted.
  VNDF_INLINE OutColumn(float* given) : given_(given), at_(given) {}

  VNDF_INLINE float* given() const { return given_; }
  VNDF_INLINE bool wanted() const { return given_; }
  VNDF_INLINE void stand_at(float* at) { at_ = at; }

  template <class F>
  VNDF_INLINE void store(std::size_t i, const F& value) const {
    op::store(value, at_ + i);
  }
  template <class F>
  VNDF_INLINE void store_if_wanted(std::size_t i, const F& value) const {
    if (wanted()) store(i, value);
  }

 private:
  float *given_, *at_;
};

// Several columns, and a function over each of them.
struct InColumns2 {
  InColumn x, y;

  VNDF_INLINE InColumns2(const vndf::Columns2& c) : x(c.x), y(c.y) {}
  template <class F>
  VNDF_INLINE Vec2<F> load(std::size_t i) const {
    return {x.load<F>(i), y.load<F>(i)};
  }
  template <class Function>
  VNDF_INLINE void each(Function f) {
    f(x), f(y);
  }
};
struct InColumns3 {
  InColumn x, y, z;

  VNDF_INLINE InColumns3(const vndf::Columns3& c) : x(c.x), y(c.y), z(c.z) {}
  template <class F>
  VNDF_INLINE Vec3<F> load(std::size_t i) const {
    return {x.load<F>(i), y.load<F>(i), z.load<F>(i)};
  }
  template <class Function>
  VNDF_INLINE void each(Function f) {
    f(x), f(y), f(z);
  }
};
struct OutColumns3 {
  OutColumn x, y, z;

  VNDF_INLINE OutColumns3(const vndf::Out3& out) : x(out.x), y(out.y), z(out.z) {}
  template <class F>
  VNDF_INLINE void store(std::size_t i, const Vec3<F>& v) const {
    x.store(i, v.x);
    y.store(i, v.y);
    z.store(i, v.z);
  }
  template <class Function>
  VNDF_INLINE void each(Function f) {
    f(x), f(y), f(z);
  }
};

}  // namespace
