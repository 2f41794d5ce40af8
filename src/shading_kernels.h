// The kernels of the shading step: reflection and refraction at visible normals, and densities.
#pragma once

namespace {

using lanes::Facet;

/// The stages of the shading step hand one another more than those of the normals do: half a block at a time keeps it
/// in the first-level cache.
constexpr std::size_t kShadingBlock = kBlock / 2;
template <class T>
using StagedForShading = Staged<T, kShadingBlock>;

template <Warp warp>
constexpr DiskMap kDiskMap = warp == Warp::polar ? DiskMap::polar : DiskMap::concentric;

/// Visible normals from the disk, as Heitz 2018 lays it on the hemisphere.
template <Warp warp, class View, class Shapes>
class FacetsOnDisk {
 public:
  template <std::size_t N>
  VNDF_INLINE void sample(const Inputs<N>& in, const Shapes& shapes, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i += kWidth) {
      in.template prefetch<0, 1>(i);
      points_.store(i, map_disk<kDiskMap<warp>>(load_u(in, i)));
    }
    for (std::size_t i = begin; i < end; i += kWidth) {
      in.template prefetch<2>(i);
      stretched_.prepare(in, shapes, i);
      chords_.store(i, chord(points_.load(i)));
    }
    for (std::size_t i = begin; i < end; i += kWidth) {
      in.template prefetch<3, 4>(i);
      Vec3<F> h = stretched_.load(in, shapes, i);
      Stretched view;
      view.hemisphere = map_to_hemisphere(h, view.length);
      views_.store(i, view);
      if constexpr (!kUpright) areas_.store(i, {lune_area(h, view.hemisphere, view.length)});
    }
    for (std::size_t i = begin; i < end; i += kWidth) {
      in.template prefetch<5, 6>(i);
      Stretched view = views_.load(i);
      facets_.store(i, sample_on_chord(view.hemisphere, view.length, chords_.load(i)));
    }
  }
  VNDF_INLINE Facet<F> load(std::size_t i, F wo_z) const {
    auto view = views_.load(i);
    F area = view.length + wo_z;
    if constexpr (!kUpright) area = areas_.load(i).area;
    return facet_of(facets_.load(i), view.length, area);
  }

 private:
  static constexpr bool kUpright = lanes::kUpright<typename Shapes::Type>;
  struct Stretched {
    lanes::HemisphereView<F> hemisphere;
    F length;
  };
  struct Area {
    F area;
  };
  StagedForShading<Area> areas_;  // of what leans
  StretchedViews<Shapes, View, kShadingBlock> stretched_;
  StagedForShading<lanes::DiskPoint<F>> points_;
  StagedForShading<lanes::Chord<F>> chords_;
  StagedForShading<Stretched> views_;
  StagedForShading<lanes::ChordFacet<F>> facets_;
};

/// Visible normals from a spherical cap, on which the warp lays the square, or the disk by Lambert's map.
template <Warp warp, bool bounded, class View, class Shapes>
class FacetsOnCap {
 public:
  template <std::size_t N>
  VNDF_INLINE void sample(const Inputs<N>& in, const Shapes& shapes, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i += kWidth) {
      in.template prefetch<0, 1, 2, 5, 6>(i);
      Vec2<F> u = load_u(in, i);
      if constexpr (warp == Warp::spherical_cap) {
        facets_.store(i, facet(in, shapes, i, u.y, F(1.f) - u.y, lanes::sincos2pi(u.x)));
      } else {
        auto t = map_disk<kDiskMap<warp>>(u);
        facets_.store(i, facet(in, shapes, i, t.r2, t.e, t.phi));
      }
    }
  }
  VNDF_INLINE Facet<F> load(std::size_t i, F) const { return facet_of(facets_.load(i)); }

 private:
  template <std::size_t N>
  static VNDF_INLINE lanes::CapFacet<F> facet(const Inputs<N>& in, const Shapes& shapes, std::size_t i, F r2, F e,
                                              const lanes::Angle<F>& phi) {
    Vec3<F> wo = View::view(in, i);
    auto shape = shapes.load(in, i);
    if constexpr (bounded)
      return sample_bounded_cap(wo, shape, r2, e, phi);
    else
      return sample_visible_cap(wo, shape, r2, e, phi);
  }
  StagedForShading<lanes::CapFacet<F>> facets_;
};

template <Warp warp, bool bounded, class View, class Shapes = AlphaColumns<3>>
using Facets = std::conditional_t<bounded || warp == Warp::spherical_cap, FacetsOnCap<warp, bounded, View, Shapes>,
                                  FacetsOnDisk<warp, View, Shapes>>;

template <Masking masking>
using MaskingOf = std::conditional_t<masking == Masking::height_correlated, lanes::HeightCorrelated, lanes::Separable>;

