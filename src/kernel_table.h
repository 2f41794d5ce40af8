// The boundary between instruction sets: what kernels.cpp, compiled once for each, gives dispatch.cpp.
#pragma once

#include <vndf/vndf.h>

namespace vndf {

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
};

}  // namespace vndf
