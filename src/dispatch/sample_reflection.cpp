// The public functions sample_reflection.
#include "two_sided.h"

namespace vndf {

#define VNDF_ISA(name, supported)                 \
  namespace name {                                \
  extern const ReflectionTable sample_reflection; \
  }
#include "isa_rows.h"

static const ReflectionTable& table() noexcept {
#define VNDF_ISA(name, supported) &name::sample_reflection,
  static constexpr const ReflectionTable* kRows[] = {
#include "isa_rows.h"
  };
  return *kRows[active_row()];
}

static void expect_written(std::size_t count, const ReflectionSamples& out) noexcept {
  expect_written(count, out.wi.x, out.wi.y, out.wi.z, out.pdf, out.weight);
}

template <class Surface, class... Masking>
static void sample(Warp warp, std::size_t count, const ReflectionIn& in, const Surface& surface,
                   const ReflectionSamples& out, Masking... masking) noexcept {
  expect_written(count, out);
  expect_given(count, in.wo, in.u, surface);
  call(of(table().warps, warp), count, in, surface, out, masking...);
}

template <class Surface>
static void sample_two_sided(Warp warp, std::size_t count, const Columns3& wo, const Surface& surface,
                             const Columns2& u, const ReflectionSamples& out, ReflectionOptions options) noexcept {
  expect_written(count, out);
  expect_given(count, wo, surface, u);
  options.two_sided = false;
  for (std::size_t begin = 0; begin < count; begin += kTwoSidedBlock) {
    const Heights heights(wo.z, begin, count);
    const Out3 wi = from(out.wi, begin), wm = from(out.wm, begin);
    sample_reflection(warp, heights.n, {from(wo.x, begin), from(wo.y, begin), heights.upper}, from(surface, begin),
                      from(u, begin), {wi, out.pdf + begin, out.weight + begin, wm, from(out.wo_dot_wm, begin)},
                      options);
    heights.mirror(wi.z, 0, wi.z);
    if (wm.z) heights.mirror(wm.z, 0, wm.z);
  }
}

void sample_reflection(Warp warp, std::size_t count, const Columns3& wo, const Columns2& alpha, const Columns2& u,
                       const ReflectionSamples& out, const ReflectionOptions& options) noexcept {
  if (options.two_sided) return sample_two_sided(warp, count, wo, alpha, u, out, options);
  const ReflectionIn in = {wo, u};
  if (!options.bounded) return sample(warp, count, in, alpha, out, options.masking);
  expect_written(count, out);
  expect_given(count, wo, alpha, u);
  FloatMode exact;
  of(of(table().bounded, warp), options.masking)(count, in, alpha, out);
}
void sample_reflection(Warp warp, std::size_t count, const Columns3& wo, const Ellipsoid& ellipsoid, const Columns2& u,
                       const ReflectionSamples& out, const ReflectionOptions& options) noexcept {
  assert(!options.bounded);
  if (options.two_sided) return sample_two_sided(warp, count, wo, ellipsoid, u, out, options);
  sample(warp, count, {wo, u}, ellipsoid, out);
}
void sample_reflection(Warp warp, std::size_t count, const Columns3& wo, const Shape& shape, const Columns2& u,
                       const ReflectionSamples& out, const ReflectionOptions& options) noexcept {
  assert(!options.bounded);
  if (options.two_sided) return sample_two_sided(warp, count, wo, shape, u, out, options);
  sample(warp, count, {wo, u}, shape, out);
}

}  // namespace vndf
