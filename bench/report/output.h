// Where the report's programs write their JSON.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

namespace report {

/// JSON whose keys stay in the order in which they are written, as the page lists them, and whose numbers have the
/// seven digits of a float.
using Json =
    nlohmann::basic_json<nlohmann::ordered_map, std::vector, std::string, bool, std::int64_t, std::uint64_t, float>;

/// How many threads measure unless told otherwise: at most 8, each needs memory.
inline unsigned cores() {
  return std::clamp(std::thread::hardware_concurrency(), 1u, 8u);
}

/// The option --out. The file is opened when the option is read: a path that cannot be written is told at once, not
/// after minutes.
class Output {
 public:
  explicit Output(CLI::App& app) {
    auto open = [this](const std::string& path) {
      if (path != "-") file_.open(path);
      return file_ ? std::string() : path + " cannot be written";
    };
    app.add_option("--out", path_, "where the JSON goes; - is standard output, progress is on standard error")
        ->capture_default_str()
        ->check(open);
  }

  /// Ends the program with status 1 unless all of it was written.
  void write(const Json& document) {
    std::ostream& stream = path_ == "-" ? std::cout : file_;
    stream << document << std::endl;
    if (stream) return;
    std::cerr << path_ << ": could not be written\n";
    std::exit(1);
  }

 private:
  std::string path_ = "-";
  std::ofstream file_;
};

}  // namespace report
