// evaluate_reflection for one instruction set.
#include "kernel.h"
#include "surfaces.h"

namespace {

template <class Surface, bool bounded, class Masking>
struct Evaluation {
  InColumns3 wo, wi;
  Surface surface;
  OutColumn f_cos, pdf;

  template <class Function>
  VNDF_INLINE void inputs(Function f) {
    wo.each(f), wi.each(f), surface.each(f);
  }
  template <class Function>
  VNDF_INLINE void outputs(Function f) {
    f(f_cos), f(pdf);
  }
  VNDF_INLINE void prepare(std::size_t n) const { surface.prepare(n); }

  template <class F>
  VNDF_INLINE void at(std::size_t i) const {
    auto value = evaluate(wo.load<F>(i), wi.load<F>(i), surface.template for_pair<F>(i));
    f_cos.store(i, value.f_cos);
    pdf.store(i, value.pdf);
  }
  template <class F, class Shape>
  VNDF_INLINE lanes::Evaluation<F> evaluate(const Vec3<F>& wo, const Vec3<F>& wi, const Shape& shape) const {
    if constexpr (bounded)
      return lanes::evaluate_reflection_bounded(wo, wi, shape, Masking());
    else
      return lanes::evaluate_reflection(wo, wi, shape, Masking());
  }
};

template <class Surface, class Masking = typename Surface::Masking, bool bounded = false>
void evaluate(std::size_t count, const vndf::EvaluationIn& in, const typename Surface::Given& surface,
              const vndf::Evaluations& out) noexcept {
  typename Surface::Room room;
  Evaluation<Surface, bounded, Masking> kernel{in.wo, in.wi, {surface, count, room}, out.f_cos, out.pdf};
  run(count, kernel);
}

}  // namespace

namespace vndf::VNDF_SET {

extern const EvaluationTable evaluate_reflection;
constexpr EvaluationTable evaluate_reflection = {
    {{::evaluate<Alpha>, ::evaluate<Alpha, lanes::Smith<true>>}, ::evaluate<TurnedAlpha>, ::evaluate<Matrix<ForPairs>>},
    {::evaluate<Alpha, lanes::Smith<false>, true>, ::evaluate<Alpha, lanes::Smith<true>, true>}};

}  // namespace vndf::VNDF_SET
