// The columns of a call as a kernel sees them. They stand at the beginning of a block, and load(i) and store(i) count
// from there; with a Part instead of i, they touch its lanes alone.
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
/// How many vectors a kernel takes at once, see cmake/isa.cmake. Those that evaluate a given pair have short chains, of
/// which two are enough: more only take registers.
constexpr int kVectors = VNDF_VECTORS;
constexpr int kVectorsOfPairs = kVectors < 2 ? kVectors : 2;

/// Lanes of a block.
constexpr std::size_t kBlock = 256;

/// One vector of a block, of which the first lanes are in the columns.
struct Part {
  std::size_t begin, lanes;

  /// That at lane i of a block of n.
  static VNDF_INLINE Part at(std::size_t i, std::size_t n) { return {i, n - i < kWidth ? n - i : kWidth}; }
  /// Where the columns are padded.
  VNDF_INLINE operator std::size_t() const { return begin; }
};

/// An input column of a call, and where it stands.
class InColumn {
 public:
  VNDF_INLINE InColumn(const vndf::Column& given) : given_(&given), at_(given.data) {}

  VNDF_INLINE bool constant() const { return !given_->data; }
  VNDF_INLINE float value() const { return given_->value; }
  VNDF_INLINE void stand_at(const float* at) { at_ = at; }
  /// A constant stays where it stands: all its values are the same.
  VNDF_INLINE void move_to(std::size_t begin) {
    if (!constant()) at_ = given_->data + begin;
  }

  template <class F>
  VNDF_INLINE F load(std::size_t i) const {
    return op::load<F>(at_ + i);
  }
  template <class F>
  VNDF_INLINE F load(Part part) const {
    return op::load_first<F>(at_ + part.begin, part.lanes);
  }

 private:
  const vndf::Column* given_;
  const float* at_;
};

class OutColumn {
 public:
  /// A null pointer is a column that is not wanted.
  VNDF_INLINE OutColumn(float* const& given) : given_(&given), at_(given) {}

  VNDF_INLINE float* given() const { return *given_; }
  VNDF_INLINE bool aligned() const { return reinterpret_cast<std::uintptr_t>(given()) % sizeof(Vector) == 0; }
  VNDF_INLINE bool wanted() const { return at_; }
  VNDF_INLINE void stand_at(float* at) {
    if (wanted()) at_ = at;
  }
  VNDF_INLINE void move_to(std::size_t begin) {
    if (wanted()) at_ = given() + begin;
  }

  template <class F>
  VNDF_INLINE void store(std::size_t i, const F& value) const {
    op::store(value, at_ + i);
  }
  template <class F>
  VNDF_INLINE void store(Part part, const F& value) const {
    op::store_first(value, at_ + part.begin, part.lanes);
  }
  template <class F, class Place>
  VNDF_INLINE void store_if_wanted(Place i, const F& value) const {
    if (wanted()) store(i, value);
  }

 private:
  float* const* given_;
  float* at_;
};

// Several columns, and a function over each of them.
struct InColumns2 {
  InColumn x, y;

  VNDF_INLINE InColumns2(const vndf::Columns2& c) : x(c.x), y(c.y) {}
  template <class F, class Place>
  VNDF_INLINE Vec2<F> load(Place i) const {
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
  template <class F, class Place>
  VNDF_INLINE Vec3<F> load(Place i) const {
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
  template <class F, class Place>
  VNDF_INLINE void store(Place i, const Vec3<F>& v) const {
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
