// The batch functions for one instruction set. Compiled once per row of cmake/isa.cmake, with VNDF_BATCH its vector
// type and VNDF_TABLE the one name this object exports.
#include "kernel_table.h"

#include <vndf/lanes.h>

#include "blocks.h"

namespace {

using namespace vndf;
using lanes::Vec2;
using lanes::Vec3;

// Columns of the sampling functions, in the order they are passed to for_each_block.
using SampleInputs = Inputs<7>;
VNDF_INLINE Vec3<F> load_wo(const SampleInputs& in, std::size_t i) {
  return {in.load<0>(i), in.load<1>(i), in.load<2>(i)};
}
VNDF_INLINE Vec2<F> load_alpha(const SampleInputs& in, std::size_t i) {
  return {in.load<3>(i), in.load<4>(i)};
}
VNDF_INLINE Vec2<F> load_u(const SampleInputs& in, std::size_t i) {
  return {in.load<5>(i), in.load<6>(i)};
}

VNDF_INLINE void store(const Vec2<F>& v, float* const (&out)[2], std::size_t i) {
  lanes::op::store(v.x, out[0] + i);
  lanes::op::store(v.y, out[1] + i);
}
VNDF_INLINE void store(const Vec3<F>& v, float* const (&out)[3], std::size_t i) {
  lanes::op::store(v.x, out[0] + i);
  lanes::op::store(v.y, out[1] + i);
  lanes::op::store(v.z, out[2] + i);
}

template <DiskMap map>
VNDF_INLINE lanes::DiskPoint<F> map_disk(Vec2<F> u) {
  return map == DiskMap::polar ? lanes::polar_map(u) : lanes::concentric_map(u);
}

template <DiskMap map>
void sample_normals_on_disk(std::size_t count, const Columns3& wo, const Columns2& alpha, const Columns2& u,
                            const Out3& wm) noexcept {
  Staged<lanes::DiskPoint<F>> points;
  Staged<lanes::Chord<F>> chords;
  Staged<lanes::HemisphereView<F>> views;
  Staged<Vec3<F>> normals;
  for_each_block<7, 3>(
      count, {wo.x, wo.y, wo.z, alpha.x, alpha.y, u.x, u.y}, {wm.x, wm.y, wm.z},
      [&](const SampleInputs& in, float* const(&out)[3], std::size_t begin, std::size_t end) VNDF_INLINE_LAMBDA {
        if (end - begin <= kShort) {
          stage(begin, end, [&](std::size_t i) VNDF_INLINE_LAMBDA {
            auto t = chord(map_disk<map>(load_u(in, i)));
            auto view = map_to_hemisphere(load_wo(in, i), load_alpha(in, i));
            store(map_from_hemisphere(reproject(view, t, squish(view, t)), load_alpha(in, i)), out, i);
          });
          return;
        }
        stage(begin, end, [&](std::size_t i) VNDF_INLINE_LAMBDA { points.store(i, map_disk<map>(load_u(in, i))); });
        stage(begin, end, [&](std::size_t i) VNDF_INLINE_LAMBDA { chords.store(i, chord(points.load(i))); });
        stage(begin, end, [&](std::size_t i) VNDF_INLINE_LAMBDA {
          views.store(i, map_to_hemisphere(load_wo(in, i), load_alpha(in, i)));
        });
        stage(begin, end, [&](std::size_t i) VNDF_INLINE_LAMBDA {
          auto view = views.load(i);
          auto t = chords.load(i);
          normals.store(i, reproject(view, t, squish(view, t)));
        });
        stage(begin, end, [&](std::size_t i) VNDF_INLINE_LAMBDA {
          store(map_from_hemisphere(normals.load(i), load_alpha(in, i)), out, i);
        });
      });
}

void sample_normals_on_cap(std::size_t count, const Columns3& wo, const Columns2& alpha, const Columns2& u,
                           const Out3& wm) noexcept {
  Staged<Vec3<F>> normals;
  for_each_block<7, 3>(count, {wo.x, wo.y, wo.z, alpha.x, alpha.y, u.x, u.y}, {wm.x, wm.y, wm.z},
                       [&](const SampleInputs& in, float* const(&out)[3], std::size_t begin, std::size_t end)
                           VNDF_INLINE_LAMBDA {
                             stage(begin, end, [&](std::size_t i) VNDF_INLINE_LAMBDA {
                               normals.store(i, sample_cap(load_wo(in, i), load_alpha(in, i), load_u(in, i)));
                             });
                             stage(begin, end, [&](std::size_t i) VNDF_INLINE_LAMBDA {
                               store(map_from_hemisphere(normals.load(i), load_alpha(in, i)), out, i);
                             });
                           });
}

template <DiskMap map>
void sample_disk_points(std::size_t count, const Columns2& u, const Out2& t) noexcept {
  for_each_block<2, 2>(count, {u.x, u.y}, {t.x, t.y},
                       [&](const Inputs<2>& in, float* const(&out)[2], std::size_t begin, std::size_t end)
                           VNDF_INLINE_LAMBDA {
                             stage(begin, end, [&](std::size_t i) VNDF_INLINE_LAMBDA {
                               store(cartesian(map_disk<map>({in.load<0>(i), in.load<1>(i)})), out, i);
                             });
                           });
}

}  // namespace

namespace vndf {

extern const KernelTable VNDF_TABLE;
const KernelTable VNDF_TABLE = {
    {sample_normals_on_disk<DiskMap::polar>, sample_normals_on_disk<DiskMap::concentric>, sample_normals_on_cap},
    {sample_disk_points<DiskMap::polar>, sample_disk_points<DiskMap::concentric>},
};

}  // namespace vndf
