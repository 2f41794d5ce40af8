// Files of pictures: EXR and PNG.
#pragma once

#include <string>

#include "scene.h"

namespace wavefront {

/// Reads .exr (linear) or .png; 8-bit values are made linear if they are `colors`, else divided by 255.
Texture read_texture(const std::string& file, bool colors);

/// A window [x0, x1) x [y0, y1) of a frame.
struct Window {
  int x0, y0, x1, y1;
};
/// 32-bit RGB with `window` as data window and the frame as display window. No date and no name: equal pixels are equal
/// files.
void write_exr(const std::string& file, int width, int height, const Window& window, const std::vector<Vec3>& pixels);
/// Tone-mapped, sRGB, 8 bits, the window alone.
void write_png(const std::string& file, const Window& window, const std::vector<Vec3>& pixels, float exposure);

}  // namespace wavefront
