// What dispatch.cpp is given: by kernels.cpp, compiled once for each instruction set, a table; and shapes.
#pragma once

#include <vndf/ellipsoid.h>

namespace vndf {

/// The functions of ellipsoid.h, for shapes of one kind.
template <class S>
struct ShapeKernels {
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
  void (*sample_normals[3])(std::size_t count, const Columns3& wo, const Columns2& alpha, const Columns2& u,
                            const Out3& wm) noexcept;
  void (*sample_disk[2])(std::size_t count, const Columns2& u, const Out2& t) noexcept;

  // [bounded][masking][warp]
  void (*sample_reflection[2][2][3])(std::size_t count, const Columns3& wo, const Columns2& alpha, const Columns2& u,
                                     const ReflectionSamples& out) noexcept;
  void (*evaluate_reflection[2][2])(std::size_t count, const Columns3& wo, const Columns3& wi, const Columns2& alpha,
                                    const Evaluations& out) noexcept;
  void (*pdf_normals)(std::size_t count, const Columns3& wo, const Columns3& wm, const Columns2& alpha,
                      float* pdf) noexcept;

  // [masking][warp]
  void (*sample_dielectric[2][3])(std::size_t count, const Columns3& wo, const Columns2& alpha, const Column& eta,
                                  const Columns3& u, const DielectricSamples& out) noexcept;
  void (*evaluate_dielectric[2])(std::size_t count, const Columns3& wo, const Columns3& wi, const Columns2& alpha,
                                 const Column& eta, const Evaluations& out) noexcept;

  ShapeKernels<Shape> one_shape;
  ShapeKernels<Ellipsoid> turned;  // theta_x = theta_y = 0
  ShapeKernels<Ellipsoid> tilted;
};

/// The shape of an ellipsoid of five constants: make_shape.cpp.
Shape shape_of(const Ellipsoid& constants) noexcept;

}  // namespace vndf
