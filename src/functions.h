// The batch functions: kernels over the kinds of surfaces that there are.
#pragma once

namespace {

// A kind: what the caller gives for the surface, S; Surfaces and ForPairs, which the kernels get for sampling and for
// given pairs of directions; and how a kernel is run, over which columns besides those of the function. All have those
// of alpha, which one shape does not read: any column stands for it.

struct Plain {
  using S = Columns2;
  template <std::size_t kAlpha, std::size_t kTheta, std::size_t kLanes>
  using Surfaces = Surface<GivenFrame, AlphaColumns<kAlpha>>;
  template <std::size_t kAlpha, std::size_t kTheta>
  using ForPairs = Surface<GivenFrame, AlphaColumns<kAlpha>>;

  template <class Kernel, std::size_t N, std::size_t M>
  static VNDF_INLINE void run(std::size_t count, const Column* const (&columns)[N], const Columns2&,
                              float* const (&results)[M]) {
    Kernel kernel;
    for_each_block<N, M>(count, columns, results, kernel);
  }
  static VNDF_INLINE const Columns2& alpha(const Columns2& alpha) { return alpha; }
};

struct OneShapes {
  using S = Shape;
  template <std::size_t kAlpha, std::size_t kTheta, std::size_t kLanes>
  using Surfaces = Surface<GivenFrame, OneShape>;
  template <std::size_t kAlpha, std::size_t kTheta>
  using ForPairs = Surface<GivenFrame, OneShapeForPairs>;

