// Textures, and files of pictures: EXR and PNG.
#include <filesystem>

#include <ImathFun.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <png.h>

#include "render.h"

namespace wavefront {
namespace {

/// Of Vec3 pixels, whose first has the coordinates of the window's corner.
Imf::FrameBuffer frame_buffer(const Vec3* pixels, const Imath::Box2i& window) {
  auto stride = static_cast<std::size_t>(window.size().x + 1) * sizeof(Vec3);
  Imf::FrameBuffer buffer;
  const float* first = &pixels->x;
  for (const char* name : {"R", "G", "B"})
    buffer.insert(name, Imf::Slice::Make(Imf::FLOAT, first++, window, sizeof(Vec3), stride));
  return buffer;
}

Texture read_exr(const std::string& file) try {
  Imf::InputFile input(file.c_str(), 1);
  if (!input.header().channels().findChannel("R")) fail(file, "has no channel R");
  auto window = input.header().dataWindow();
  Texture t{window.size().x + 1, window.size().y + 1, {}};
  t.texels.resize(static_cast<std::size_t>(t.width) * t.height);
  input.setFrameBuffer(frame_buffer(t.texels.data(), window));
  input.readPixels(window.min.y, window.max.y);
  return t;
} catch (const Iex::BaseExc&) {
  fail(file, "cannot be read as EXR");
}

Texture read_png(const std::string& file, bool colors) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_file(&image, file.c_str())) fail(file, image.message);
  image.format = colors ? PNG_FORMAT_LINEAR_RGB : PNG_FORMAT_RGB;  // 16 bits, or 8
  Texture t{static_cast<int>(image.width), static_cast<int>(image.height), {}};
  std::vector<png_uint_16> words(3 * static_cast<std::size_t>(image.width) * image.height);
  if (!png_image_finish_read(&image, nullptr, words.data(), 0, nullptr)) fail(file, image.message);
  const auto* bytes = reinterpret_cast<const png_byte*>(words.data());
  auto value = [&](std::size_t i) { return colors ? words[i] / 65535.f : bytes[i] / 255.f; };
  for (std::size_t i = 0; i < words.size(); i += 3) t.texels.push_back({value(i), value(i + 1), value(i + 2)});
  return t;
}

/// A shoulder that takes 0 to 0 and brightness without end to 1, with colours that fade to white as film does.
float film_curve(float a) {
  a = std::max(0.f, a);
  return a * (a * 2.51f + 0.03f) / (a * (a * 2.43f + 0.59f) + 0.14f);  // Narkowicz 2015, a fit of ACES
}

/// uv in texels.
Vec2 place(const Texture& t, Vec2 uv) {
  return {(uv.x - std::floor(uv.x)) * t.width, (1.f - (uv.y - std::floor(uv.y))) * t.height};
}
/// The texel of a column and a row, which wrap around.
const Vec3& texel(const Texture& t, float x, float y) {
  int column = Imath::modp(static_cast<int>(x), t.width), row = Imath::modp(static_cast<int>(y), t.height);
  return t.texels[static_cast<std::size_t>(row) * t.width + column];
}

}  // namespace

Vec3 Texture::nearest(Vec2 uv) const {
  Vec2 p = place(*this, uv);
  return texel(*this, p.x, p.y);
}
Vec3 Texture::look_up(Vec2 uv) const {
  Vec2 p = place(*this, uv) - Vec2(0.5f), first(std::floor(p.x), std::floor(p.y)), share = p - first;
  auto row = [&](float y) { return Imath::lerp(texel(*this, first.x, y), texel(*this, first.x + 1.f, y), share.x); };
  return Imath::lerp(row(first.y), row(first.y + 1.f), share.y);
}

Texture read_texture(const std::string& file, bool colors) {
  auto extension = std::filesystem::path(file).extension();
  if (extension != ".png" && extension != ".exr") fail(file, "is neither .exr nor .png");
  Texture texture = extension == ".png" ? read_png(file, colors) : read_exr(file);
  for (const Vec3& t : texture.texels)
    if (!std::isfinite(t.x + t.y + t.z)) fail(file, "has a texel that is not finite");
  return texture;
}

void write_exr(const std::string& file, const Task& task, const std::vector<Vec3>& pixels) try {
  const Imath::V2i one(1);
  Imath::Box2i window(task.crop.min, task.crop.max - one);
  Imf::Header header({{0, 0}, task.size - one}, window);
  for (const char* name : {"R", "G", "B"}) header.channels().insert(name, Imf::Channel(Imf::FLOAT));
  Imf::OutputFile output(file.c_str(), header, 1);
  output.setFrameBuffer(frame_buffer(pixels.data(), window));
  output.writePixels(task.crop.size().y);
} catch (const Iex::BaseExc&) {
  fail(file, "cannot be written");
}

void write_png(const std::string& file, const Task& task, const std::vector<Vec3>& pixels) {
  std::vector<png_uint_16> words;  // linear: libpng makes sRGB of them
  for (const Vec3& p : pixels)
    for (float v : {p.x, p.y, p.z})
      words.push_back(static_cast<png_uint_16>(65535.f * std::min(1.f, film_curve(v)) + 0.5f));
  png_image image{};
  image.version = PNG_IMAGE_VERSION, image.format = PNG_FORMAT_LINEAR_RGB;
  image.width = task.crop.size().x, image.height = task.crop.size().y;
  if (!png_image_write_to_file(&image, file.c_str(), 1, words.data(), 0, nullptr)) fail(file, image.message);
}

}  // namespace wavefront
