// sample_reflection for one instruction set.
#include "kernel.h"
#include "surfaces.h"
#include "warps.h"

namespace {

template <class Warp, class Surface, vndf::Masking masking>
struct Reflection {
  static constexpr int kVectors = ::kVectors;

  InColumns3 wo;
  Surface surface;
  InColumns2 u;
  OutColumns3 wi;
  OutColumn pdf, weight;
  OutColumn wm_x, wm_y, wm_z, wo_dot_wm;  // each if wanted

  template <class Function>
  VNDF_INLINE void inputs(Function f) {
    wo.each(f), surface.each(f), u.each(f);
  }
  template <class Function>
  VNDF_INLINE void outputs(Function f) {
    wi.each(f), f(pdf), f(weight), f(wm_x), f(wm_y), f(wm_z), f(wo_dot_wm);
  }
  VNDF_INLINE void prepare(std::size_t n) const { surface.prepare(n); }

  template <class F, class Place>
  VNDF_INLINE void at(Place i) const {
    auto view = surface.view(wo.load<F>(i), i);
    auto sample =
        lanes::sample_reflection<Warp>(view, surface.template shape<F>(i), u.load<F>(i), Surface::masking(masking));
    auto theta_z = surface.template theta_z<F>(i);
    bool normal_wanted = wm_x.wanted() || wm_y.wanted() || wm_z.wanted() || wo_dot_wm.wanted();
    wi.store(i, turn_back(sample.wi, theta_z));
    pdf.store(i, sample.pdf);
    weight.store(i, sample.weight);
    if (!normal_wanted) return;
    auto normal = unit_normal(sample.normal, theta_z);
    wm_x.store_if_wanted(i, normal.wm.x);
    wm_y.store_if_wanted(i, normal.wm.y);
    wm_z.store_if_wanted(i, normal.wm.z);
    wo_dot_wm.store_if_wanted(i, normal.cos);
  }
};

template <class Warp, class Surface, vndf::Masking masking = vndf::Masking::separable>
void sample(std::size_t count, const vndf::ReflectionIn& in, const typename Surface::Given& surface,
            const vndf::ReflectionSamples& out) noexcept {
  typename Surface::Room room;
  Reflection<Warp, Surface, masking> kernel{
      in.wo, {surface, count, room}, in.u, out.wi, out.pdf, out.weight, out.wm.x, out.wm.y, out.wm.z, out.wo_dot_wm};
  run(count, kernel);
}

template <class... Warp>
constexpr vndf::ReflectionTable table(List<Warp...>) {
  using lanes::Bounded;
  return {{{{sample<Warp, Alpha, vndf::Masking::height_correlated>, sample<Warp, Alpha>},
            sample<Warp, TurnedAlpha>,
            sample<Warp, Matrix<ForViews>>}...},
          {{sample<Bounded<Warp>, Alpha, vndf::Masking::height_correlated>, sample<Bounded<Warp>, Alpha>}...}};
}

}  // namespace

namespace vndf::VNDF_SET {

extern const ReflectionTable sample_reflection;
constexpr ReflectionTable sample_reflection = ::table(Warps());

}  // namespace vndf::VNDF_SET
