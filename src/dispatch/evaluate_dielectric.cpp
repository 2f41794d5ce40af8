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

template <class Surface>
static void evaluate(std::size_t count, const DielectricEvaluationIn& in, const Surface& surface,
                     const Evaluations& out) noexcept {
  expect_written(count, out);
  assert(!out.wo_dot_wm);
  expect_given(count, in.wo, in.wi, in.eta, surface);
  call(table().all, count, in, surface, out);
}

void evaluate_dielectric(std::size_t count, const Columns3& wo, const Columns3& wi, const Columns2& alpha,
                         const Column& eta, const Evaluations& out, const DielectricOptions& options) noexcept {
  evaluate(count, {wo, wi, eta, asked_of(count, options)}, alpha, out);
}
void evaluate_dielectric(std::size_t count, const Columns3& wo, const Columns3& wi, const Ellipsoid& ellipsoid,
                         const Column& eta, const Evaluations& out, const DielectricOptions& options) noexcept {
  evaluate(count, {wo, wi, eta, asked_of_ellipsoid(count, options)}, ellipsoid, out);
}
void evaluate_dielectric(std::size_t count, const Columns3& wo, const Columns3& wi, const Shape& shape,
                         const Column& eta, const Evaluations& out, const DielectricOptions& options) noexcept {
  evaluate(count, {wo, wi, eta, asked_of_ellipsoid(count, options)}, shape, out);
}

}  // namespace vndf
