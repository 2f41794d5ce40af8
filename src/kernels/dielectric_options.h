// What a call asks of a dielectric beside its columns. The same for all lanes: kernels branch on it.
#pragma once

#include "../kernel_tables.h"
#include "columns.h"

namespace {

class Asked {
 public:
  VNDF_INLINE Asked(const vndf::DielectricAsked& asked)
      : masking_(asked.masking),
        across_(asked.across),
        radiance_(asked.radiance),
        given_(asked.reflection_probability),
        probability_(given_ ? *asked.reflection_probability : kNone) {}

  template <class Function>
  VNDF_INLINE void each(Function f) {
    if (given_) f(probability_);
  }
  template <class Surface>
  VNDF_INLINE auto masking() const {
    return Surface::masking(masking_, across_);
  }
  template <class F, class Place>
  struct Lobes {
    bool radiance, given;
    InColumn probability;
    Place i;
    VNDF_INLINE F reflection() const { return probability.load<F>(i); }
  };
  template <class F, class Place>
  VNDF_INLINE Lobes<F, Place> lobes(Place i) const {
    return {radiance_, given_, probability_, i};
  }

 private:
  // A constant expression, since a call of Column's constructor could be linked to the copy of another set's object.
  static constexpr vndf::Column kNone{0.f};

  vndf::Masking masking_;
  vndf::AcrossMasking across_;
  bool radiance_, given_;
  InColumn probability_;
};

}  // namespace
