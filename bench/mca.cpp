// The loops of the sampling kernels, with the markers that llvm-mca looks for around one iteration: loads, the pipeline
// over VNDF_VECTORS vectors at once, stores. mca.sh compiles this file to assembly, once per instruction set; it is
// never run.
#include <vndf/lanes.h>

struct Columns {
  const float *wo_x, *wo_y, *wo_z, *alpha_x, *alpha_y, *u1, *u2;
  float *x, *y, *z, *pdf, *weight;
};

namespace {

using namespace vndf::lanes;
using F = Many<VNDF_BATCH, VNDF_VECTORS>;

VNDF_INLINE Vec3<F> wo(const Columns& c, std::size_t i) {
  return {op::load<F>(c.wo_x + i), op::load<F>(c.wo_y + i), op::load<F>(c.wo_z + i)};
}
VNDF_INLINE Vec2<F> alpha(const Columns& c, std::size_t i) {
  return {op::load<F>(c.alpha_x + i), op::load<F>(c.alpha_y + i)};
}
VNDF_INLINE Vec2<F> u(const Columns& c, std::size_t i) {
  return {op::load<F>(c.u1 + i), op::load<F>(c.u2 + i)};
}
VNDF_INLINE void store(const Vec3<F>& v, const Columns& c, std::size_t i) {
  op::store(v.x, c.x + i);
  op::store(v.y, c.y + i);
  op::store(v.z, c.z + i);
}

template <class Warp>
VNDF_INLINE void normals(const Columns& c, std::size_t i) {
  store(sample_normal<Warp>(wo(c, i), alpha(c, i), u(c, i)), c, i);
}

template <class Warp>
VNDF_INLINE void reflection(const Columns& c, std::size_t i) {
  auto sample = sample_reflection<Warp>(wo(c, i), alpha(c, i), u(c, i), kHeightCorrelated);
  store(sample.wi, c, i);
  op::store(sample.pdf, c.pdf + i);
  op::store(sample.weight, c.weight + i);
}

}  // namespace

// The memory clobbers keep an iteration's loads and stores, and so what lies between them, inside the markers;
// constants and the loop counter stay outside.
#define VNDF_KERNEL(name, ...)                                    \
  void kernel_##name(const Columns& columns, std::size_t n) {     \
    const Columns c = columns;                                    \
    for (std::size_t i = 0; i < n; i += kWidth<F>) {              \
      __asm__ volatile("# LLVM-MCA-BEGIN " #name : : : "memory"); \
      __VA_ARGS__(c, i);                                          \
      __asm__ volatile("# LLVM-MCA-END " #name : : : "memory");   \
    }                                                             \
  }

VNDF_KERNEL(normals_polar, normals<Polar>)
VNDF_KERNEL(normals_concentric, normals<Concentric>)
VNDF_KERNEL(normals_spherical_cap, normals<SphericalCap>)
VNDF_KERNEL(reflection_polar, reflection<Polar>)
VNDF_KERNEL(reflection_concentric, reflection<Concentric>)
VNDF_KERNEL(reflection_spherical_cap, reflection<SphericalCap>)
