// The kernels of the shading step: reflection at visible normals, and densities.
#pragma once

namespace {

namespace op = lanes::op;

/// The stages of the shading step hand one another more than those of the normals do: half a block at a time keeps it
/// in the first-level cache.
constexpr std::size_t kShadingBlock = kBlock / 2;
template <class T>
using StagedForShading = Staged<T, kShadingBlock>;

template <Warp warp>
constexpr DiskMap kDiskMap = warp == Warp::polar ? DiskMap::polar : DiskMap::concentric;

/// Visible normals from the disk, as Heitz 2018 lays it on the hemisphere.
template <Warp warp, class View, class Surface>
class FacetsOnDisk {
 public:
  template <std::size_t N>
  VNDF_INLINE void sample(const Inputs<N>& in, const Surface& surface, std::size_t n) {
    disk_.run(in, surface, n);
    for (std::size_t i = 0; i < n; i += kWidth) {
      in.template prefetch<5, 6>(i);
      facets_.store(i, sample_on_chord(disk_.view(i), disk_.size(i).length, disk_.chord(i)));
    }
  }
  VNDF_INLINE lanes::Facet<F> load(std::size_t i) const { return facets_.load(i); }
  VNDF_INLINE lanes::ViewSize<F> size(std::size_t i) const { return disk_.size(i); }

 private:
  DiskStages<kDiskMap<warp>, View, Surface, kShadingBlock, true> disk_;
  StagedForShading<lanes::Facet<F>> facets_;
};

template <Warp warp>
VNDF_INLINE lanes::CapPoint<F> map_cap(Vec2<F> u) {
  if constexpr (warp == Warp::polar)
    return lanes::polar_cap_map(u);
  else if constexpr (warp == Warp::concentric)
    return lanes::concentric_cap_map(lanes::wedge_of(u));
  else
    return lanes::cap_map(u);
}

/// Visible normals from a spherical cap, on which the warp of bounded sampling lays the square, or the disk by
/// Lambert's map.
template <Warp warp, bool bounded, class View, class Surface>
class FacetsOnCap {
 public:
  template <std::size_t N>
  VNDF_INLINE void sample(const Inputs<N>& in, const Surface& surface, std::size_t n) {
    stretched_.run(in, surface, n);
    for (std::size_t i = 0; i < n; i += kWidth) {
      in.template prefetch<0, 1, 2>(i);
      Vec3<F> h = stretched_.load(in, surface, i);
      auto view = lanes::cap_view(h, azimuth_of(surface.shape.at(in, i)));
      views_.store(i, view);
      if constexpr (bounded) {
        auto bound = lanes::reflection_bound(surface.frame.wo(in, i), surface.shape.at(in, i));
        bounds_.store(i, bound);
        sizes_.store(i, lanes::bounded_size(view, h.z, bound));
      } else {
        sizes_.store(i, lanes::visible_size<Surface::kUpright>(view, h.z));
      }
    }
    for (std::size_t i = 0; i < n; i += kWidth) {
      in.template prefetch<5, 6>(i);
      auto view = views_.load(i);
      auto c = map_cap<warp>(load_u(in, i));
      if constexpr (bounded)
        facets_.store(i, lanes::facet_of(on_bounded_cap(view, bounds_.load(i), c), view));
      else
        facets_.store(i, lanes::facet_of(on_cap(view, c), view));
    }
  }
  VNDF_INLINE lanes::CapFacet<F> load(std::size_t i) const { return facets_.load(i); }
  VNDF_INLINE lanes::ViewSize<F> size(std::size_t i) const { return sizes_.load(i); }

 private:
  StretchStage<View, Surface, kShadingBlock> stretched_;
  StagedForShading<lanes::CapView<F>> views_;
  StagedForShading<lanes::Bound<F>> bounds_;
  StagedForShading<lanes::ViewSize<F>> sizes_;
  StagedForShading<lanes::CapFacet<F>> facets_;
};

template <Warp warp, bool bounded, class View, class Surface>
using Facets = std::conditional_t<bounded || warp == Warp::spherical_cap, FacetsOnCap<warp, bounded, View, Surface>,
                                  FacetsOnDisk<warp, View, Surface>>;

/// A direction that is sampled.
struct Direction {
  Vec3<F> wi;
  F spread;
};

template <std::size_t C, std::size_t M>
VNDF_INLINE void store_if_wanted(const Outputs<M>& out, std::size_t i, F value) {
  if (out.column[C]) out.template store<C>(i, value);
}

/// No output is written before the last stage: it may lie over an input.
template <Warp warp, bool bounded, class Masked, class Surface>
class ReflectionKernel {
 public:
  static constexpr std::size_t kLanes = kShadingBlock;
  Surface surface;

