// vndf_wavefront: renders a scene, or a part of a frame for a farm.
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>

#include "environment.h"
#include "options.h"

namespace {

using namespace wavefront;

std::atomic<bool> interrupted{false};

Scene scene_of(const Options& options) {
  Scene scene = options.scene.empty() ? default_scene() : read_obj(options.scene);
  if (!options.environment.empty())
    scene.environment = environment_of_latlong(read_texture(options.environment, false));
  else if (!options.scene.empty())
    scene.environment = default_scene().environment;
  if (const auto& c = options.camera; !c.empty()) {
    scene.camera = {{c[0], c[1], c[2]}, {c[3], c[4], c[5]}, c[6]};
    float distance = length(scene.camera.at - scene.camera.from);
    if (!(distance > 0.f && distance < 1e18f && c[6] > 0.f && c[6] < 179.f))
      throw std::runtime_error("--camera: looks nowhere");
  }
  scene.finish(options.embree);
  return scene;
}

/// A bar and the time that is left, where someone looks.
class Progress {
 public:
  explicit Progress(bool show) : show_(show && isatty(STDERR_FILENO)) {}
  ~Progress() {
    if (show_) std::fputs("\n", stderr);
  }
  void operator()(double share) {
    using namespace std::chrono;
    auto now = steady_clock::now();
    if (!show_ || (share < 1. && now - last_ < milliseconds(200))) return;
    last_ = now;
    double left = duration<double>(now - begin_).count() * (1. / share - 1.);
    char bar[41] = {};
    for (int i = 0; i < 40; ++i) bar[i] = i < share * 40. ? '#' : '.';
    std::fprintf(stderr, "\r%s %3.0f %%  %.0f s left ", bar, 100. * share, left);
  }

 private:
  bool show_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now(), last_ = begin_;
};

void write_statistics(const std::string& file, const Picture& picture, const Options& options) {
  const Statistics& s = picture.statistics;
  std::ofstream out(file);
  out << "{\"isa\": \"" << vndf::active_isa() << "\", \"threads\": " << options.task.threads
      << ", \"seconds\": " << picture.seconds << ", \"paths\": " << s.paths << ", \"vertices\": " << s.vertices
      << ", \"shaded_by_library\": " << s.shaded_by_library << ", \"shadow_rays\": " << s.shadow_rays
      << ", \"bytes_per_path\": " << kBytesPerPath << ", \"stages\": {";
  for (int i = 0; i < kStages; ++i) out << (i > 0 ? ", \"" : "\"") << kStageNames[i] << "\": " << s.seconds[i];
  out << "}}\n";
  if (!out) throw std::runtime_error(file + ": cannot be written");
}

void run(const Options& options) {
  Scene scene = scene_of(options);
  std::signal(SIGINT, [](int) { interrupted = true; });
  Picture picture;
  {
    Progress progress(!options.quiet);
    picture = render(scene, options.task, interrupted, std::ref(progress));
  }
  const Task& task = options.task;
  write_exr(options.out, task.settings.width, task.settings.height, task.crop, picture.pixels);
  if (!options.png.empty()) write_png(options.png, task.crop, picture.pixels, options.exposure);
  if (!options.statistics.empty()) write_statistics(options.statistics, picture, options);
  std::printf("%s%s: %.1f s, %.2f million vertices a second, on %s\n", options.out.c_str(),
              picture.complete ? "" : " (not all samples)", picture.seconds,
              1e-6 * static_cast<double>(picture.statistics.vertices) / picture.seconds, vndf::active_isa());
}

}  // namespace

int main(int argc, char** argv) {
  Options options = parse_options(argc, argv);
  try {
    run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "vndf_wavefront: %s\n", error.what());
    return 2;
  }
  return 0;
}
