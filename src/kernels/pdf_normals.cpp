// pdf_normals for one instruction set.
#include "kernel.h"
#include "surfaces.h"

namespace {

template <class Surface>
struct Density {
  static constexpr int kVectors = kVectorsOfPairs;

  InColumns3 wo, wm;
  Surface surface;
  OutColumn pdf;

  template <class Function>
  VNDF_INLINE void inputs(Function f) {
    wo.each(f), wm.each(f), surface.each(f);
  }
  template <class Function>
  VNDF_INLINE void outputs(Function f) {
    f(pdf);
  }
  VNDF_INLINE void prepare(std::size_t n) const { surface.prepare(n); }

  template <class F, class Place>
  VNDF_INLINE void at(Place i) const {
    pdf.store(i, lanes::visible_normal_pdf(wo.load<F>(i), wm.load<F>(i), surface.template for_pair<F>(i)));
  }
};

template <class Surface>
void evaluate(std::size_t count, const vndf::DensityIn& in, const typename Surface::Given& surface,
              float* const& pdf) noexcept {
  typename Surface::Room room;
  Density<Surface> kernel{in.wo, in.wm, {surface, count, room}, pdf};
  run(count, kernel);
}

}  // namespace

namespace vndf::VNDF_SET {

extern const DensityTable pdf_normals;
constexpr DensityTable pdf_normals = {{{::evaluate<Alpha>}, ::evaluate<TurnedAlpha>, ::evaluate<Matrix<ForPairs>>}};

}  // namespace vndf::VNDF_SET
