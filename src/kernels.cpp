// The batch functions for one instruction set. Compiled once per row of cmake/isa.cmake, with VNDF_BATCH its vector
// type and VNDF_TABLE the one name this object exports.
#include "kernel_table.h"

#include <vndf/lanes.h>

#include "blocks.h"

namespace {

using namespace vndf;
using lanes::Vec2;
using lanes::Vec3;

// The columns of the sampling functions: wo, alpha, u, and what else there is.
template <std::size_t N>
VNDF_INLINE Vec3<F> load_wo(const Inputs<N>& in, std::size_t i) {
  return {in.template load<0>(i), in.template load<1>(i), in.template load<2>(i)};
}
template <std::size_t N>
VNDF_INLINE Vec2<F> load_u(const Inputs<N>& in, std::size_t i) {
  return {in.template load<5>(i), in.template load<6>(i)};
}

}  // namespace

#include "shapes.h"

#include "normals_kernels.h"

#include "shading_kernels.h"

#include "dielectric_kernels.h"

#include "functions.h"

namespace vndf {

extern const KernelTable VNDF_TABLE;
constexpr KernelTable VNDF_TABLE = {
    {::sample_disk<DiskMap::polar>, ::sample_disk<DiskMap::concentric>},
    {kernels_of<Plain, lanes::HeightCorrelated>(), kernels_of<Plain, lanes::Separable>()},
    {kernels_of<Plain, lanes::HeightCorrelated, true>(), kernels_of<Plain, lanes::Separable, true>()},
    kernels_of<OneShapes, lanes::Lunes>(),
    kernels_of<AllTurned, lanes::Separable>(),  // what eq. 6 is without theta_x and theta_y
    kernels_of<AllTilted, lanes::Lunes>(),
};

}  // namespace vndf
