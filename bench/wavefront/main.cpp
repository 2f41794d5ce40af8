// vndf_wavefront: renders a scene, or a part of a frame for a farm.
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <map>
#include <stdexcept>

#include <CLI/CLI.hpp>

#include "intersect.h"
#include "render.h"
#include "sobol.h"

namespace {

using namespace wavefront;

struct Options {
  Task task;
  std::string scene, environment;  // empty: the default ones
  std::vector<float> camera;       // seven numbers, or none
  std::string out = "wavefront.exr", png, statistics;
  std::string isa, embree;  // empty: the library's and Embree's choice
};

void require(bool good, const char* option, const char* what) {
  if (!good) throw CLI::ValidationError(option, what);
}

/// Ends the program after --help, and with status 2 and one line where an argument is wrong.
Options parse_options(int argc, char** argv) {
  Options options;
  Task& task = options.task;
  const int most = static_cast<int>(kMostSamples);
  int spp = 64;
  std::vector<int> size{task.width, task.height}, crop, samples;
  const std::map<std::string, Sampler> samplers{
      {"vndf", Sampler::vndf}, {"bounded", Sampler::bounded}, {"ndf", Sampler::ndf}};
  const std::map<std::string, vndf::Warp> warps{{"polar", vndf::Warp::polar},
                                                {"concentric", vndf::Warp::concentric},
                                                {"spherical_cap", vndf::Warp::spherical_cap}};

  CLI::App app("Renders a scene with the shading step of vndf.", "vndf_wavefront");
  auto add = [&](const char* name, auto& to, const char* what) { return app.add_option(name, to, what); };
  auto add_list = [&](const char* name, auto& to, char separator, int count, const char* what) {
    return add(name, to, what)->delimiter(separator)->expected(count);
  };
  add("--scene", options.scene, "an OBJ file; without, the scene made by code");
  add("--environment", options.environment, "light from far away: a latitude-longitude map in EXR, y up");
  add_list("--camera", options.camera, ',', 7, "from, at and width in degrees: x,y,z,x,y,z,f");
  add("--spp", spp, "samples per pixel (64)")->check(CLI::Range(1, most));
  add_list("--size", size, 'x', 2, "width x height (960x540)")->check(CLI::Range(1, 65536));
  add_list("--crop", crop, ',', 4, "x0,y0,x1,y1: this part of the frame alone")->check(CLI::Range(0, 65536));
  add_list("--samples", samples, ':', 2, "a:b: samples a to b - 1 of each pixel, in place of --spp")
      ->check(CLI::Range(0, most));
  add("--sampler", task.sampling.sampler, "vndf, bounded (plain GGX) or ndf (metals and coats)")
      ->transform(CLI::CheckedTransformer(samplers));
  add("--warp", task.sampling.warp, "polar, concentric or spherical_cap")->transform(CLI::CheckedTransformer(warps));
  add("--seed", task.seed, "of the random numbers (0)");
  add("--isa", options.isa, "the library's instruction set");
  add("--embree", options.embree, "Embree's own configuration, as isa=sse4.2");
  add("--threads", task.threads, "0: as many as there are")->check(CLI::Range(0, 1024));
  add("--time-limit", task.time_limit, "in seconds; what there is then is written");
  add("--out", options.out, "the picture, EXR (wavefront.exr)");
  add("--png", options.png, "the picture, tone-mapped");
  add("--statistics", options.statistics, "where times and counts go, JSON");
  app.failure_message([](const CLI::App* program, const CLI::Error& error) {
    return program->get_name() + ": " + error.what() + " (--help tells what is accepted)\n";
  });
  try {
    app.parse(argc, argv);
    if (crop.empty()) crop = {0, 0, size[0], size[1]};
    if (samples.empty()) samples = {0, spp};
    require(crop[0] < crop[2] && crop[1] < crop[3] && crop[2] <= size[0] && crop[3] <= size[1], "--crop",
            "is empty, or not within the frame");
    require(samples[0] < samples[1], "--samples", "is empty");
    require(task.time_limit >= 0., "--time-limit", "is no time");
    for (const std::filesystem::path file : {options.out, options.png, options.statistics})  // before the hours of work
      require(file.parent_path().empty() || is_directory(file.parent_path()), file.c_str(), "is in no folder");
    auto error = options.isa.empty() ? vndf::IsaError::none : vndf::set_isa(options.isa.c_str());
    require(error == vndf::IsaError::none, "--isa", vndf::message(error));
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error) == 0 ? 0 : 2);
  }
  task.width = size[0], task.height = size[1];
  task.crop = {crop[0], crop[1], crop[2], crop[3]};
  task.first_sample = static_cast<std::uint32_t>(samples[0]);
  task.last_sample = static_cast<std::uint32_t>(samples[1]);
  return options;
}

Scene scene_of(const Options& options) {
  Scene scene = options.scene.empty() ? default_scene() : read_obj(options.scene);
  if (!options.environment.empty())
    scene.environment = environment_of_latlong(read_texture(options.environment, false));
  else if (!options.scene.empty())
    scene.environment = default_scene().environment;
  if (const auto& c = options.camera; !c.empty()) {
    scene.camera = {{c[0], c[1], c[2]}, {c[3], c[4], c[5]}, c[6]};
    float distance = (scene.camera.at - scene.camera.from).length();
    if (!(distance > 0.f && distance < 1e18f && c[6] > 0.f && c[6] < 179.f))
      throw std::runtime_error("--camera: looks nowhere");
  }
  list_lights(scene);
  build_tree(scene, options.embree);
  return scene;
}

void write_statistics(const std::string& file, const Picture& picture, const Options& options) {
  std::ofstream out(file);
  out << std::setprecision(12) << "{\"isa\": \"" << vndf::active_isa() << "\", \"threads\": " << options.task.threads
      << ", \"seconds\": " << picture.seconds << ", \"bytes_per_path\": " << kBytesPerPath;
  for (std::size_t i = 0; i < std::size(kFigures); ++i) out << ", \"" << kFigures[i] << "\": " << picture.statistics[i];
  out << "}\n";
  if (!out) throw std::runtime_error(file + ": cannot be written");
}

std::atomic<bool> interrupted{false};

void run(const Options& options) {
  std::signal(SIGINT, [](int) { interrupted = true; });
  Scene scene = scene_of(options);
  // A bar and the time that is left, where someone looks.
  using Time = std::chrono::steady_clock;
  const bool show = isatty(STDERR_FILENO);
  Time::time_point begin = Time::now(), last = begin;
  Picture picture = render(scene, options.task, interrupted, [&](double share) {
    auto now = Time::now();
    if (!show || (share < 1. && now - last < std::chrono::milliseconds(200))) return;
    last = now;
    double left = std::chrono::duration<double>(now - begin).count() * (1. / share - 1.);
    std::string bar(static_cast<std::size_t>(40. * share), '#');
    std::fprintf(stderr, "\r%-40s %3.0f %%  %.0f s left ", bar.c_str(), 100. * share, left);
  });
  if (show) std::fputs("\n", stderr);
  const Task& task = options.task;
  write_exr(options.out, task.width, task.height, task.crop, picture.pixels);
  if (!options.png.empty()) write_png(options.png, task.crop, picture.pixels);
  if (!options.statistics.empty()) write_statistics(options.statistics, picture, options);
  std::printf("%s%s: %.1f s, %.2f million vertices a second, on %s\n", options.out.c_str(),
              picture.complete ? "" : " (not all samples)", picture.seconds,
              1e-6 * picture.statistics[Figure::vertices] / picture.seconds, vndf::active_isa());
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
