// The stages of the sampling kernels, each a loop of its own as in src/kernels.cpp, with the markers that llvm-mca
// looks for around one iteration. mca.sh compiles this file to assembly, once per instruction set; it is never run.
#include <vndf/lanes.h>

namespace {

using F = VNDF_BATCH;
using namespace vndf::lanes;

constexpr std::size_t kBlock = 256;

/// A block's columns, one behind the other, so that a loop needs one address for all.
template <class T>
VNDF_INLINE T load(const float* block, std::size_t i) {
  constexpr std::size_t kMembers = sizeof(T) / sizeof(F);
  F members[kMembers];
  for (std::size_t c = 0; c < kMembers; ++c) members[c] = op::load<F>(block + c * kBlock + i);
  T value;
  std::memcpy(&value, members, sizeof value);
  return value;
}

template <class T>
VNDF_INLINE void store(const T& value, float* block, std::size_t i) {
  constexpr std::size_t kMembers = sizeof(T) / sizeof(F);
  F members[kMembers];
  std::memcpy(members, &value, sizeof value);
  for (std::size_t c = 0; c < kMembers; ++c) op::store(members[c], block + c * kBlock + i);
}

}  // namespace

// The memory clobbers keep an iteration's loads and stores, and so what lies between them, inside the markers;
// constants and the loop counter stay outside.
#define VNDF_STAGE_AFTER(name, before, statement)                 \
  void stage_##name(const float* a, const float* b, float* out) { \
    before;                                                       \
    for (std::size_t i = 0; i < kBlock; i += kWidth<F>) {         \
      __asm__ volatile("# LLVM-MCA-BEGIN " #name : : : "memory"); \
      statement;                                                  \
      __asm__ volatile("# LLVM-MCA-END " #name : : : "memory");   \
    }                                                             \
    (void)b;                                                      \
  }
#define VNDF_STAGE(name, statement) VNDF_STAGE_AFTER(name, , statement)

extern "C" {
VNDF_STAGE(polar_map, store(polar_map(load<Vec2<F>>(a, i)), out, i))
VNDF_STAGE_AFTER(concentric_map, auto next = wedge_of(load<Vec2<F>>(a, 0)), auto wedge = next;
                 next = wedge_of(load<Vec2<F>>(a, i + kWidth<F>)); store(concentric_map(wedge), out, i))
VNDF_STAGE(chord, store(chord(load<DiskPoint<F>>(a, i)), out, i))
VNDF_STAGE(scale_view, F norm;
           store(scale_view(stretch(load<Vec3<F>>(a, i), load<Vec2<F>>(b, i)), XAxis{}, norm), out, i))
VNDF_STAGE(elevation_of, store(elevation_of(load<ScaledView<F>>(a, i)), out, i))
VNDF_STAGE(reproject, store(reproject(load<HemisphereView<F>>(a, i), load<Chord<F>>(b, i)).nh, out, i))
VNDF_STAGE(map_from_hemisphere, store(map_from_hemisphere(load<Vec3<F>>(a, i), load<Vec2<F>>(b, i)), out, i))
VNDF_STAGE(cap_view, store(cap_view(stretch(load<Vec3<F>>(a, i), load<Vec2<F>>(b, i))), out, i))
VNDF_STAGE(on_cap, store(on_cap(load<CapView<F>>(a, i), cap_map(load<Vec2<F>>(b, i))).nh, out, i))
}
