// sample_dielectric for one instruction set.
#include "kernel.h"
#include "surfaces.h"
#include "warps.h"

namespace {

template <class Warp, class Surface, class Masking>
struct Dielectric {
  InColumns3 wo;
  Surface surface;
  InColumn eta;
  InColumns3 u;
  OutColumns3 wi;
  OutColumn pdf, weight, side;

  template <class Function>
  VNDF_INLINE void inputs(Function f) {
    wo.each(f), surface.each(f), f(eta), u.each(f);
  }
  template <class Function>
  VNDF_INLINE void outputs(Function f) {
    wi.each(f), f(pdf), f(weight), f(side);
  }
  VNDF_INLINE void prepare(std::size_t n) const { surface.prepare(n); }

  template <class F>
  VNDF_INLINE void at(std::size_t i) const {
    auto given = wo.load<F>(i);
    auto sample = lanes::sample_dielectric<Warp>(surface.view(given, i), surface.template shape<F>(i), eta.load<F>(i),
                                                 u.load<F>(i), Masking());
    wi.store(i, turn_back(sample, given, surface.template theta_z<F>(i)));
    pdf.store(i, sample.pdf);
    weight.store(i, sample.weight);
    side.store(i, sample.side);
  }
};

template <class Warp, class Surface, class Masking = typename Surface::Masking>
void sample(std::size_t count, const vndf::DielectricIn& in, const typename Surface::Given& surface,
            const vndf::DielectricSamples& out) noexcept {
  typename Surface::Room room;
  Dielectric<Warp, Surface, Masking> kernel{in.wo,   {surface, count, room}, in.eta, in.u, out.wi, out.pdf, out.weight,
                                            out.side};
  run(count, kernel);
}

template <class... Warp>
constexpr vndf::DielectricTable table(List<Warp...>) {
  return {{{{sample<Warp, Alpha>, sample<Warp, Alpha, lanes::Smith<true>>},
            sample<Warp, TurnedAlpha>,
            sample<Warp, Matrix<ForViews>>}...}};
}

}  // namespace

namespace vndf::VNDF_SET {

extern const DielectricTable sample_dielectric;
constexpr DielectricTable sample_dielectric = ::table(Warps());

}  // namespace vndf::VNDF_SET
