// Where a queue meets the library: one batch of vertices of one kind of surface.
#pragma once

#include <vndf/ellipsoid.h>
#include <vndf/vndf.h>

#include "queues.h"

namespace wavefront {

enum class Sampler { vndf, bounded, ndf };
struct Sampling {
  Sampler sampler = Sampler::vndf;
  vndf::Warp warp = vndf::Warp::concentric;
};

/// Columns of a batch, in the local shading frame. Views from below are within glass, and mirrored for all else.
struct Batch {
  std::uint32_t count = 0;
  Columns3 wo{kBatch}, u{kBatch};
  Column<float> alpha_x{kBatch}, alpha_y{kBatch}, theta_z{kBatch}, eta{kBatch};
  Columns3 light{kBatch};  // where light was sampled
  // Made by shade_batch: the next direction, and what light from either direction counts, without Fresnel's factor but
  // for glass. Cosines are those of the view to the microfacet's normal.
  Columns3 wi{kBatch}, normal{kBatch};
  Column<float> pdf{kBatch}, weight{kBatch}, side{kBatch}, cosine{kBatch};
  Column<float> light_f_cos{kBatch}, light_pdf{kBatch}, light_cosine{kBatch};
  Column<float> spare{kBatch};
};

/// Samples the BSDF and evaluates it for the light. `shape` is that of leaning surfaces.
void shade_batch(Kind kind, const vndf::Ellipsoid& shape, const Sampling& sampling, Batch& batch);
/// f cos and pdf of the directions wi, into weight and pdf: for mixtures.
void evaluate_batch(const Sampling& sampling, Batch& batch);

}  // namespace wavefront
