// vndf_wavefront: renders a scene, or a part of a frame for a farm.
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

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
  double time_limit = 0.;
};

void require(bool good, const char* option, const char* what) {
  if (!good) throw CLI::ValidationError(option, what);
}

/// Ends the program after --help, and with status 2 and one line where an argument is wrong.
Options parse_options(int argc, char** argv) {
  Options options;
  Task& task = options.task;
  int spp = 64;
  std::vector<int> size{task.size.x, task.size.y}, crop, samples;
  using CLI::Range, vndf::Warp;
  const std::map<std::string, Sampler> samplers{
      {"vndf", Sampler::vndf}, {"bounded", Sampler::bounded}, {"ndf", Sampler::ndf}};
  const std::map<std::string, Warp> warps{
      {"polar", Warp::polar}, {"concentric", Warp::concentric}, {"spherical_cap", Warp::spherical_cap}};
  const int most = static_cast<int>(kMostSamples);

  CLI::App app("Renders a scene with the shading step of vndf.", "vndf_wavefront");
  auto add = [&](const char* name, auto& to, const char* what) { return app.add_option(name, to, what); };
  add("--scene", options.scene, "an OBJ file; without, the scene made by code");
  add("--environment", options.environment, "light from far away: a latitude-longitude map in EXR, y up");
  add("--camera", options.camera, "from, at and width in degrees: x,y,z,x,y,z,f")->delimiter(',')->expected(7);
  add("--spp", spp, "samples per pixel (64)")->check(Range(1, most));
  add("--size", size, "width x height (960x540)")->delimiter('x')->expected(2)->check(Range(1, 65536));
  add("--crop", crop, "x0,y0,x1,y1: this part of the frame")->delimiter(',')->expected(4)->check(Range(0, 65536));
  add("--samples", samples, "a:b: samples a to b - 1, not --spp")->delimiter(':')->expected(2)->check(Range(0, most));
  add("--sampler", task.sampling.sampler, "vndf, bounded (plain GGX) or ndf (metals and coats)")
      ->transform(CLI::CheckedTransformer(samplers));
  add("--warp", task.sampling.warp, "polar, concentric or spherical_cap")->transform(CLI::CheckedTransformer(warps));
  add("--seed", task.seed, "of the random numbers (0)");
  add("--isa", options.isa, "the library's instruction set");
  add("--embree", options.embree, "Embree's own configuration, as isa=sse4.2");
  add("--threads", task.threads, "0: as many as there are")->check(Range(0, 1024));
  add("--time-limit", options.time_limit, "in seconds; what there is then is written");
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
    require(options.time_limit >= 0., "--time-limit", "is no time");
    for (const std::filesystem::path file : {options.out, options.png, options.statistics})  // before the hours of work
      require(file.parent_path().empty() || is_directory(file.parent_path()), file.c_str(), "is in no folder");
    auto error = options.isa.empty() ? vndf::IsaError::none : vndf::set_isa(options.isa.c_str());
    require(error == vndf::IsaError::none, "--isa", vndf::message(error));
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error) == 0 ? 0 : 2);
  }
  task.size = {size[0], size[1]};
  task.crop = {{crop[0], crop[1]}, {crop[2], crop[3]}};
  task.first_sample = samples[0], task.last_sample = samples[1];
  return options;
}

Scene scene_of(const Options& options) {
  Scene scene = options.scene.empty() ? default_scene() : read_obj(options.scene);
  if (!options.environment.empty())
    scene.environment = environment_of_latlong(read_texture(options.environment, false));
  if (const auto& c = options.camera; !c.empty()) {
    scene.camera = {{c[0], c[1], c[2]}, {c[3], c[4], c[5]}, c[6]};
    float distance = (scene.camera.at - scene.camera.from).length();
    if (!(distance > 0.f && distance < 1e18f && c[6] > 0.f && c[6] < 179.f)) fail("--camera", "looks nowhere");
  }
  list_lights(scene);
  build_tree(scene, options.embree);
  return scene;
}

std::atomic<bool> interrupted{false};

void run(const Options& options) {
  std::signal(SIGINT, [](int) { interrupted = true; });
  Scene scene = scene_of(options);
  using Time = std::chrono::steady_clock;
  auto begin = Time::now();
  auto seconds = [&] { return std::chrono::duration<double>(Time::now() - begin).count(); };
  // A bar and the time that is left, where someone looks.
  const bool show = isatty(STDERR_FILENO);
  double shown = 0.;
  Picture picture = render(scene, options.task, [&](double share) {
    double now = seconds();
    if (show && (share == 1. || now > shown + 0.2)) {
      std::string bar(static_cast<std::size_t>(40. * share), '#');
      std::fprintf(stderr, "\r%-40s %3.0f %%  %.0f s left ", bar.c_str(), 100. * share, now / share - now);
      shown = now;
    }
    return !interrupted && !(options.time_limit > 0. && now > options.time_limit);
  });
  double all = picture.statistics["seconds"] = seconds();
  if (show) std::fputs("\n", stderr);
  write_exr(options.out, options.task, picture.pixels);
  if (!options.png.empty()) write_png(options.png, options.task, picture.pixels);
  if (!options.statistics.empty()) {
    std::ofstream out(options.statistics);
    if (!(out << nlohmann::json(picture.statistics))) fail(options.statistics, "cannot be written");
  }
  std::printf("%s%s: %.1f s, %.2f million vertices a second, on %s\n", options.out.c_str(),
              picture.complete ? "" : " (not all samples)", all, 1e-6 * picture.statistics["vertices"] / all,
              vndf::active_isa());
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(parse_options(argc, argv));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "vndf_wavefront: %s\n", error.what());
    return 2;
  }
}
