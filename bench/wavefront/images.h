// Pictures, and their files: EXR and PNG.
#pragma once

#include "scene.h"

namespace wavefront {

/// Part of a frame: pixels [x0, x1) x [y0, y1).
struct Window {
  int x0, y0, x1, y1;

  std::uint32_t width() const { return static_cast<std::uint32_t>(x1 - x0); }
  std::uint32_t height() const { return static_cast<std::uint32_t>(y1 - y0); }
  std::size_t pixels() const { return std::size_t(width()) * height(); }
};

/// Reads .exr (linear) or .png; 8-bit values are made linear if they are `colors`, else divided by 255.
Texture read_texture(const std::string& file, bool colors);
/// 32-bit RGB with `window` as data window and the frame as display window. No date and no name: equal pixels are equal
/// files.
void write_exr(const std::string& file, int width, int height, const Window& window, const std::vector<Vec3>& pixels);
/// Tone-mapped, sRGB, 8 bits, the window alone.
void write_png(const std::string& file, const Window& window, const std::vector<Vec3>& pixels);

}  // namespace wavefront
