// The kernels of the dielectric: reflection or refraction at visible normals, and its density.
#pragma once

namespace {

/// The index on the other side, seen from the view's.
template <std::size_t C, std::size_t N>
VNDF_INLINE F eta_facing_up(const Inputs<N>& in, std::size_t i) {
  return lanes::mirrored_eta(in.template load<2>(i) < F(0.f), in.template load<C>(i));
}

template <Warp warp, class Masked, class Surface>
class DielectricKernel {
 public:
  static constexpr std::size_t kLanes = kShadingBlock;
  Surface surface;

  template <std::size_t N>
  VNDF_INLINE void operator()(const Inputs<N>& in, const Outputs<6>& out, std::size_t n) {
    surface.prepare(in, n);
    facets_.sample(in, surface, n);
    for (std::size_t i = 0; i < n; i += kWidth) etas_.store(i, eta_facing_up<7>(in, i));
    for (std::size_t i = 0; i < n; i += kWidth) {
      in.template prefetch<3, 4>(i);
      Vec3<F> wo = FacingUp::view(surface.frame.wo(in, i));
      const auto& shape = surface.shape.load(in, i);
      auto facet = facets_.load(i, wo.z);
      auto normal = normal_of(facet, shape);
      directions_.store(i, {reflect(wo, facet, normal), spread(facet, normal, shape)});
      normals_.store(i, unit_normal(facet, normal));
    }
    for (std::size_t i = 0; i < n; i += kWidth) {
      in.template prefetch<7, 8>(i);
      cosines_.store(i, lanes::cosines(normals_.load(i).cos, etas_.load(i)));
    }
    for (std::size_t i = 0; i < n; i += kWidth) {
      crossings_.store(i, choose_side(cosines_.load(i), etas_.load(i), in.template load<8>(i)));
    }
    for (std::size_t i = 0; i < n; i += kWidth) {
      auto direction = directions_.load(i);
      Vec3<F> wi = leave(FacingUp::view(surface.frame.wo(in, i)), direction.wi, normals_.load(i).wm, crossings_.load(i),
                         etas_.load(i));
      directions_.store(i, {wi, direction.spread});
    }
    for (std::size_t i = 0; i < n; i += kWidth)
      lights_.store(i, lanes::dielectric_light<Masked>(crossings_.load(i).side, directions_.load(i).wi,
                                                       surface.shape.load(in, i)));
    for (std::size_t i = 0; i < n; i += kWidth) {
      F wo_z = in.template load<2>(i);
      auto below = wo_z < F(0.f);
      wo_z = op::abs(wo_z);
      auto facet = facets_.load(i, wo_z);
      auto direction = directions_.load(i);
      auto at = crossings_.load(i);
      auto weighed = lanes::weigh_dielectric<Masked>(wo_z, facet.length, facet.area, direction.wi.z, direction.spread,
                                                     at, lights_.load(i));
      Vec3<F> wi = turn_back(lanes::mirrored(below, direction.wi), surface.frame.theta_z(i));
      out.store<0>(i, wi.x);
      out.store<1>(i, wi.y);
      out.store<2>(i, wi.z);
      out.store<3>(i, weighed.pdf);
      out.store<4>(i, weighed.weight);
      out.store<5>(i, at.side);
    }
  }

 private:
  Facets<warp, false, FacingUp, Surface> facets_;
  StagedForShading<Direction> directions_;
  StagedForShading<lanes::UnitNormal<F>> normals_;
  StagedForShading<F> etas_;
  StagedForShading<lanes::Cosines<F>> cosines_;
  StagedForShading<lanes::Crossing<F>> crossings_;
  StagedForShading<typename Masked::template Light<F>> lights_;
};

template <class Masked, class Surface>
class DielectricEvaluation {
 public:
  static constexpr std::size_t kLanes = kShadingBlock;
  Surface surface;

  template <std::size_t N>
  VNDF_INLINE void operator()(const Inputs<N>& in, const Outputs<2>& out, std::size_t n) {
    surface.prepare(in, n);
    for (std::size_t i = 0; i < n; i += kWidth) etas_.store(i, eta_facing_up<8>(in, i));
    for (std::size_t i = 0; i < n; i += kWidth) {
      auto below = in.template load<2>(i) < F(0.f);
      terms_.store(i, lanes::dielectric_terms<Masked>(lanes::mirrored(below, load_wo(in, i)),
                                                      lanes::mirrored(below, load_second(in, i)),
                                                      surface.shape.for_pair(in, i), etas_.load(i)));
    }
    for (std::size_t i = 0; i < n; i += kWidth) cosines_.store(i, cosines_of(terms_.load(i), etas_.load(i)));
    for (std::size_t i = 0; i < n; i += kWidth)
      crossings_.store(i, crossing_of(wi_z(in, i), terms_.load(i), cosines_.load(i), etas_.load(i)));
    for (std::size_t i = 0; i < n; i += kWidth) {
      auto value = lanes::evaluate_crossing(op::abs(in.template load<2>(i)), wi_z(in, i), terms_.load(i).pair,
                                            crossings_.load(i));
      out.store<0>(i, value.f_cos);
      out.store<1>(i, value.pdf);
    }
  }

 private:
  template <std::size_t N>
  static VNDF_INLINE F wi_z(const Inputs<N>& in, std::size_t i) {
    F z = in.template load<5>(i);
    return op::select(in.template load<2>(i) < F(0.f), F(0.f) - z, z);
  }

  StagedForShading<F> etas_;
  StagedForShading<lanes::DielectricTerms<Masked, F>> terms_;
  StagedForShading<lanes::Cosines<F>> cosines_;
  StagedForShading<lanes::Crossing<F>> crossings_;
};

}  // namespace
