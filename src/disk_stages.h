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

/// Normals alone need no lengths.
template <DiskMap map, class View, class Surface, std::size_t kLanes, bool kWithLengths>
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
    if constexpr (!Surface::kUpright) {
      for (std::size_t i = 0; i < n; i += kWidth) stretched_.store(i, stretched(in, surface, i));
    }
    for (std::size_t i = 0; i < n; i += kWidth) {
      in.template prefetch<3, 4>(i);
      Vec3<F> h;
      if constexpr (Surface::kUpright)
        h = stretched(in, surface, i);
      else
        h = stretched_.load(i);
      F length;
      views_.store(i, lanes::scale_view(h, azimuth_of(surface.shape.at(in, i)), length));
      if constexpr (kWithLengths) lengths_.store(i, length);
    }
    for (std::size_t i = 0; i < n; i += kWidth) {
      auto elevation = lanes::elevation_of(views_.load(i));
      elevations_.store(i, elevation);
      if constexpr (kWithLengths && !Surface::kUpright)
        areas_.store(i, lanes::lune_area(lengths_.load(i), stretched_.load(i).z, elevation.one_plus_z));
    }
  }

  VNDF_INLINE lanes::Chord<F> chord(std::size_t i) const { return chords_.load(i); }
  VNDF_INLINE lanes::HemisphereView<F> view(std::size_t i) const {
    return lanes::hemisphere_view(views_.load(i), elevations_.load(i));
  }
  /// |A wo|, and |A wo| + (A wo).z.
  VNDF_INLINE F length(std::size_t i) const { return lengths_.load(i); }
  VNDF_INLINE F area(std::size_t i, F wo_z) const {
    if constexpr (Surface::kUpright)
      return length(i) + wo_z;
    else
      return areas_.load(i);
  }

 private:
  template <std::size_t N>
  static VNDF_INLINE Vec3<F> stretched(const Inputs<N>& in, const Surface& surface, std::size_t i) {
    return stretch(View::view(surface.frame.wo(in, i)), surface.shape.at(in, i));
  }

  Staged<lanes::DiskPoint<F>, kLanes> points_;
  Staged<lanes::Chord<F>, kLanes> chords_;
  Staged<Vec3<F>, kLanes> stretched_;  // of what leans: there A takes as long as a stage
  Staged<lanes::ScaledView<F>, kLanes> views_;
  Staged<F, kLanes> lengths_, areas_;  // areas of what leans
  Staged<lanes::Elevation<F>, kLanes> elevations_;
};

}  // namespace
