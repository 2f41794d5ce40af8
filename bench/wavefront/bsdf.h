// Where a queue meets the library: one batch of vertices of one kind of surface.
#pragma once

#include <vndf/vndf.h>

#include "scene.h"

namespace wavefront {

/// Vertices that one call of the library takes. Not a power of two: see queues.h.
constexpr std::uint32_t kBatch = 496;

template <std::uint32_t N>
struct Columns3 {
  float x[N], y[N], z[N];

  Vec3 get(std::uint32_t i) const { return {x[i], y[i], z[i]}; }
  void set(std::uint32_t i, Vec3 v) { x[i] = v.x, y[i] = v.y, z[i] = v.z; }
  void add(std::uint32_t i, Vec3 v) { set(i, get(i) + v); }
  operator vndf::Columns3() const { return {x, y, z}; }
  operator vndf::Out3() { return {x, y, z}; }
};

enum class Sampler { vndf, bounded, ndf };
struct Sampling {
  Sampler sampler = Sampler::vndf;
  vndf::Warp warp = vndf::Warp::concentric;
};

/// A direction at each vertex and what light from there counts, without Fresnel's factor but for glass: f cos, but
/// f cos / pdf of directions that were sampled. The cosine is that of the view to the microfacet's normal.
struct Directions {
  Columns3<kBatch> w;
  float value[kBatch], pdf[kBatch], cosine[kBatch];
};
struct Batch {
  std::uint32_t count = 0;

  // The library's columns, in the local shading frame. Views from below are within glass, and mirrored for all else.
  Columns3<kBatch> wo, u;
  float alpha_x[kBatch], alpha_y[kBatch], theta_x[kBatch], theta_y[kBatch], theta_z[kBatch], eta[kBatch];
  Directions light, next;
  Columns3<kBatch> scratch;
  float spare[kBatch];

  // What else the renderer knows of the vertices.
  std::uint32_t path[kBatch];
  const Material* material[kBatch];
  Surface surface[kBatch];
  Frame frame[kBatch];
  Vec3 color[kBatch];
  Columns3<kBatch> light_u;
  LightSample light_sample[kBatch];
  float keep[kBatch];  // the random number of Russian roulette
};

/// Samples the BSDF for `next`, and evaluates it for `light`.
void shade_batch(Kind kind, const Sampling& sampling, Batch& batch);
/// f cos and pdf of coats for the directions of `next`: for mixtures.
void evaluate_coat(const Sampling& sampling, Batch& batch);

}  // namespace wavefront
