#include "options.h"

#include "sobol.h"

#include <cstdlib>
#include <map>

#include <CLI/CLI.hpp>

namespace wavefront {
namespace {

void require(bool good, const char* option, const char* what) {
  if (!good) throw CLI::ValidationError(option, what);
}

}  // namespace

Options parse_options(int argc, char** argv) {
  Options options;
  Task& task = options.task;
  int spp = 64;
  std::vector<int> size{960, 540}, crop, samples;
  const std::map<std::string, Sampler> samplers{
      {"vndf", Sampler::vndf}, {"bounded", Sampler::bounded}, {"ndf", Sampler::ndf}};
  const std::map<std::string, vndf::Warp> warps{{"polar", vndf::Warp::polar},
                                                {"concentric", vndf::Warp::concentric},
                                                {"spherical_cap", vndf::Warp::spherical_cap}};
  const std::map<std::string, bool> switches{{"on", true}, {"off", false}};

  CLI::App app("Renders a scene with the shading step of vndf.", "vndf_wavefront");
  app.add_option("--scene", options.scene, "an OBJ file; without, the scene made by code");
  app.add_option("--environment", options.environment, "light from far away: a latitude-longitude map in EXR, y up");
  app.add_option("--camera", options.camera, "from, at and width in degrees: x,y,z,x,y,z,f")
      ->delimiter(',')
      ->expected(7);
  app.add_option("--spp", spp, "samples per pixel")
      ->check(CLI::Range(1, static_cast<int>(kMostSamples)))
      ->capture_default_str();
  app.add_option("--size", size, "width x height (960x540)")->delimiter('x')->expected(2)->check(CLI::Range(1, 65536));
  app.add_option("--crop", crop, "x0,y0,x1,y1: this part of the frame alone")
      ->delimiter(',')
      ->expected(4)
      ->check(CLI::Range(0, 65536));
  app.add_option("--samples", samples, "a:b: samples a to b - 1 of each pixel, in place of --spp")
      ->delimiter(':')
      ->expected(2)
      ->check(CLI::Range(0, static_cast<int>(kMostSamples)));
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
    if (crop.empty()) crop = {0, 0, size[0], size[1]};
    if (samples.empty()) samples = {0, spp};
    require(crop[0] < crop[2] && crop[1] < crop[3] && crop[2] <= size[0] && crop[3] <= size[1], "--crop",
            "is empty, or not within the frame");
    require(samples[0] < samples[1], "--samples", "is empty");
    task.settings.width = size[0], task.settings.height = size[1];
    task.crop = {crop[0], crop[1], crop[2], crop[3]};
    task.first_sample = static_cast<std::uint32_t>(samples[0]),
    task.last_sample = static_cast<std::uint32_t>(samples[1]);
    auto error = options.isa.empty() ? vndf::IsaError::none : vndf::set_isa(options.isa.c_str());
    require(error == vndf::IsaError::none, "--isa", vndf::message(error));
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error) == 0 ? 0 : 2);
  }
  return options;
}

}  // namespace wavefront
