#include "options.h"

#include "sobol.h"

#include <cstdio>
#include <cstdlib>
#include <map>

#include <CLI/CLI.hpp>

namespace wavefront {
namespace {

/// Whole numbers with these characters between them, and nothing else.
template <std::size_t count>
bool read_numbers(const std::string& text, char separator, int (&numbers)[count]) {
  const char* at = text.c_str();
  for (std::size_t i = 0; i < count; ++i) {
    char* end;
    long value = std::strtol(at, &end, 10);
    if (end == at || value < 0 || value > 65536 || *end != (i + 1 < count ? separator : '\0')) return false;
    numbers[i] = static_cast<int>(value);
    at = end + 1;
  }
  return true;
}

void require(bool good, const char* option, const char* what) {
  if (!good) throw CLI::ValidationError(option, what);
}

}  // namespace

Options parse_options(int argc, char** argv) {
  Options options;
  Task& task = options.task;
  int spp = 64;
  std::string size = "960x540", crop, samples;
  const std::map<std::string, Sampler> samplers{
      {"vndf", Sampler::vndf}, {"bounded", Sampler::bounded}, {"ndf", Sampler::ndf}};
  const std::map<std::string, vndf::Warp> warps{{"polar", vndf::Warp::polar},
                                                {"concentric", vndf::Warp::concentric},
                                                {"spherical_cap", vndf::Warp::spherical_cap}};
  const std::map<std::string, bool> switches{{"on", true}, {"off", false}};

  CLI::App app("Renders a scene with the shading step of vndf.", "vndf_wavefront");
  app.add_option("--scene", options.scene, "an OBJ file; without, the scene made by code");
  app.add_option("--environment", options.environment, "light from far away: a latitude-longitude map in EXR, y up");
  app.add_option("--camera", options.camera, "from, at and width in degrees: x,y,z,x,y,z,f");
  app.add_option("--spp", spp, "samples per pixel")
      ->check(CLI::Range(1, static_cast<int>(kMostSamples)))
      ->capture_default_str();
  app.add_option("--size", size, "width x height")->capture_default_str();
  app.add_option("--crop", crop, "x0,y0,x1,y1: this part of the frame alone");
  app.add_option("--samples", samples, "a:b: samples a to b - 1 of each pixel, in place of --spp");
  app.add_option("--sampler", task.settings.sampling.sampler, "vndf, bounded (plain GGX) or ndf (metals and coats)")
      ->transform(CLI::CheckedTransformer(samplers));
  app.add_option("--warp", task.settings.sampling.warp, "polar, concentric or spherical_cap")
      ->transform(CLI::CheckedTransformer(warps));
  app.add_option("--mis", task.settings.mis, "off: light is found by the BSDF alone")
      ->transform(CLI::CheckedTransformer(switches));
  app.add_option("--seed", task.settings.seed, "of the random numbers")->capture_default_str();
  app.add_option("--isa", options.isa, "the library's instruction set");
  app.add_option("--embree", options.embree, "Embree's own configuration, as isa=sse4.2");
  app.add_option("--threads", task.threads, "0: as many as there are")->check(CLI::Range(0, 1024));
  app.add_option("--time-limit", task.time_limit, "in seconds; what there is then is written")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--out", options.out, "the picture, EXR")->capture_default_str();
  app.add_option("--png", options.png, "the picture, tone-mapped");
  app.add_option("--exposure", options.exposure, "of the PNG, a factor")->capture_default_str();
  app.add_option("--statistics", options.statistics, "where times and counts go, JSON");
  app.add_flag("--quiet", options.quiet, "no progress bar");
  app.failure_message([](const CLI::App* program, const CLI::Error& error) {
    return program->get_name() + ": " + error.what() + " (--help tells what is accepted)\n";
  });
  try {
    app.parse(argc, argv);
    int numbers[4], range[2] = {0, spp};
    require(read_numbers(size, 'x', range) && range[0] > 0 && range[1] > 0, "--size", "is not as 960x540");
    task.settings.width = range[0], task.settings.height = range[1];
    task.crop = {0, 0, range[0], range[1]};
    if (!crop.empty()) {
      require(read_numbers(crop, ',', numbers), "--crop", "is not four numbers as 0,0,480,270");
      task.crop = {numbers[0], numbers[1], numbers[2], numbers[3]};
      require(task.crop.x0 < task.crop.x1 && task.crop.y0 < task.crop.y1 && task.crop.x1 <= task.settings.width &&
                  task.crop.y1 <= task.settings.height,
              "--crop", "is empty, or not within the frame");
    }
    range[0] = 0, range[1] = spp;
    require(samples.empty() || (read_numbers(samples, ':', range) && range[0] < range[1]), "--samples",
            "is not as 0:64");
    task.first_sample = static_cast<std::uint32_t>(range[0]), task.last_sample = static_cast<std::uint32_t>(range[1]);
    auto error = options.isa.empty() ? vndf::IsaError::none : vndf::set_isa(options.isa.c_str());
    require(error == vndf::IsaError::none, "--isa", vndf::message(error));
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error) == 0 ? 0 : 2);
  }
  return options;
}

}  // namespace wavefront
