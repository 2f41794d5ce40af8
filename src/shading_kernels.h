// The kernels of the shading step: reflection at visible normals, and densities.
#pragma once

namespace {

using lanes::Facet;

/// A block's visible normals, from the disk as Heitz 2018 lays it on the hemisphere.
template <Warp warp, bool bounded>
class FacetsOnDisk {
 public:
  VNDF_INLINE void sample(const SampleInputs& in, std::size_t begin, std::size_t end) {
    constexpr DiskMap map = warp == Warp::polar ? DiskMap::polar : DiskMap::concentric;
    for (std::size_t i = begin; i < end; i += kWidth) points_.store(i, map_disk<map>(load_u(in, i)));
    for (std::size_t i = begin; i < end; i += kWidth) chords_.store(i, chord(points_.load(i)));
    for (std::size_t i = begin; i < end; i += kWidth) {
      View view;
      view.hemisphere = map_to_hemisphere(load_wo(in, i), load_alpha(in, i), view.length);
      views_.store(i, view);
    }
    for (std::size_t i = begin; i < end; i += kWidth) {
      View view = views_.load(i);
      facets_.store(i, sample_on_chord(view.hemisphere, view.length, chords_.load(i)));
    }
  }
  VNDF_INLINE Facet<F> load(std::size_t i, F wo_z) const {
    return facet_of(facets_.load(i), wo_z, views_.load(i).length);
  }

 private:
  struct View {
    lanes::HemisphereView<F> hemisphere;
    F length;
  };
  Staged<lanes::DiskPoint<F>> points_;
  Staged<lanes::Chord<F>> chords_;
  Staged<View> views_;
  Staged<lanes::ChordFacet<F>> facets_;
};

/// A block's visible normals from a spherical cap, on which the warp lays the square or the disk.
template <Warp warp, bool bounded>
class FacetsOnCap {
 public:
  VNDF_INLINE void sample(const SampleInputs& in, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i += kWidth) {
      Vec3<F> wo = load_wo(in, i);
      Vec2<F> alpha = load_alpha(in, i);
      Vec2<F> u = load_u(in, i);
      if constexpr (warp == Warp::spherical_cap) {
        facets_.store(i, facet(wo, alpha, u.y, F(1.f) - u.y, lanes::sincos2pi(u.x)));
      } else {
        constexpr DiskMap map = warp == Warp::polar ? DiskMap::polar : DiskMap::concentric;
        auto t = map_disk<map>(u);
        facets_.store(i, facet(wo, alpha, t.r2, t.e, t.phi));
      }
    }
  }
  VNDF_INLINE Facet<F> load(std::size_t i, F) const { return facet_of(facets_.load(i)); }

 private:
  static VNDF_INLINE lanes::CapFacet<F> facet(Vec3<F> wo, Vec2<F> alpha, F r2, F e, const lanes::Angle<F>& phi) {
    return bounded ? sample_bounded_cap(wo, alpha, r2, e, phi) : sample_visible_cap(wo, alpha, r2, e, phi);
  }
  Staged<lanes::CapFacet<F>> facets_;
};

template <Warp warp, bool bounded>
using Facets =
    std::conditional_t<bounded || warp == Warp::spherical_cap, FacetsOnCap<warp, bounded>, FacetsOnDisk<warp, bounded>>;

template <Masking masking>
using MaskingOf =
    std::conditional_t<masking == Masking::height_correlated, lanes::HeightCorrelated, lanes::Separable>;

/// Stores to an output that may be a null pointer, which is not wanted.
VNDF_INLINE void store_if_wanted(F value, float* out, std::size_t i) {
  if (out) lanes::op::store(value, out + i);
}

template <Warp warp, bool bounded, Masking masking>
struct ReflectionKernel {
  Facets<warp, bounded> facets;

  VNDF_INLINE void operator()(const SampleInputs& in, const Outputs<9>& out, std::size_t begin, std::size_t end) {
    facets.sample(in, begin, end);
    if (out.column[5] || out.column[6] || out.column[7] || out.column[8])
      shade<true>(in, out, begin, end);
    else
      shade<false>(in, out, begin, end);
  }

