// The public functions sample_normals.
#include "dispatch.h"

namespace vndf {

#define VNDF_ISA(name, supported)           \
  namespace name {                          \
  extern const NormalsTable sample_normals; \
  }
#include "isa_rows.h"

static const NormalsTable& table() noexcept {
#define VNDF_ISA(name, supported) &name::sample_normals,
  static constexpr const NormalsTable* kRows[] = {
#include "isa_rows.h"
  };
  return *kRows[active_row()];
}

template <class Surface>
static void sample(Warp warp, std::size_t count, const Columns3& wo, const Surface& surface, const Columns2& u,
                   const Out3& wm) noexcept {
  expect_written(count, wm);
  expect_given(count, wo, surface, u);
  call(of(table().warps, warp), count, {wo, u}, surface, wm);
}

void sample_normals(Warp warp, std::size_t count, const Columns3& wo, const Columns2& alpha, const Columns2& u,
                    const Out3& wm) noexcept {
  sample(warp, count, wo, alpha, u, wm);
}
void sample_normals(Warp warp, std::size_t count, const Columns3& wo, const Ellipsoid& ellipsoid, const Columns2& u,
                    const Out3& wm) noexcept {
  sample(warp, count, wo, ellipsoid, u, wm);
}
void sample_normals(Warp warp, std::size_t count, const Columns3& wo, const Shape& shape, const Columns2& u,
                    const Out3& wm) noexcept {
  sample(warp, count, wo, shape, u, wm);
}

}  // namespace vndf
