// The public functions pdf_normals.
#include "dispatch.h"

namespace vndf {

#define VNDF_ISA(name, supported)        \
  namespace name {                       \
  extern const DensityTable pdf_normals; \
  }
#include "isa_rows.h"

static const DensityTable& table() noexcept {
#define VNDF_ISA(name, supported) &name::pdf_normals,
  static constexpr const DensityTable* kRows[] = {
#include "isa_rows.h"
  };
  return *kRows[active_row()];
}

template <class Surface>
static void evaluate(std::size_t count, const DensityIn& in, const Surface& surface, float* pdf) noexcept {
  expect_written(count, pdf);
  expect_given(count, in.wo, in.wm, surface);
  call(table().all, count, in, surface, pdf);
}

void pdf_normals(std::size_t count, const Columns3& wo, const Columns3& wm, const Columns2& alpha,
                 float* pdf) noexcept {
  evaluate(count, {wo, wm}, alpha, pdf);
}
void pdf_normals(std::size_t count, const Columns3& wo, const Columns3& wm, const Ellipsoid& ellipsoid,
                 float* pdf) noexcept {
  evaluate(count, {wo, wm}, ellipsoid, pdf);
}
void pdf_normals(std::size_t count, const Columns3& wo, const Columns3& wm, const Shape& shape, float* pdf) noexcept {
  evaluate(count, {wo, wm}, shape, pdf);
}

}  // namespace vndf
