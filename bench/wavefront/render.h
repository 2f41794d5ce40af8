// A frame, or a part of one, on all threads.
#pragma once

#include <map>

#include <ImathBox.h>

#include "bsdf.h"

namespace wavefront {

struct Task {
  Sampling sampling;
  bool mis = true;
  std::uint32_t seed = 0;
  Imath::V2i size{960, 540};              // of the whole frame
  Imath::Box2i crop{{0, 0}, {960, 540}};  // its pixels from min on and before max
  int first_sample = 0, last_sample = 64;
  int threads = 0;  // 0: as many as there are
};

/// What is measured, by name: processor seconds of the stages, and counts. Vertices that are `shaded` are the
/// library's.
using Statistics = std::map<std::string, double>;
struct Picture {
  std::vector<Vec3> pixels;  // of the crop: means
  Statistics statistics;     // of all threads together
  bool complete = true;
};
/// `go_on` is told the share that is done, from any thread, one at a time. Where it answers no, what there is so far is
/// returned.
Picture render(const Scene& scene, const Task& task, const std::function<bool(double)>& go_on);

/// 32-bit RGB with the crop as data window and the frame as display window. No date and no name: equal pixels are equal
/// files.
void write_exr(const std::string& file, const Task& task, const std::vector<Vec3>& pixels);
/// Tone-mapped, sRGB, 8 bits, the crop alone.
void write_png(const std::string& file, const Task& task, const std::vector<Vec3>& pixels);

}  // namespace wavefront
