// sample_dielectric for one instruction set.
#include "dielectric_options.h"
#include "kernel.h"
#include "surfaces.h"
#include "warps.h"

namespace {

template <class Warp, class Surface>
struct Dielectric {
  static constexpr int kVectors = ::kVectors;

  InColumns3 wo;
  Surface surface;
  InColumn eta;
  InColumns3 u;
  Asked asked;
  OutColumns3 wi;
  OutColumn pdf, weight, side;
  OutColumn wm_x, wm_y, wm_z, wo_dot_wm, wi_dot_wm, reflectance;  // each if wanted

  template <class Function>
  VNDF_INLINE void inputs(Function f) {
    wo.each(f), surface.each(f), f(eta), u.each(f), asked.each(f);
  }
  template <class Function>
  VNDF_INLINE void outputs(Function f) {
    wi.each(f), f(pdf), f(weight), f(side), f(wm_x), f(wm_y), f(wm_z), f(wo_dot_wm), f(wi_dot_wm), f(reflectance);
  }
  VNDF_INLINE void prepare(std::size_t n) const { surface.prepare(n); }

  template <class F, class Place>
  VNDF_INLINE void at(Place i) const {
    auto given = wo.load<F>(i);
    auto sample = lanes::sample_dielectric<Warp>(surface.view(given, i), surface.template shape<F>(i), eta.load<F>(i),
                                                 u.load<F>(i), asked.masking<Surface>(), asked.lobes<F>(i));
    auto theta_z = surface.template theta_z<F>(i);
    wi.store(i, turn_back(sample, given, theta_z));
    pdf.store(i, sample.pdf);
    weight.store(i, sample.weight);
    side.store(i, sample.side);
    if (wm_x.wanted() || wm_y.wanted() || wm_z.wanted()) {
      auto wm = turn_back(sample.wm, theta_z);
      wm_x.store_if_wanted(i, wm.x);
      wm_y.store_if_wanted(i, wm.y);
      wm_z.store_if_wanted(i, wm.z);
    }
    wo_dot_wm.store_if_wanted(i, sample.cos_o);
    wi_dot_wm.store_if_wanted(i, sample.cos_i);
    reflectance.store_if_wanted(i, sample.reflectance);
  }
};

template <class Warp, class Surface>
void sample(std::size_t count, const vndf::DielectricIn& in, const typename Surface::Given& surface,
            const vndf::DielectricSamples& out) noexcept {
  typename Surface::Room room;
  Dielectric<Warp, Surface> kernel{in.wo,          {surface, count, room},
                                   in.eta,         in.u,
                                   in.asked,       out.wi,
                                   out.pdf,        out.weight,
                                   out.side,       out.wm.x,
                                   out.wm.y,       out.wm.z,
                                   out.wo_dot_wm,  out.wi_dot_wm,
                                   out.reflectance};
  run(count, kernel);
}

template <class... Warp>
constexpr vndf::DielectricTable table(List<Warp...>) {
  return {{{{sample<Warp, Alpha>}, sample<Warp, TurnedAlpha>, sample<Warp, Matrix<ForViews>>}...}};
}

}  // namespace

namespace vndf::VNDF_SET {

extern const DielectricTable sample_dielectric;
constexpr DielectricTable sample_dielectric = ::table(Warps());

}  // namespace vndf::VNDF_SET
