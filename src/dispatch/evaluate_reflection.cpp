// The public functions evaluate_reflection.
#include "dispatch.h"

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
  call(table().all, count, in, surface, out, masking...);
}

void evaluate_reflection(std::size_t count, const Columns3& wo, const Columns3& wi, const Columns2& alpha,
                         const Evaluations& out, const ReflectionOptions& options) noexcept {
  if (!options.bounded) return evaluate(count, {wo, wi}, alpha, out, options.masking);
  expect_written(count, out);
  FloatMode exact;
  of(table().bounded, options.masking)(count, {wo, wi}, alpha, out);
}
void evaluate_reflection(std::size_t count, const Columns3& wo, const Columns3& wi, const Ellipsoid& ellipsoid,
                         const Evaluations& out) noexcept {
  evaluate(count, {wo, wi}, ellipsoid, out);
}
void evaluate_reflection(std::size_t count, const Columns3& wo, const Columns3& wi, const Shape& shape,
                         const Evaluations& out) noexcept {
  evaluate(count, {wo, wi}, shape, out);
}

}  // namespace vndf
