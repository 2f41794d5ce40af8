// The benchmark's inputs: batches of views, roughness and random numbers, the same on every run and machine.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>

namespace bench {

// wo.x, wo.y, wo.z, alpha_x, alpha_y, u1, u2; what some operations read besides: u3, theta_x, theta_y, theta_z, and
// directions of light, and their z with the sign of theta_x: above and below
constexpr std::size_t kInputs = 15;
// wm.x, wm.y, wm.z, wi.x, wi.y, wi.z, pdf, weight; and what some write besides: side, wo_dot_wm, wi_dot_wm, reflectance
constexpr std::size_t kOutputs = 12;

/// The columns of one batch, in the order of the constants above. `arena` owns the floats.
struct Batch {
  std::size_t count = 0;
  std::array<float*, kInputs> in{};
  std::array<float*, kOutputs> out{};
  std::shared_ptr<float[]> arena;
};

/// Where columns begin: `aligned` to 64 bytes, or each at an odd number of floats behind such an address, all
/// different.
enum class Offset { aligned, unaligned };

/// Columns of zeros.
///
/// Between two columns lie a few cache lines: columns of 2^k floats without them begin at the same set of the first
/// level cache, which has fewer ways than a batch has columns. A renderer pads its queues for the same reason.
Batch make_columns(std::size_t count, Offset offset = Offset::aligned);

/// Fills the inputs with what a renderer queues for one frame: a pinhole camera over a ground plane and a field of
/// spheres, pixel by pixel, rays into the sky left out. wo is the view in a frame of the hit's normal, silhouettes and
/// the far ground included; alpha comes from a procedural texture between 0.001 and 1, brushed (alpha_x != alpha_y) on
/// the ground's tiles and on every third sphere. The frame's resolution follows `count`, so every count sees the whole
/// picture.
void fill_camera(const Batch& batch);

/// Fills the inputs with views uniform over the upper hemisphere and alpha_x, alpha_y log-uniform in [0.01, 1].
void fill_uniform(const Batch& batch);

/// The batch that the middle part of a benchmark's name asks for: "camera", "uniform", "camera_unaligned". Throws
/// std::invalid_argument for any other name.
Batch make_batch(const std::string& input, std::size_t count);

}  // namespace bench
