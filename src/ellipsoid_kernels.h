// The kernels of ellipsoid.h: those of plain GGX, with other shapes.
#pragma once

namespace {

// A kind of surfaces, for sampling and for given pairs of directions: which columns the kernels read besides those of
// the function. The alpha of one shape is not read, and any column stands for it.
struct OneShapes {
  using Masked = lanes::Lunes;
  template <std::size_t kAlpha, std::size_t kTheta, std::size_t kLanes, class T>
  using Surfaces = Surface<GivenFrame, OneShape<T>>;
  template <std::size_t kAlpha, std::size_t kTheta>
  using ForPairs = Surface<GivenFrame, OneShapeForPairs>;

  template <class Kernel, std::size_t N, std::size_t M>
  static VNDF_INLINE void run(std::size_t count, const Column* const (&columns)[N], const Shape& shape,
                              float* const (&results)[M]) {
    Kernel kernel;
    kernel.surface.shape.set(shape);
    for_each_block<N, M>(count, columns, results, kernel);
  }
  static VNDF_INLINE Columns2 alpha(const Shape&) { return {0.f, 0.f}; }
};

/// kAngles are the columns of Ellipsoid that are read.
template <Column Ellipsoid::*... kAngles>
struct EllipsoidColumns {
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
  using Masked = lanes::Separable;  // what eq. 6 is without theta_x and theta_y
  template <std::size_t kAlpha, std::size_t kTheta, std::size_t kLanes, class T>
  using Surfaces = Surface<TurnedFrame<kTheta, kLanes, T>, AlphaColumns<kAlpha>>;
  template <std::size_t kAlpha, std::size_t kTheta>
  using ForPairs = Surface<GivenFrame, TurnedColumns<kAlpha, kTheta>>;
};
struct AllTilted : EllipsoidColumns<&Ellipsoid::theta_x, &Ellipsoid::theta_y, &Ellipsoid::theta_z> {
  using Masked = lanes::Lunes;
  template <std::size_t kAlpha, std::size_t kTheta, std::size_t kLanes, class T>
  using Surfaces = Surface<GivenFrame, TiltedColumns<kAlpha, kTheta, kLanes, T>>;
  template <std::size_t kAlpha, std::size_t kTheta>
  using ForPairs = Surface<GivenFrame, TiltedColumns<kAlpha, kTheta, kBlock, lanes::Split<F>>>;
};

template <Warp warp, class Surface>
using Normals =
    std::conditional_t<warp == Warp::spherical_cap, NormalsOnCap<Surface>, NormalsOnDisk<kDiskMap<warp>, Surface>>;

/// See sample_normal_cap.
template <Warp warp>
using Elements = std::conditional_t<warp == Warp::spherical_cap, F, lanes::Split<F>>;

template <class Kind, Warp warp, class S>
void sample_normals_of(std::size_t count, const Columns3& wo, const S& shape, const Columns2& u,
                       const Out3& wm) noexcept {
  const Columns2& alpha = Kind::alpha(shape);
  Kind::template run<Normals<warp, typename Kind::template Surfaces<3, 7, kBlock, Elements<warp>>>>(
      count, {&wo.x, &wo.y, &wo.z, &alpha.x, &alpha.y, &u.x, &u.y}, shape, {wm.x, wm.y, wm.z});
}

template <class Kind, Warp warp, class S>
void sample_reflection_of(std::size_t count, const Columns3& wo, const S& shape, const Columns2& u,
                          const ReflectionSamples& out) noexcept {
  const Columns2& alpha = Kind::alpha(shape);
  Kind::template run<ReflectionKernel<warp, false, typename Kind::Masked,
                                      typename Kind::template Surfaces<3, 7, kShadingBlock, Elements<warp>>>>(
      count, {&wo.x, &wo.y, &wo.z, &alpha.x, &alpha.y, &u.x, &u.y}, shape,
      {out.wi.x, out.wi.y, out.wi.z, out.pdf, out.weight, out.wm.x, out.wm.y, out.wm.z, out.wo_dot_wm});
}

template <class Kind, class S>
void evaluate_reflection_of(std::size_t count, const Columns3& wo, const Columns3& wi, const S& shape,
                            const Evaluations& out) noexcept {
  const Columns2& alpha = Kind::alpha(shape);
  Kind::template run<ReflectionEvaluation<false, typename Kind::Masked, typename Kind::template ForPairs<6, 8>>>(
      count, {&wo.x, &wo.y, &wo.z, &wi.x, &wi.y, &wi.z, &alpha.x, &alpha.y}, shape, {out.f_cos, out.pdf});
}

template <class Kind, Warp warp, class S>
void sample_dielectric_of(std::size_t count, const Columns3& wo, const S& shape, const Column& eta, const Columns3& u,
                          const DielectricSamples& out) noexcept {
  const Columns2& alpha = Kind::alpha(shape);
  Kind::template run<DielectricKernel<warp, typename Kind::Masked,
                                      typename Kind::template Surfaces<3, 9, kShadingBlock, Elements<warp>>>>(
      count, {&wo.x, &wo.y, &wo.z, &alpha.x, &alpha.y, &u.x, &u.y, &eta, &u.z}, shape,
      {out.wi.x, out.wi.y, out.wi.z, out.pdf, out.weight, out.side});
}

template <class Kind, class S>
void evaluate_dielectric_of(std::size_t count, const Columns3& wo, const Columns3& wi, const S& shape,
                            const Column& eta, const Evaluations& out) noexcept {
  const Columns2& alpha = Kind::alpha(shape);
  Kind::template run<DielectricEvaluation<typename Kind::Masked, typename Kind::template ForPairs<6, 9>>>(
      count, {&wo.x, &wo.y, &wo.z, &wi.x, &wi.y, &wi.z, &alpha.x, &alpha.y, &eta}, shape, {out.f_cos, out.pdf});
}

template <class Kind, class S>
void pdf_normals_of(std::size_t count, const Columns3& wo, const Columns3& wm, const S& shape, float* pdf) noexcept {
  const Columns2& alpha = Kind::alpha(shape);
  Kind::template run<NormalDensity<typename Kind::template ForPairs<6, 8>>>(
      count, {&wo.x, &wo.y, &wo.z, &wm.x, &wm.y, &wm.z, &alpha.x, &alpha.y}, shape, {pdf});
}

// The functions for shapes of one kind.
#define VNDF_SHAPE_KERNELS(kind, S)                                                                       \
  {                                                                                                       \
    {::sample_normals_of<kind, Warp::polar, S>, ::sample_normals_of<kind, Warp::concentric, S>,           \
     ::sample_normals_of<kind, Warp::spherical_cap, S>},                                                  \
        {::sample_reflection_of<kind, Warp::polar, S>, ::sample_reflection_of<kind, Warp::concentric, S>, \
         ::sample_reflection_of<kind, Warp::spherical_cap, S>},                                           \
        ::evaluate_reflection_of<kind, S>, ::pdf_normals_of<kind, S>,                                     \
        {::sample_dielectric_of<kind, Warp::polar, S>, ::sample_dielectric_of<kind, Warp::concentric, S>, \
         ::sample_dielectric_of<kind, Warp::spherical_cap, S>},                                           \
        ::evaluate_dielectric_of<kind, S>                                                                 \
  }

}  // namespace