  template <class Kernel, std::size_t N, std::size_t M>
  static VNDF_INLINE void run(std::size_t count, const Column* const (&columns)[N], const Shape& shape,
                              float* const (&results)[M]) {
    Kernel kernel;
    kernel.surface.shape.set(shape);
    for_each_block<N, M>(count, columns, results, kernel);
  }
  // A constant expression: a call of Column's constructor could be what another set's object is linked to.
  static constexpr Columns2 kNoAlpha{0.f, 0.f};
  static VNDF_INLINE const Columns2& alpha(const Shape&) { return kNoAlpha; }
};

/// kAngles are the columns of Ellipsoid that are read.
template <Column Ellipsoid::*... kAngles>
struct EllipsoidColumns {
  using S = Ellipsoid;
  template <class Kernel, std::size_t N, std::size_t M>
  static VNDF_INLINE void run(std::size_t count, const Column* const (&columns)[N], const Ellipsoid& ellipsoid,
                              float* const (&results)[M]) {
    const Column* all[N + sizeof...(kAngles)];
    std::size_t c = 0;
    for (const Column* column : columns) all[c++] = column;
    ((all[c++] = &(ellipsoid.*kAngles)), ...);
    Kernel kernel;
    for_each_block<N + sizeof...(kAngles), M>(count, all, results, kernel);
  }
  static VNDF_INLINE const Columns2& alpha(const Ellipsoid& ellipsoid) { return ellipsoid.alpha; }
};
struct AllTurned : EllipsoidColumns<&Ellipsoid::theta_z> {
  template <std::size_t kAlpha, std::size_t kTheta, std::size_t kLanes>
  using Surfaces = Surface<TurnedFrame<kTheta, kLanes>, AlphaColumns<kAlpha>>;
  template <std::size_t kAlpha, std::size_t kTheta>
  using ForPairs = Surface<GivenFrame, TurnedColumns<kAlpha, kTheta>>;
};
struct AllTilted : EllipsoidColumns<&Ellipsoid::theta_x, &Ellipsoid::theta_y, &Ellipsoid::theta_z> {
  template <std::size_t kAlpha, std::size_t kTheta, std::size_t kLanes>
  using Surfaces = Surface<GivenFrame, TiltedColumns<kAlpha, kTheta, kLanes>>;
  template <std::size_t kAlpha, std::size_t kTheta>
  using ForPairs = Surface<GivenFrame, TiltedColumns<kAlpha, kTheta, kBlock>>;
};

template <Warp warp, class Surface>
using Normals =
    std::conditional_t<warp == Warp::spherical_cap, NormalsOnCap<Surface>, NormalsOnDisk<kDiskMap<warp>, Surface>>;

template <class Kind, Warp warp>
void sample_normals(std::size_t count, const Columns3& wo, const typename Kind::S& shape, const Columns2& u,
                    const Out3& wm) noexcept {
  const Columns2& alpha = Kind::alpha(shape);
  Kind::template run<Normals<warp, typename Kind::template Surfaces<3, 7, kBlock>>>(
      count, {&wo.x, &wo.y, &wo.z, &alpha.x, &alpha.y, &u.x, &u.y}, shape, {wm.x, wm.y, wm.z});
}

template <DiskMap map>
void sample_disk(std::size_t count, const Columns2& u, const Out2& t) noexcept {
  DiskPoints<map> kernel;
  for_each_block<2, 2>(count, {&u.x, &u.y}, {t.x, t.y}, kernel);
}

template <class Kind, class Masked, bool bounded, Warp warp>
void sample_reflection(std::size_t count, const Columns3& wo, const typename Kind::S& shape, const Columns2& u,
                       const ReflectionSamples& out) noexcept {
  const Columns2& alpha = Kind::alpha(shape);
  Kind::template run<ReflectionKernel<warp, bounded, Masked, typename Kind::template Surfaces<3, 7, kShadingBlock>>>(
      count, {&wo.x, &wo.y, &wo.z, &alpha.x, &alpha.y, &u.x, &u.y}, shape,
      {out.wi.x, out.wi.y, out.wi.z, out.pdf, out.weight, out.wm.x, out.wm.y, out.wm.z, out.wo_dot_wm});
}

template <class Kind, class Masked, bool bounded>
void evaluate_reflection(std::size_t count, const Columns3& wo, const Columns3& wi, const typename Kind::S& shape,
                         const Evaluations& out) noexcept {
  const Columns2& alpha = Kind::alpha(shape);
  Kind::template run<ReflectionEvaluation<bounded, Masked, typename Kind::template ForPairs<6, 8>>>(
      count, {&wo.x, &wo.y, &wo.z, &wi.x, &wi.y, &wi.z, &alpha.x, &alpha.y}, shape, {out.f_cos, out.pdf});
}

template <class Kind>
void pdf_normals(std::size_t count, const Columns3& wo, const Columns3& wm, const typename Kind::S& shape,
                 float* pdf) noexcept {
  const Columns2& alpha = Kind::alpha(shape);
  Kind::template run<NormalDensity<typename Kind::template ForPairs<6, 8>>>(
      count, {&wo.x, &wo.y, &wo.z, &wm.x, &wm.y, &wm.z, &alpha.x, &alpha.y}, shape, {pdf});
}

template <class Kind, class Masked, Warp warp>
void sample_dielectric(std::size_t count, const Columns3& wo, const typename Kind::S& shape, const Column& eta,
                       const Columns3& u, const DielectricSamples& out) noexcept {
  const Columns2& alpha = Kind::alpha(shape);
  Kind::template run<DielectricKernel<warp, Masked, typename Kind::template Surfaces<3, 9, kShadingBlock>>>(
      count, {&wo.x, &wo.y, &wo.z, &alpha.x, &alpha.y, &u.x, &u.y, &eta, &u.z}, shape,
      {out.wi.x, out.wi.y, out.wi.z, out.pdf, out.weight, out.side});
}

template <class Kind, class Masked>
void evaluate_dielectric(std::size_t count, const Columns3& wo, const Columns3& wi, const typename Kind::S& shape,
                         const Column& eta, const Evaluations& out) noexcept {
  const Columns2& alpha = Kind::alpha(shape);
  Kind::template run<DielectricEvaluation<Masked, typename Kind::template ForPairs<6, 9>>>(
      count, {&wo.x, &wo.y, &wo.z, &wi.x, &wi.y, &wi.z, &alpha.x, &alpha.y, &eta}, shape, {out.f_cos, out.pdf});
}

template <class Kind, class Masked, bool bounded = false>
constexpr SurfaceKernels<typename Kind::S> kernels_of() {
  constexpr Warp polar = Warp::polar, concentric = Warp::concentric, cap = Warp::spherical_cap;
  return {{::sample_normals<Kind, polar>, ::sample_normals<Kind, concentric>, ::sample_normals<Kind, cap>},
          {::sample_reflection<Kind, Masked, bounded, polar>, ::sample_reflection<Kind, Masked, bounded, concentric>,
           ::sample_reflection<Kind, Masked, bounded, cap>},
          ::evaluate_reflection<Kind, Masked, bounded>,
          ::pdf_normals<Kind>,
          {::sample_dielectric<Kind, Masked, polar>, ::sample_dielectric<Kind, Masked, concentric>,
           ::sample_dielectric<Kind, Masked, cap>},
          ::evaluate_dielectric<Kind, Masked>};
}

}  // namespace
