// The kernels of visible normals, and of points on the disk.
#pragma once

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

template <DiskMap map, class Surface>
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
      normals.store(i, reproject(view, t).nh);
    }
    for (std::size_t i = 0; i < n; i += kWidth) {
      in.template prefetch<6>(i);
      store(map_from_hemisphere(normals.load(i), surface.shape.load(in, i), surface.frame.theta_z(i)), wm, i);
    }
  }
};

template <class Surface>
struct NormalsOnCap {
  static constexpr std::size_t kLanes = kBlock;
  Surface surface;
  StretchStage<AsGiven, Surface, kBlock> stretched;
  Staged<lanes::CapView<F>> views;
  Staged<Vec3<F>> normals;

  template <std::size_t N>
  VNDF_INLINE void operator()(const Inputs<N>& in, const Outputs<3>& wm, std::size_t n) {
    surface.prepare(in, n);
    stretched.run(in, surface, n);
    for (std::size_t i = 0; i < n; i += kWidth) {
      in.template prefetch<0, 1, 2>(i);
      views.store(i, lanes::cap_view(stretched.load(in, surface, i), azimuth_of(surface.shape.at(in, i))));
    }
    for (std::size_t i = 0; i < n; i += kWidth) {
      in.template prefetch<5, 6>(i);
      normals.store(i, on_cap(views.load(i), lanes::cap_map(load_u(in, i))).nh);
    }
    for (std::size_t i = 0; i < n; i += kWidth) {
      in.template prefetch<3, 4>(i);
      store(map_from_hemisphere(normals.load(i), surface.shape.load(in, i), surface.frame.theta_z(i)), wm, i);
    }
  }
};

template <DiskMap map>
struct DiskPoints {
  static constexpr std::size_t kLanes = kBlock;

  VNDF_INLINE void operator()(const Inputs<2>& u, const Outputs<2>& t, std::size_t n) {
    for (std::size_t i = 0; i < n; i += kWidth) store(cartesian(map_disk<map>({u.load<0>(i), u.load<1>(i)})), t, i);
  }
};

}  // namespace
