// evaluate_dielectric for one instruction set.
#include "dielectric_options.h"
#include "kernel.h"
#include "surfaces.h"

namespace {

template <class Surface>
struct Evaluation {
  static constexpr int kVectors = kVectorsOfPairs;

  InColumns3 wo, wi;
  Surface surface;
  InColumn eta;
  Asked asked;
  OutColumn f_cos, pdf;

  template <class Function>
  VNDF_INLINE void inputs(Function f) {
    wo.each(f), wi.each(f), surface.each(f), f(eta), asked.each(f);
  }
  template <class Function>
  VNDF_INLINE void outputs(Function f) {
    f(f_cos), f(pdf);
  }
  VNDF_INLINE void prepare(std::size_t n) const { surface.prepare(n); }

  template <class F, class Place>
  VNDF_INLINE void at(Place i) const {
    auto value = lanes::evaluate_dielectric(wo.load<F>(i), wi.load<F>(i), surface.template for_pair<F>(i),
                                            eta.load<F>(i), asked.masking<Surface>(), asked.lobes<F>(i));
    f_cos.store(i, value.f_cos);
    pdf.store(i, value.pdf);
  }
};

template <class Surface>
void evaluate(std::size_t count, const vndf::DielectricEvaluationIn& in, const typename Surface::Given& surface,
              const vndf::Evaluations& out) noexcept {
  typename Surface::Room room;
  Evaluation<Surface> kernel{in.wo, in.wi, {surface, count, room}, in.eta, in.asked, out.f_cos, out.pdf};
  run(count, kernel);
}

}  // namespace

namespace vndf::VNDF_SET {

extern const DielectricEvaluationTable evaluate_dielectric;
constexpr DielectricEvaluationTable evaluate_dielectric = {
    {{::evaluate<Alpha>}, ::evaluate<TurnedAlpha>, ::evaluate<Matrix<ForPairs>>}};

}  // namespace vndf::VNDF_SET
