// Compiled once for each instruction set, with SHADE and BATCH: the function, and a vector of that set.
#include "own_kernel.h"

#include <vndf/lanes.h>

namespace lanes = vndf::lanes;
using F = BATCH;

static lanes::Vec3<F> load(const float* const (&columns)[3], std::size_t i) {
  using lanes::op::load;
  return {load<F>(columns[0] + i), load<F>(columns[1] + i), load<F>(columns[2] + i)};
}

void SHADE(const Hits& hits) {
  for (std::size_t i = 0; i < hits.count; i += lanes::kWidth<F>) {
    const lanes::Frame<F> frame = {load(hits.x, i), load(hits.y, i), load(hits.z, i)};
    const auto wo = to_local(load(hits.wo, i), frame);
    const lanes::Vec2<F> alpha = {F(hits.alpha_x), F(hits.alpha_y)};
    const lanes::Vec2<F> u = {lanes::op::load<F>(hits.u[0] + i), lanes::op::load<F>(hits.u[1] + i)};

    const auto sample = lanes::sample_reflection<lanes::Concentric>(wo, alpha, u, lanes::kHeightCorrelated);
    const F fresnel = lanes::conductor_reflectance(unit_normal(sample.normal).cos, F(hits.eta), F(hits.k));
    const auto wi = to_world(sample.wi, frame);

    const F values[] = {wi.x, wi.y, wi.z, sample.weight * fresnel, sample.pdf};
    float* const columns[] = {hits.wi[0], hits.wi[1], hits.wi[2], hits.weight, hits.pdf};
    for (int c = 0; c < 5; ++c) lanes::op::store(values[c], columns[c] + i);
  }
}
