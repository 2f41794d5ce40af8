// sample_normals for one instruction set.
#include "kernel.h"
#include "surfaces.h"
#include "warps.h"

namespace {

template <class Warp, class Surface>
struct Normals {
  static constexpr int kVectors = ::kVectors;

  InColumns3 wo;
  Surface surface;
  InColumns2 u;
  OutColumns3 wm;

  template <class Function>
  VNDF_INLINE void inputs(Function f) {
    wo.each(f), surface.each(f), u.each(f);
  }
  template <class Function>
  VNDF_INLINE void outputs(Function f) {
    wm.each(f);
  }
  VNDF_INLINE void prepare(std::size_t n) const { surface.prepare(n); }

  template <class F, class Place>
  VNDF_INLINE void at(Place i) const {
    auto view = surface.view(wo.load<F>(i), i);
    wm.store(i, lanes::sample_normal<Warp>(view, surface.template shape<F>(i), u.load<F>(i),
                                           surface.template theta_z<F>(i)));
  }
};

template <class Warp, class Surface>
void sample(std::size_t count, const vndf::NormalsIn& in, const typename Surface::Given& surface,
            const vndf::Out3& wm) noexcept {
  typename Surface::Room room;
  Normals<Warp, Surface> kernel{in.wo, {surface, count, room}, in.u, wm};
  run(count, kernel);
}

template <class... Warp>
constexpr vndf::NormalsTable table(List<Warp...>) {
  return {{{{sample<Warp, Alpha>}, sample<Warp, TurnedAlpha>, sample<Warp, Matrix<ForViews>>}...}};
}

}  // namespace

namespace vndf::VNDF_SET {

extern const NormalsTable sample_normals;
constexpr NormalsTable sample_normals = ::table(Warps());

}  // namespace vndf::VNDF_SET