  struct Dir { Vec3<F> wi; F inverse; };
  Staged<Dir> dirs;
  template <bool with_normal>
  VNDF_INLINE void shade(const SampleInputs& in, const Outputs<9>& out, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i += kWidth) {
      Vec2<F> alpha = load_alpha(in, i);
      auto wo = load_wo(in, i);
      auto facet = facets.load(i, wo.z);
      auto normal = normal_of(facet, alpha);
      dirs.store(i, {reflect(wo, facet, normal), spread(facet, normal, alpha)});
    }
    for (std::size_t i = begin; i < end; i += kWidth) {
      Vec2<F> alpha = load_alpha(in, i);
      auto facet = facets.load(i, in.load<2>(i));
      auto dir = dirs.load(i);
      auto sample = lanes::shade_reflection<MaskingOf<masking>>(in.load<2>(i), alpha, facet.length, facet.area, dir.wi, dir.inverse);
      out.store<0>(i, sample.wi.x);
      out.store<1>(i, sample.wi.y);
      out.store<2>(i, sample.wi.z);
      out.store<3>(i, sample.pdf);
      out.store<4>(i, sample.weight);
    }
  }
};

template <Warp warp, bool bounded, Masking masking>
void sample_reflection(std::size_t count, const Columns3& wo, const Columns2& alpha, const Columns2& u,
                       const ReflectionSamples& out) noexcept {
  ReflectionKernel<warp, bounded, masking> kernel;
  for_each_block<7, 9>(
      count, {&wo.x, &wo.y, &wo.z, &alpha.x, &alpha.y, &u.x, &u.y},
      {out.wi.x, out.wi.y, out.wi.z, out.pdf, out.weight, out.wm.x, out.wm.y, out.wm.z, out.wo_dot_wm}, kernel);
}

template <bool bounded, Masking masking>
struct EvaluationKernel {
  VNDF_INLINE void operator()(const Inputs<8>& in, const Outputs<2>& out, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i += kWidth) {
      Vec3<F> wo = {in.load<0>(i), in.load<1>(i), in.load<2>(i)};
      Vec3<F> wi = {in.load<3>(i), in.load<4>(i), in.load<5>(i)};
      Vec2<F> alpha = {in.load<6>(i), in.load<7>(i)};
      F length = stretched_length(wo, alpha);
      F area = length + (bounded ? reflection_bound(wo, alpha).k * wo.z : wo.z);
      auto value = lanes::evaluate_reflection<MaskingOf<masking>>(wo, wi, alpha, length, area);
      out.store<0>(i, value.f_cos);
      out.store<1>(i, value.pdf);
    }
  }
};

template <bool bounded, Masking masking>
void evaluate_reflection(std::size_t count, const Columns3& wo, const Columns3& wi, const Columns2& alpha,
                         const Evaluations& out) noexcept {
  EvaluationKernel<bounded, masking> kernel;
  for_each_block<8, 2>(count, {&wo.x, &wo.y, &wo.z, &wi.x, &wi.y, &wi.z, &alpha.x, &alpha.y}, {out.f_cos, out.pdf}, kernel);
}

struct NormalDensityKernel {
  VNDF_INLINE void operator()(const Inputs<8>& in, const Outputs<1>& pdf, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i += kWidth)
      pdf.store<0>(i, lanes::visible_normal_pdf<F>({in.load<0>(i), in.load<1>(i), in.load<2>(i)},
                                                   {in.load<3>(i), in.load<4>(i), in.load<5>(i)},
                                                   {in.load<6>(i), in.load<7>(i)}));
  }
};

void pdf_normals(std::size_t count, const Columns3& wo, const Columns3& wm, const Columns2& alpha,
                 float* pdf) noexcept {
  NormalDensityKernel kernel;
  for_each_block<8, 1>(count, {&wo.x, &wo.y, &wo.z, &wm.x, &wm.y, &wm.z, &alpha.x, &alpha.y}, {pdf}, kernel);
}

}  // namespace
