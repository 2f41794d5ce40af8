// The batch functions for one instruction set. Compiled once per row of cmake/isa.cmake, with VNDF_BATCH its vector
// type and VNDF_TABLE the one name this object exports.
#include "kernel_table.h"

#include <vndf/lanes.h>

#include "blocks.h"

namespace {

using namespace vndf;
using lanes::Vec2;
using lanes::Vec3;

// The columns of the sampling functions: wo, alpha, u, and what else there is.
template <std::size_t N>
VNDF_INLINE Vec3<F> load_wo(const Inputs<N>& in, std::size_t i) {
  return {in.template load<0>(i), in.template load<1>(i), in.template load<2>(i)};
}
template <std::size_t N>
VNDF_INLINE Vec2<F> load_u(const Inputs<N>& in, std::size_t i) {
  return {in.template load<5>(i), in.template load<6>(i)};
}

}  // namespace

#include "shapes.h"

#include "disk_stages.h"

namespace {

VNDF_INLINE void store(const Vec2<F>& v, const Outputs<2>& out, std::size_t i) {
  out.store<0>(i, v.x);
  out.store<1>(i, v.y);
}
VNDF_INLINE void store(const Vec3<F>& v, const Outputs<3>& out, std::size_t i) {
  out.store<0>(i, v.x);
  out.store<1>(i, v.y);
  out.store<2>(i, v.z);
}

template <DiskMap map, class Surface = PlainSurface<3>>
struct NormalsOnDisk {
  static constexpr std::size_t kLanes = kBlock;
  Surface surface;
  DiskStages<map, AsGiven, Surface, kBlock, false> disk;
  Staged<Vec3<F>> normals;

  template <std::size_t N>
  VNDF_INLINE void operator()(const Inputs<N>& in, const Outputs<3>& wm, std::size_t n) {
    surface.prepare(in, n);
    if (n == kWidth) {
      auto t = chord(map_disk<map>(load_u(in, 0)));
      store(sample_normal_on_chord(surface.frame.wo(in, 0), surface.shape.at(in, 0), t, surface.frame.theta_z(0)), wm,
            0);
      return;
    }
    disk.run(in, surface, n);
    for (std::size_t i = 0; i < n; i += kWidth) {
      in.template prefetch<5>(i);
      auto view = disk.view(i);
      auto t = disk.chord(i);
      normals.store(i, reproject(view, t, squish(view, t)));
    }
    for (std::size_t i = 0; i < n; i += kWidth) {
      in.template prefetch<6>(i);
      store(map_from_hemisphere(normals.load(i), surface.shape.load(in, i), surface.frame.theta_z(i)), wm, i);
    }
  }
};

template <class Surface = PlainSurface<3>>
struct NormalsOnCap {
  static constexpr std::size_t kLanes = kBlock;
  Surface surface;
  Staged<lanes::CapAtView<F>> caps;
  Staged<Vec3<F>> normals;

  template <std::size_t N>
  VNDF_INLINE void operator()(const Inputs<N>& in, const Outputs<3>& wm, std::size_t n) {
    surface.prepare(in, n);
    for (std::size_t i = 0; i < n; i += kWidth) {
      in.template prefetch<0, 1, 2>(i);
      caps.store(i, visible_cap_of(stretch(surface.frame.wo(in, i), surface.shape.load(in, i))));
    }
    for (std::size_t i = 0; i < n; i += kWidth) {
      in.template prefetch<5, 6>(i);
      Vec2<F> u = load_u(in, i);
      normals.store(i, on_visible_cap(caps.load(i), lanes::sincos2pi(u.x), u.y));
    }
    for (std::size_t i = 0; i < n; i += kWidth) {
      in.template prefetch<3, 4>(i);
      store(map_from_hemisphere(normals.load(i), surface.shape.load(in, i), surface.frame.theta_z(i)), wm, i);
    }
  }
};

template <class Kernel>
void sample_normals(std::size_t count, const Columns3& wo, const Columns2& alpha, const Columns2& u,
                    const Out3& wm) noexcept {
  Kernel kernel;
  for_each_block<7, 3>(count, {&wo.x, &wo.y, &wo.z, &alpha.x, &alpha.y, &u.x, &u.y}, {wm.x, wm.y, wm.z}, kernel);
}

template <DiskMap map>
struct DiskPoints {
  static constexpr std::size_t kLanes = kBlock;

  VNDF_INLINE void operator()(const Inputs<2>& u, const Outputs<2>& t, std::size_t n) {
    for (std::size_t i = 0; i < n; i += kWidth) store(cartesian(map_disk<map>({u.load<0>(i), u.load<1>(i)})), t, i);
  }
};

template <DiskMap map>
void sample_disk(std::size_t count, const Columns2& u, const Out2& t) noexcept {
  DiskPoints<map> kernel;
  for_each_block<2, 2>(count, {&u.x, &u.y}, {t.x, t.y}, kernel);
}

}  // namespace

#include "shading_kernels.h"

#include "dielectric_kernels.h"

#include "ellipsoid_kernels.h"

namespace vndf {

extern const KernelTable VNDF_TABLE;
const KernelTable VNDF_TABLE = {
    {::sample_normals<NormalsOnDisk<DiskMap::polar>>, ::sample_normals<NormalsOnDisk<DiskMap::concentric>>,
     ::sample_normals<NormalsOnCap<>>},
    {::sample_disk<DiskMap::polar>, ::sample_disk<DiskMap::concentric>},
    {{VNDF_PER_WARP(sample_reflection, false, Masking::height_correlated),
      VNDF_PER_WARP(sample_reflection, false, Masking::separable)},
     {VNDF_PER_WARP(sample_reflection, true, Masking::height_correlated),
      VNDF_PER_WARP(sample_reflection, true, Masking::separable)}},
    {{::evaluate_reflection<false, Masking::height_correlated>, ::evaluate_reflection<false, Masking::separable>},
     {::evaluate_reflection<true, Masking::height_correlated>, ::evaluate_reflection<true, Masking::separable>}},
    ::pdf_normals,
    {VNDF_PER_WARP(sample_dielectric, Masking::height_correlated),
     VNDF_PER_WARP(sample_dielectric, Masking::separable)},
    {::evaluate_dielectric<Masking::height_correlated>, ::evaluate_dielectric<Masking::separable>},
    VNDF_SHAPE_KERNELS(OneShapes, Shape),
    VNDF_SHAPE_KERNELS(AllTurned, Ellipsoid),
    VNDF_SHAPE_KERNELS(AllTilted, Ellipsoid),
};

}  // namespace vndf
