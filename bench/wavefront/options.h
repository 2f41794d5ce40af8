// The command line.
#pragma once

#include <string>

#include "render.h"

namespace wavefront {

struct Options {
  Task task;
  std::string scene, environment;  // empty: the default ones
  std::vector<float> camera;       // seven numbers, or none
  std::string out = "wavefront.exr", png, statistics;
  std::string isa, embree;  // empty: the library's and Embree's choice
  float exposure = 1.f;
  bool quiet = false;
};

/// Ends the program after --help, and with status 2 and one line where an argument is wrong.
Options parse_options(int argc, char** argv);

}  // namespace wavefront