/// The end of the half of a block that begins at `from`.
VNDF_INLINE std::size_t end_of_half(std::size_t from, std::size_t end) {
  return end - from < kShadingBlock ? end : from + kShadingBlock;
}

template <std::size_t C, std::size_t M>
VNDF_INLINE void store_if_wanted(const Outputs<M>& out, std::size_t i, F value) {
  if (out.column[C]) out.template store<C>(i, value);
}

/// No output is written before the last stage: it may lie over an input.
template <Warp warp, bool bounded, class Masked, class Shapes = AlphaColumns<3>>
class ReflectionKernel {
 public:
  Shapes shapes;

  template <std::size_t N>
  VNDF_INLINE void operator()(const Inputs<N>& in, const Outputs<9>& out, std::size_t begin, std::size_t end) {
    bool with_normals = out.column[5] || out.column[6] || out.column[7] || out.column[8];
    for (std::size_t to; begin < end; begin = to) {
      to = end_of_half(begin, end);
      shapes.prepare(in, begin, to);
      facets_.sample(in, shapes, begin, to);
      if (with_normals)
        shade<true>(in, out, begin, to);
      else
        shade<false>(in, out, begin, to);
    }
  }

 private:
  template <bool with_normals, std::size_t N>
  VNDF_INLINE void shade(const Inputs<N>& in, const Outputs<9>& out, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i += kWidth) {
      Vec3<F> wo = load_wo(in, i);
      auto shape = shapes.load(in, i);
      auto facet = facets_.load(i, wo.z);
      auto normal = normal_of(facet, shape);
      directions_.store(i, {reflect(wo, facet, normal), spread(facet, normal, shape)});
      if constexpr (with_normals) normals_.store(i, unit_normal(facet, normal));
    }
    for (std::size_t i = begin; i < end; i += kWidth) {
      F wo_z = in.template load<2>(i);
      auto facet = facets_.load(i, wo_z);
      auto direction = directions_.load(i);
      auto sample = lanes::weigh_reflection<Masked>(wo_z, shapes.load(in, i), facet.length, facet.area, direction.wi,
                                                    direction.spread);
      if constexpr (with_normals) {
        auto normal = normals_.load(i);
        store_if_wanted<5>(out, i, normal.wm.x);
        store_if_wanted<6>(out, i, normal.wm.y);
        store_if_wanted<7>(out, i, normal.wm.z);
        store_if_wanted<8>(out, i, normal.cos);
      }
      out.store<0>(i, sample.wi.x);
      out.store<1>(i, sample.wi.y);
      out.store<2>(i, sample.wi.z);
      out.store<3>(i, sample.pdf);
      out.store<4>(i, sample.weight);
    }
  }

  struct Direction {
    Vec3<F> wi;
    F spread;
  };
  Facets<warp, bounded, AsGiven, Shapes> facets_;
  StagedForShading<Direction> directions_;
  StagedForShading<lanes::UnitNormal<F>> normals_;
};

template <Warp warp, bool bounded, Masking masking>
void sample_reflection(std::size_t count, const Columns3& wo, const Columns2& alpha, const Columns2& u,
                       const ReflectionSamples& out) noexcept {
  ReflectionKernel<warp, bounded, MaskingOf<masking>> kernel;
  for_each_block<7, 9>(count, {&wo.x, &wo.y, &wo.z, &alpha.x, &alpha.y, &u.x, &u.y},
                       {out.wi.x, out.wi.y, out.wi.z, out.pdf, out.weight, out.wm.x, out.wm.y, out.wm.z, out.wo_dot_wm},
                       kernel);
}

/// The light or the normal, second of a pair.
template <std::size_t N>
VNDF_INLINE Vec3<F> load_second(const Inputs<N>& in, std::size_t i) {
  return {in.template load<3>(i), in.template load<4>(i), in.template load<5>(i)};
}

template <bool bounded, class Masked, class Shapes = AlphaColumns<6>>
struct ReflectionEvaluation {
  Shapes shapes;

  template <std::size_t N>
  VNDF_INLINE void operator()(const Inputs<N>& in, const Outputs<2>& out, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i += kWidth) {
      shapes.prepare(in, i, i + kWidth);
      auto value = evaluate(load_wo(in, i), load_second(in, i), shapes.at(in, i));
      out.store<0>(i, value.f_cos);
      out.store<1>(i, value.pdf);
    }
  }
  template <class S>
  static VNDF_INLINE lanes::Evaluation<F> evaluate(const Vec3<F>& wo, const Vec3<F>& wi, const S& shape) {
    if constexpr (bounded)
      return lanes::evaluate_reflection_bounded<Masked>(wo, wi, shape);
    else
      return lanes::evaluate_reflection<Masked>(wo, wi, shape);
  }
};

