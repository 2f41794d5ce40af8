// The boundary between the instruction sets and those who choose one: for each public function a table of its kernels.
// src/kernels/sample_normals.cpp, compiled for AVX2, exports vndf::avx2::sample_normals;
// src/dispatch/sample_normals.cpp calls through it.
#pragma once

#include <vndf/ellipsoid.h>

namespace vndf {

constexpr std::size_t kWarps = 3;
constexpr std::size_t kDiskMaps = 2;

/// One matrix for the batch; or one for each lane, where `per_lane` is not null.
struct Matrices {
  Shape one;
  const Ellipsoid* per_lane;
};

/// The kernels of a function, one for each kind of surface. For plain alpha there is one for each masking, where that
/// matters. `turned` does not read theta_x and theta_y.
template <class In, class Out, std::size_t kMaskings = 2>
struct BySurface {
  void (*alpha[kMaskings])(std::size_t count, const In& in, const Columns2& alpha, const Out& out) noexcept;
  void (*turned)(std::size_t count, const In& in, const Ellipsoid& ellipsoid, const Out& out) noexcept;
  void (*matrix)(std::size_t count, const In& in, const Matrices& matrices, const Out& out) noexcept;
};

struct DiskTable {
  void (*maps[kDiskMaps])(std::size_t count, const Columns2& u, const Out2& t) noexcept;
};

struct NormalsIn {
  const Columns3& wo;
  const Columns2& u;
};
struct NormalsTable {
  BySurface<NormalsIn, Out3, 1> warps[kWarps];
};

struct ReflectionIn {
  const Columns3& wo;
  const Columns2& u;
};
struct ReflectionTable {
  BySurface<ReflectionIn, ReflectionSamples> warps[kWarps];
  void (*bounded[kWarps][2])(std::size_t count, const ReflectionIn& in, const Columns2& alpha,
                             const ReflectionSamples& out) noexcept;
};

struct EvaluationIn {
  const Columns3 &wo, &wi;
};
struct EvaluationTable {
  BySurface<EvaluationIn, Evaluations> all;
  void (*bounded[2])(std::size_t count, const EvaluationIn& in, const Columns2& alpha, const Evaluations& out) noexcept;
};

struct DensityIn {
  const Columns3 &wo, &wm;
};
struct DensityTable {
  BySurface<DensityIn, float*, 1> all;
};

/// DielectricOptions, without what would be compiled for each set: std::optional.
struct DielectricAsked {
  Masking masking;
  AcrossMasking across;
  bool radiance;
  const Column* reflection_probability;  // or null
};
struct DielectricIn {
  const Columns3& wo;
  const Column& eta;
  const Columns3& u;
  DielectricAsked asked;
};
struct DielectricTable {
  BySurface<DielectricIn, DielectricSamples, 1> warps[kWarps];
};

struct DielectricEvaluationIn {
  const Columns3 &wo, &wi;
  const Column& eta;
  DielectricAsked asked;
};
struct DielectricEvaluationTable {
  BySurface<DielectricEvaluationIn, Evaluations, 1> all;
};

}  // namespace vndf
