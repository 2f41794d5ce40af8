// What Heitz 2018 does before the reprojection, for a block: points of the disk, their chords, and views in the
// hemisphere configuration. Each stage is short enough for a core to work on several vectors at once.
#pragma once

namespace {

/// The view that is sampled for: the one given, or for a dielectric the one mirrored to the upper hemisphere.
struct AsGiven {
  static VNDF_INLINE Vec3<F> view(const Vec3<F>& wo) { return wo; }
};
struct FacingUp {
  static VNDF_INLINE Vec3<F> view(const Vec3<F>& wo) { return lanes::mirrored(wo.z < F(0.f), wo); }
};

template <DiskMap map>
VNDF_INLINE lanes::DiskPoint<F> map_disk(Vec2<F> u) {
  return map == DiskMap::polar ? lanes::polar_map(u) : lanes::concentric_map(u);
}

/// A wo. Of shapes that lean it takes as long as a stage.
template <class View, class Surface, std::size_t kLanes>
class StretchStage {
 public:
  template <std::size_t N>
  VNDF_INLINE void run(const Inputs<N>& in, const Surface& surface, std::size_t n) {
    if constexpr (!Surface::kUpright)
      for (std::size_t i = 0; i < n; i += kWidth) stretched_.store(i, stretched(in, surface, i));
  }
  template <std::size_t N>
  VNDF_INLINE Vec3<F> load(const Inputs<N>& in, const Surface& surface, std::size_t i) const {
    if constexpr (Surface::kUpright)
      return stretched(in, surface, i);
    else
      return stretched_.load(i);
  }

 private:
  template <std::size_t N>
  static VNDF_INLINE Vec3<F> stretched(const Inputs<N>& in, const Surface& surface, std::size_t i) {
    return stretch(View::view(surface.frame.wo(in, i)), surface.shape.at(in, i));
  }

  Staged<Vec3<F>, kLanes> stretched_;
};

/// Normals alone need no size of the view.
template <DiskMap map, class View, class Surface, std::size_t kLanes, bool kWithSize>
class DiskStages {
 public:
  template <std::size_t N>
  VNDF_INLINE void run(const Inputs<N>& in, const Surface& surface, std::size_t n) {
    if constexpr (map == DiskMap::polar) {
      for (std::size_t i = 0; i < n; i += kWidth) {
        in.template prefetch<0, 1>(i);
        points_.store(i, lanes::polar_map(load_u(in, i)));
      }
    } else {
      for_each_ahead(
          n, [&](std::size_t i) { return lanes::wedge_of(load_u(in, i)); },
          [&](std::size_t i, const lanes::Wedge<F>& wedge) {
            in.template prefetch<0, 1>(i);
            points_.store(i, lanes::concentric_map(wedge));
          });
    }
    for (std::size_t i = 0; i < n; i += kWidth) {
      in.template prefetch<2>(i);
      chords_.store(i, lanes::chord(points_.load(i)));
    }
    stretched_.run(in, surface, n);
    for (std::size_t i = 0; i < n; i += kWidth) {
      in.template prefetch<3, 4>(i);
      F length;
      views_.store(i, lanes::scale_view(stretched_.load(in, surface, i), azimuth_of(surface.shape.at(in, i)), length));
      if constexpr (kWithSize) lengths_.store(i, length);
    }
    for (std::size_t i = 0; i < n; i += kWidth) {
      auto elevation = elevation_of(views_.load(i));
      elevations_.store(i, elevation);
      if constexpr (kWithSize) {
        F h_z = stretched_.load(in, surface, i).z, length = lengths_.load(i);
        F area = Surface::kUpright ? length + h_z : lanes::lune_area(length, h_z, elevation.one_plus_z);
        areas_.store(i, area);
      }
    }
  }

  VNDF_INLINE lanes::Chord<F> chord(std::size_t i) const { return chords_.load(i); }
  VNDF_INLINE lanes::HemisphereView<F> view(std::size_t i) const {
    return lanes::hemisphere_view(views_.load(i), elevations_.load(i));
  }
  VNDF_INLINE lanes::ViewSize<F> size(std::size_t i) const { return {lengths_.load(i), areas_.load(i)}; }

 private:
  Staged<lanes::DiskPoint<F>, kLanes> points_;
  Staged<lanes::Chord<F>, kLanes> chords_;
  StretchStage<View, Surface, kLanes> stretched_;
  Staged<lanes::ScaledView<F>, kLanes> views_;
  Staged<F, kLanes> lengths_, areas_;
  Staged<lanes::Elevation<F>, kLanes> elevations_;
};

}  // namespace
