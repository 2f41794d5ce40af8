// evaluate_reflection for one instruction set.
#include "kernel.h"
#include "surfaces.h"

namespace {

template <class Surface, vndf::Masking masking, bool bounded>
struct Evaluation {
  static constexpr int kVectors = kVectorsOfPairs;

  InColumns3 wo, wi;
  Surface surface;
  OutColumn f_cos, pdf;
  OutColumn wo_dot_wm;  // if wanted

  template <class Function>
  VNDF_INLINE void inputs(Function f) {
    wo.each(f), wi.each(f), surface.each(f);
  }
  template <class Function>
  VNDF_INLINE void outputs(Function f) {
    f(f_cos), f(pdf), f(wo_dot_wm);
  }
  VNDF_INLINE void prepare(std::size_t n) const { surface.prepare(n); }

  template <class F, class Place>
  VNDF_INLINE void at(Place i) const {
    auto value = evaluate(wo.load<F>(i), wi.load<F>(i), surface.template for_pair<F>(i));
    if (wo_dot_wm.wanted())  // loaded again, so that they keep no registers until here
      wo_dot_wm.store(i, lanes::half_cosine(wo.load<F>(i), wi.load<F>(i)));
    f_cos.store(i, value.f_cos);
    pdf.store(i, value.pdf);
  }
  template <class F, class Shape>
  VNDF_INLINE lanes::Evaluation<F> evaluate(const Vec3<F>& view, const Vec3<F>& light, const Shape& shape) const {
    if constexpr (bounded)
      return lanes::evaluate_reflection_bounded(view, light, shape, Surface::masking(masking));
    else
      return lanes::evaluate_reflection(view, light, shape, Surface::masking(masking));
  }
};

template <class Surface, vndf::Masking masking = vndf::Masking::separable, bool bounded = false>
void evaluate(std::size_t count, const vndf::EvaluationIn& in, const typename Surface::Given& surface,
              const vndf::Evaluations& out) noexcept {
  typename Surface::Room room;
  Evaluation<Surface, masking, bounded> kernel{in.wo, in.wi, {surface, count, room}, out.f_cos, out.pdf, out.wo_dot_wm};
  run(count, kernel);
}

}  // namespace

namespace vndf::VNDF_SET {

extern const EvaluationTable evaluate_reflection;
constexpr EvaluationTable evaluate_reflection = {
    {{::evaluate<Alpha, Masking::height_correlated>, ::evaluate<Alpha>},
     ::evaluate<TurnedAlpha>,
     ::evaluate<Matrix<ForPairs>>},
    {::evaluate<Alpha, Masking::height_correlated, true>, ::evaluate<Alpha, Masking::separable, true>}};

}  // namespace vndf::VNDF_SET