  template <std::size_t N>
  VNDF_INLINE void operator()(const Inputs<N>& in, const Outputs<9>& out, std::size_t n) {
    bool with_normals = out.column[5] || out.column[6] || out.column[7] || out.column[8];
    surface.prepare(in, n);
    facets_.sample(in, surface, n);
    if (with_normals)
      shade<true>(in, out, n);
    else
      shade<false>(in, out, n);
  }

 private:
  template <bool with_normals, std::size_t N>
  VNDF_INLINE void shade(const Inputs<N>& in, const Outputs<9>& out, std::size_t n) {
    for (std::size_t i = 0; i < n; i += kWidth)
      seen_.store(i, seen_normal(surface.frame.wo(in, i), facets_.load(i).nh, surface.shape.load(in, i)));
    for (std::size_t i = 0; i < n; i += kWidth) {
      Vec3<F> wo = surface.frame.wo(in, i);
      const auto& shape = surface.shape.load(in, i);
      auto facet = facets_.load(i);
      auto normal = normal_of(facet, seen_.load(i));
      directions_.store(i, {reflect(wo, normal), spread(facet.nh, normal, facets_.size(i).area, shape)});
      if constexpr (with_normals) normals_.store(i, unit_normal(normal, surface.frame.theta_z(i)));
    }
    for (std::size_t i = 0; i < n; i += kWidth)
      lights_.store(i, Masked::light(directions_.load(i).wi, surface.shape.load(in, i)));
    for (std::size_t i = 0; i < n; i += kWidth) {
      F wo_z = in.template load<2>(i);
      auto direction = directions_.load(i);
      auto sample =
          lanes::weigh_reflection<Masked>(wo_z, facets_.size(i), direction.wi.z, direction.spread, lights_.load(i));
      Vec3<F> wi = turn_back(direction.wi, surface.frame.theta_z(i));
      if constexpr (with_normals) {
        auto normal = normals_.load(i);
        store_if_wanted<5>(out, i, normal.wm.x);
        store_if_wanted<6>(out, i, normal.wm.y);
        store_if_wanted<7>(out, i, normal.wm.z);
        store_if_wanted<8>(out, i, normal.cos);
      }
      out.store<0>(i, wi.x);
      out.store<1>(i, wi.y);
      out.store<2>(i, wi.z);
      out.store<3>(i, sample.pdf);
      out.store<4>(i, sample.weight);
    }
  }

  Facets<warp, bounded, AsGiven, Surface> facets_;
  StagedForShading<lanes::SeenNormal<F>> seen_;
  StagedForShading<Direction> directions_;
  StagedForShading<typename Masked::template Light<F>> lights_;
  StagedForShading<lanes::UnitNormal<F>> normals_;
};

/// The light or the normal, second of a pair.
template <std::size_t N>
VNDF_INLINE Vec3<F> load_second(const Inputs<N>& in, std::size_t i) {
  return {in.template load<3>(i), in.template load<4>(i), in.template load<5>(i)};
}

template <bool bounded, class Masked, class Surface>
class ReflectionEvaluation {
 public:
  static constexpr std::size_t kLanes = kBlock;
  Surface surface;

  template <std::size_t N>
  VNDF_INLINE void operator()(const Inputs<N>& in, const Outputs<2>& out, std::size_t n) {
    surface.prepare(in, n);
    for (std::size_t i = 0; i < n; i += kWidth)
      terms_.store(i, terms_of(load_wo(in, i), load_second(in, i), surface.shape.for_pair(in, i)));
    for (std::size_t i = 0; i < n; i += kWidth) {
      auto value = lanes::evaluate_pair(in.template load<2>(i), in.template load<5>(i), terms_.load(i));
      out.store<0>(i, value.f_cos);
      out.store<1>(i, value.pdf);
    }
  }

 private:
  using Terms = lanes::PairTerms<Masked, F>;

  template <class S>
  static VNDF_INLINE Terms terms_of(const Vec3<F>& wo, const Vec3<F>& wi, const S& shape) {
    if constexpr (bounded)
      return lanes::reflection_terms_bounded<Masked>(wo, wi, shape);
    else
      return lanes::reflection_terms<Masked>(wo, wi, shape);
  }

  Staged<Terms> terms_;
};

template <class Surface>
class NormalDensity {
 public:
  static constexpr std::size_t kLanes = kBlock;
  Surface surface;

  template <std::size_t N>
  VNDF_INLINE void operator()(const Inputs<N>& in, const Outputs<1>& pdf, std::size_t n) {
    surface.prepare(in, n);
    for (std::size_t i = 0; i < n; i += kWidth)
      terms_.store(i, normal_terms(load_wo(in, i), load_second(in, i), surface.shape.for_pair(in, i)));
    for (std::size_t i = 0; i < n; i += kWidth)
      pdf.store<0>(i, lanes::visible_normal_pdf(in.template load<5>(i), terms_.load(i)));
  }

 private:
  Staged<lanes::NormalTerms<F>> terms_;
};

}  // namespace
