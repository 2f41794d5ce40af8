// What dispatch.cpp is given: by kernels.cpp, compiled once for each instruction set, a table; and shapes.
#pragma once

#include <vndf/ellipsoid.h>

namespace vndf {

/// The functions of vndf.h and ellipsoid.h, for surfaces of one kind: S is Columns2, Shape or Ellipsoid.
template <class S>
struct SurfaceKernels {
  // [warp]
  void (*sample_normals[3])(std::size_t count, const Columns3& wo, const S& shape, const Columns2& u,
                            const Out3& wm) noexcept;
  void (*sample_reflection[3])(std::size_t count, const Columns3& wo, const S& shape, const Columns2& u,
                               const ReflectionSamples& out) noexcept;
  void (*evaluate_reflection)(std::size_t count, const Columns3& wo, const Columns3& wi, const S& shape,
                              const Evaluations& out) noexcept;
  void (*pdf_normals)(std::size_t count, const Columns3& wo, const Columns3& wm, const S& shape, float* pdf) noexcept;
  // [warp]
  void (*sample_dielectric[3])(std::size_t count, const Columns3& wo, const S& shape, const Column& eta,
                               const Columns3& u, const DielectricSamples& out) noexcept;
  void (*evaluate_dielectric)(std::size_t count, const Columns3& wo, const Columns3& wi, const S& shape,
                              const Column& eta, const Evaluations& out) noexcept;
};

struct KernelTable {
  // [map]
  void (*sample_disk[2])(std::size_t count, const Columns2& u, const Out2& t) noexcept;

  // [masking]; those of bounded sampling differ in reflection alone
  SurfaceKernels<Columns2> plain[2], bounded[2];
  SurfaceKernels<Shape> one_shape;
  SurfaceKernels<Ellipsoid> turned;  // theta_x = theta_y = 0
  SurfaceKernels<Ellipsoid> tilted;
};

/// The shape of an ellipsoid of five constants: make_shape.cpp.
Shape shape_of(const Ellipsoid& constants) noexcept;

}  // namespace vndf
