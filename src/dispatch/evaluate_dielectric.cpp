// The public functions evaluate_dielectric.
#include "dispatch.h"

namespace vndf {

#define VNDF_ISA(name, supported)                             \
  namespace name {                                            \
  extern const DielectricEvaluationTable evaluate_dielectric; \
  }
#include "isa_rows.h"

static const DielectricEvaluationTable& table() noexcept {
#define VNDF_ISA(name, supported) &name::evaluate_dielectric,
  static constexpr const DielectricEvaluationTable* kRows[] = {
#include "isa_rows.h"
  };
  return *kRows[active_row()];
}

template <class Surface, class... Masking>
static void evaluate(std::size_t count, const DielectricEvaluationIn& in, const Surface& surface,
                     const Evaluations& out, Masking... masking) noexcept {
  expect_written(count, out);
  call(table().all, count, in, surface, out, masking...);
}

void evaluate_dielectric(std::size_t count, const Columns3& wo, const Columns3& wi, const Columns2& alpha,
                         const Column& eta, const Evaluations& out, Masking masking) noexcept {
  evaluate(count, {wo, wi, eta}, alpha, out, masking);
}
void evaluate_dielectric(std::size_t count, const Columns3& wo, const Columns3& wi, const Ellipsoid& ellipsoid,
                         const Column& eta, const Evaluations& out) noexcept {
  evaluate(count, {wo, wi, eta}, ellipsoid, out);
}
void evaluate_dielectric(std::size_t count, const Columns3& wo, const Columns3& wi, const Shape& shape,
                         const Column& eta, const Evaluations& out) noexcept {
  evaluate(count, {wo, wi, eta}, shape, out);
}

}  // namespace vndf
