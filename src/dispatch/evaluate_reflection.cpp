// The public functions evaluate_reflection.
#include "two_sided.h"

namespace vndf {

#define VNDF_ISA(name, supported)                   \
  namespace name {                                  \
  extern const EvaluationTable evaluate_reflection; \
  }
#include "isa_rows.h"

static const EvaluationTable& table() noexcept {
#define VNDF_ISA(name, supported) &name::evaluate_reflection,
  static constexpr const EvaluationTable* kRows[] = {
#include "isa_rows.h"
  };
  return *kRows[active_row()];
}

template <class Surface, class... Masking>
static void evaluate(std::size_t count, const EvaluationIn& in, const Surface& surface, const Evaluations& out,
                     Masking... masking) noexcept {
  expect_written(count, out);
  expect_given(count, in.wo, in.wi, surface);
  call(table().all, count, in, surface, out, masking...);
}

template <class Surface>
static void evaluate_two_sided(std::size_t count, const Columns3& wo, const Columns3& wi, const Surface& surface,
                               const Evaluations& out, ReflectionOptions options) noexcept {
  expect_written(count, out);
  expect_given(count, wo, wi, surface);
  options.two_sided = false;
  for (std::size_t begin = 0; begin < count; begin += kTwoSidedBlock) {
    const Heights heights(wo.z, begin, count);
    float wi_z[kTwoSidedBlock];
    heights.mirror(wi.z, begin, wi_z);
    evaluate_reflection(heights.n, {from(wo.x, begin), from(wo.y, begin), heights.upper},
                        {from(wi.x, begin), from(wi.y, begin), wi_z}, from(surface, begin),
                        {out.f_cos + begin, out.pdf + begin, from(out.wo_dot_wm, begin)}, options);
  }
}

void evaluate_reflection(std::size_t count, const Columns3& wo, const Columns3& wi, const Columns2& alpha,
                         const Evaluations& out, const ReflectionOptions& options) noexcept {
  if (options.two_sided) return evaluate_two_sided(count, wo, wi, alpha, out, options);
  const EvaluationIn in = {wo, wi};
  if (!options.bounded) return evaluate(count, in, alpha, out, options.masking);
  expect_written(count, out);
  expect_given(count, wo, wi, alpha);
  FloatMode exact;
  of(table().bounded, options.masking)(count, in, alpha, out);
}
void evaluate_reflection(std::size_t count, const Columns3& wo, const Columns3& wi, const Ellipsoid& ellipsoid,
                         const Evaluations& out, const ReflectionOptions& options) noexcept {
  assert(!options.bounded);
  if (options.two_sided) return evaluate_two_sided(count, wo, wi, ellipsoid, out, options);
  evaluate(count, {wo, wi}, ellipsoid, out);
}
void evaluate_reflection(std::size_t count, const Columns3& wo, const Columns3& wi, const Shape& shape,
                         const Evaluations& out, const ReflectionOptions& options) noexcept {
  assert(!options.bounded);
  if (options.two_sided) return evaluate_two_sided(count, wo, wi, shape, out, options);
  evaluate(count, {wo, wi}, shape, out);
}

}  // namespace vndf
