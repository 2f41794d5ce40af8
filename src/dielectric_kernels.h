// The kernels of the dielectric: reflection or refraction at visible normals, and its density.
#pragma once

namespace {

template <std::size_t C, std::size_t N>
VNDF_INLINE lanes::Index<F> load_index(const Inputs<N>& in, std::size_t i) {
  return lanes::index_seen(in.template load<2>(i) < F(0.f), in.template load<C>(i));
}

/// wi turned back. Straight on it is -wo to the last bit, which turning and turning back is not.
VNDF_INLINE Vec3<F> straight_or(lanes::XAxis, const lanes::Index<F>&, const Vec3<F>&, const Vec3<F>& wi) {
  return wi;
}
VNDF_INLINE Vec3<F> straight_or(const lanes::Angle<F>& theta_z, const lanes::Index<F>& index, const Vec3<F>& wo,
                                const Vec3<F>& wi) {
  auto straight = index_matched(index);
  Vec3<F> back = turn_back(wi, theta_z);
  F zero(0.f);
  return {op::select(straight, zero - wo.x, back.x), op::select(straight, zero - wo.y, back.y),
          op::select(straight, zero - wo.z, back.z)};
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
    for (std::size_t i = 0; i < n; i += kWidth) indices_.store(i, load_index<7>(in, i));
    for (std::size_t i = 0; i < n; i += kWidth)
      seen_.store(i,
                  seen_normal(FacingUp::view(surface.frame.wo(in, i)), facets_.load(i).nh, surface.shape.load(in, i)));
    for (std::size_t i = 0; i < n; i += kWidth) {
      in.template prefetch<3, 4>(i);
      Vec3<F> wo = FacingUp::view(surface.frame.wo(in, i));
      const auto& shape = surface.shape.load(in, i);
      auto facet = facets_.load(i);
      auto normal = normal_of(facet, seen_.load(i));
      directions_.store(i, {reflect(wo, normal), spread(facet.nh, normal, facets_.size(i).area, shape)});
      normals_.store(i, unit_normal(normal));
    }
    for (std::size_t i = 0; i < n; i += kWidth) {
      in.template prefetch<7, 8>(i);
      incidences_.store(i, incidence(FacingUp::view(surface.frame.wo(in, i)), normals_.load(i), indices_.load(i)));
    }
    for (std::size_t i = 0; i < n; i += kWidth) {
      crossings_.store(i, choose_side(incidences_.load(i).cosines, indices_.load(i), in.template load<8>(i)));
    }
    for (std::size_t i = 0; i < n; i += kWidth) {
      auto direction = directions_.load(i);
      Vec3<F> wi = leave(FacingUp::view(surface.frame.wo(in, i)), direction.wi, incidences_.load(i),
                         normals_.load(i).wm, crossings_.load(i).side, indices_.load(i));
      directions_.store(i, {wi, direction.spread});
    }
    for (std::size_t i = 0; i < n; i += kWidth)
      lights_.store(i, lanes::dielectric_light<Masked>(crossings_.load(i).side, directions_.load(i).wi,
                                                       surface.shape.load(in, i)));
    for (std::size_t i = 0; i < n; i += kWidth) {
      F wo_z = in.template load<2>(i);
      auto below = wo_z < F(0.f);
      wo_z = op::abs(wo_z);
      auto direction = directions_.load(i);
      auto at = crossings_.load(i);
      auto weighed = lanes::weigh_dielectric<Masked>(wo_z, facets_.size(i), direction.wi.z, direction.spread, at,
                                                     indices_.load(i), lights_.load(i));
      Vec3<F> wi =
          straight_or(surface.frame.theta_z(i), indices_.load(i), load_wo(in, i), lanes::mirrored(below, direction.wi));
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
  StagedForShading<lanes::SeenNormal<F>> seen_;
  StagedForShading<Direction> directions_;
  StagedForShading<lanes::UnitNormal<F>> normals_;
  StagedForShading<lanes::Index<F>> indices_;
  StagedForShading<lanes::Incidence<F>> incidences_;
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
    for (std::size_t i = 0; i < n; i += kWidth) indices_.store(i, load_index<8>(in, i));
    for (std::size_t i = 0; i < n; i += kWidth) {
      auto below = in.template load<2>(i) < F(0.f);
      terms_.store(i, lanes::dielectric_terms<Masked>(lanes::mirrored(below, load_wo(in, i)),
                                                      lanes::mirrored(below, load_second(in, i)),
                                                      surface.shape.for_pair(in, i), indices_.load(i)));
    }
    for (std::size_t i = 0; i < n; i += kWidth)
      crossings_.store(i, crossing_of(wi_z(in, i), terms_.load(i), indices_.load(i)));
    for (std::size_t i = 0; i < n; i += kWidth) {
      auto value = lanes::evaluate_crossing(op::abs(in.template load<2>(i)), wi_z(in, i), indices_.load(i),
                                            terms_.load(i).pair, crossings_.load(i));
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

  StagedForShading<lanes::Index<F>> indices_;
  StagedForShading<lanes::DielectricTerms<Masked, F>> terms_;
  StagedForShading<lanes::Crossing<F>> crossings_;
};

}  // namespace