template <bool bounded, Masking masking>
void evaluate_reflection(std::size_t count, const Columns3& wo, const Columns3& wi, const Columns2& alpha,
                         const Evaluations& out) noexcept {
  ReflectionEvaluation<bounded, MaskingOf<masking>> kernel;
  for_each_block<8, 2>(count, {&wo.x, &wo.y, &wo.z, &wi.x, &wi.y, &wi.z, &alpha.x, &alpha.y}, {out.f_cos, out.pdf},
                       kernel);
}

template <class Shapes = AlphaColumns<6>>
struct NormalDensity {
  Shapes shapes;

  template <std::size_t N>
  VNDF_INLINE void operator()(const Inputs<N>& in, const Outputs<1>& pdf, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i += kWidth) {
      shapes.prepare(in, i, i + kWidth);
      pdf.store<0>(i, lanes::visible_normal_pdf(load_wo(in, i), load_second(in, i), shapes.at(in, i)));
    }
  }
};

void pdf_normals(std::size_t count, const Columns3& wo, const Columns3& wm, const Columns2& alpha,
                 float* pdf) noexcept {
  NormalDensity<> kernel;
  for_each_block<8, 1>(count, {&wo.x, &wo.y, &wo.z, &wm.x, &wm.y, &wm.z, &alpha.x, &alpha.y}, {pdf}, kernel);
}

template <Warp warp, class Masked, class Shapes = AlphaColumns<3>>
class DielectricKernel {
 public:
  Shapes shapes;

  template <std::size_t N>
  VNDF_INLINE void operator()(const Inputs<N>& in, const Outputs<6>& out, std::size_t begin, std::size_t end) {
    for (std::size_t to; begin < end; begin = to) {
      to = end_of_half(begin, end);
      shapes.prepare(in, begin, to);
      facets_.sample(in, shapes, begin, to);
      for (std::size_t i = begin; i < to; i += kWidth) {
        in.template prefetch<3, 4, 7, 8>(i);
        Vec3<F> wo = load_wo(in, i);
        auto below = wo.z < F(0.f);
        wo = lanes::turned(below, wo);
        auto sample =
            lanes::sample_dielectric<Masked>(wo, shapes.load(in, i), facets_.load(i, wo.z),
                                             lanes::turned_eta(below, in.template load<7>(i)), in.template load<8>(i));
        Vec3<F> wi = lanes::turned(below, sample.wi);
        out.store<0>(i, wi.x);
        out.store<1>(i, wi.y);
        out.store<2>(i, wi.z);
        out.store<3>(i, sample.pdf);
        out.store<4>(i, sample.weight);
        out.store<5>(i, sample.side);
      }
    }
  }

 private:
  Facets<warp, false, TurnedUp, Shapes> facets_;
};

template <Warp warp, Masking masking>
void sample_dielectric(std::size_t count, const Columns3& wo, const Columns2& alpha, const Column& eta,
                       const Columns3& u, const DielectricSamples& out) noexcept {
  DielectricKernel<warp, MaskingOf<masking>> kernel;
  for_each_block<9, 6>(count, {&wo.x, &wo.y, &wo.z, &alpha.x, &alpha.y, &u.x, &u.y, &eta, &u.z},
                       {out.wi.x, out.wi.y, out.wi.z, out.pdf, out.weight, out.side}, kernel);
}

template <class Masked, class Shapes = AlphaColumns<6>>
struct DielectricEvaluation {
  Shapes shapes;

  template <std::size_t N>
  VNDF_INLINE void operator()(const Inputs<N>& in, const Outputs<2>& out, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i += kWidth) {
      shapes.prepare(in, i, i + kWidth);
      Vec3<F> wo = load_wo(in, i);
      auto below = wo.z < F(0.f);
      auto value =
          lanes::evaluate_dielectric<Masked>(lanes::turned(below, wo), lanes::turned(below, load_second(in, i)),
                                             shapes.at(in, i), lanes::turned_eta(below, in.template load<8>(i)));
      out.store<0>(i, value.f_cos);
      out.store<1>(i, value.pdf);
    }
  }
};

template <Masking masking>
void evaluate_dielectric(std::size_t count, const Columns3& wo, const Columns3& wi, const Columns2& alpha,
                         const Column& eta, const Evaluations& out) noexcept {
  DielectricEvaluation<MaskingOf<masking>> kernel;
  for_each_block<9, 2>(count, {&wo.x, &wo.y, &wo.z, &wi.x, &wi.y, &wi.z, &alpha.x, &alpha.y, &eta},
                       {out.f_cos, out.pdf}, kernel);
}

// The warps' kernels of one variant.
#define VNDF_PER_WARP(function, ...)                                                 \
  {                                                                                  \
    ::function<Warp::polar, __VA_ARGS__>, ::function<Warp::concentric, __VA_ARGS__>, \
        ::function<Warp::spherical_cap, __VA_ARGS__>                                 \
  }

}  // namespace
