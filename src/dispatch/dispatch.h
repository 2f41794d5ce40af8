// What the public functions share on their way to their kernels.
#pragma once

#include <cassert>
#include <cstdint>

#include "../kernel_tables.h"
#include "float_mode.h"

namespace vndf {

/// The row of the set in use, in the order of isa_rows.h.
std::size_t active_row() noexcept;

/// The shape of an ellipsoid of five constants: make_shape.cpp.
Shape shape_of(const Ellipsoid& constants) noexcept;

/// The kernel of an enumerator. Asserts that it is in its range.
template <class Kernel, std::size_t N, class Enum>
const Kernel& of(const Kernel (&kernels)[N], Enum which) noexcept {
  assert(static_cast<std::size_t>(which) < N);
  return kernels[static_cast<std::size_t>(which)];
}

/// Asserts that columns of floats can have this count, and that there are columns to write to.
template <class... Columns>
void expect_written([[maybe_unused]] std::size_t count, [[maybe_unused]] Columns... columns) noexcept {
  assert(count <= PTRDIFF_MAX / sizeof(float));
  assert(count == 0 || (columns && ...));
}
inline void expect_written(std::size_t count, const Out3& out) noexcept {
  expect_written(count, out.x, out.y, out.z);
}
inline void expect_written(std::size_t count, const Evaluations& out) noexcept {
  expect_written(count, out.f_cos, out.pdf);
}

/// Asserts that input columns are constants or point somewhere.
inline void expect_given([[maybe_unused]] std::size_t count, [[maybe_unused]] const Column& column) noexcept {
  assert(count == 0 || column.constant || column.data);
}
inline void expect_given(std::size_t count, const Columns2& in) noexcept {
  expect_given(count, in.x), expect_given(count, in.y);
}
inline void expect_given(std::size_t count, const Columns3& in) noexcept {
  expect_given(count, in.x), expect_given(count, in.y), expect_given(count, in.z);
}
inline void expect_given(std::size_t count, const Ellipsoid& e) noexcept {
  expect_given(count, e.alpha), expect_given(count, e.theta_x), expect_given(count, e.theta_y);
  expect_given(count, e.theta_z);
}
inline void expect_given(std::size_t, const Shape&) noexcept {}
template <class First, class Second, class... Rest>
void expect_given(std::size_t count, const First& first, const Second& second, const Rest&... rest) noexcept {
  expect_given(count, first), expect_given(count, second, rest...);
}

/// The options as kernels read them. Ellipsoids have a masking of their own.
inline DielectricAsked asked_of(std::size_t count, const DielectricOptions& options) noexcept {
  assert(static_cast<std::size_t>(options.masking) < 2 && static_cast<std::size_t>(options.across) < 3);
  const auto& p = options.reflection_probability;
  if (p) expect_given(count, *p);
  return {options.masking, options.across, options.radiance, p ? &*p : nullptr};
}
inline DielectricAsked asked_of_ellipsoid(std::size_t count, const DielectricOptions& options) noexcept {
  auto asked = asked_of(count, options);
  asked.masking = Masking::separable;
  asked.across = AcrossMasking::separable;
  return asked;
}

inline bool constant(const Column& column) {
  return !column.data;
}
inline bool zero(const Column& column) {
  return constant(column) && column.value == 0;
}

/// Calls the cheapest kernel for the surface.
template <class In, class Out, std::size_t kMaskings>
void call(const BySurface<In, Out, kMaskings>& kernels, std::size_t count, const In& in, const Columns2& alpha,
          const Out& out, Masking masking = Masking::height_correlated) noexcept {
  FloatMode exact;
  of(kernels.alpha, masking)(count, in, alpha, out);
}
template <class In, class Out, std::size_t kMaskings>
void call(const BySurface<In, Out, kMaskings>& kernels, std::size_t count, const In& in, const Ellipsoid& e,
          const Out& out) noexcept {
  FloatMode exact;
  bool turned = zero(e.theta_x) && zero(e.theta_y);
  if (turned && zero(e.theta_z))
    kernels.alpha[kMaskings - 1](count, in, e.alpha, out);  // separable is what eq. 6 of Walter et al. 2015 becomes
  else if (constant(e.alpha.x) && constant(e.alpha.y) && constant(e.theta_x) && constant(e.theta_y) &&
           constant(e.theta_z))
    kernels.matrix(count, in, {shape_of(e), nullptr}, out);
  else if (turned)
    kernels.turned(count, in, e, out);
  else
    kernels.matrix(count, in, {Shape(), &e}, out);
}
template <class In, class Out, std::size_t kMaskings>
void call(const BySurface<In, Out, kMaskings>& kernels, std::size_t count, const In& in, const Shape& shape,
          const Out& out) noexcept {
  FloatMode exact;
  kernels.matrix(count, in, {shape, nullptr}, out);
}

}  // namespace vndf
