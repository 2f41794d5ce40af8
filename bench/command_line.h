// How the programs of this folder take their arguments.
#pragma once

#include <cstdlib>
#include <string>

#include <CLI/CLI.hpp>

namespace bench {

/// An option that takes a whole number from `from` to `to`; what `value` holds is the default.
template <class Number>
void add_number(CLI::App& app, const char* name, Number& value, const char* description, int from, int to) {
  app.add_option(name, value, description)->capture_default_str()->check(CLI::Range(from, to));
}

/// Reads the arguments and answers --help. Wrong ones end the program with status 2 and one line that says why.
inline void parse(CLI::App& app, int argc, char** argv) {
  app.failure_message([](const CLI::App* program, const CLI::Error& error) {
    return program->get_name() + ": " + error.what() + " (--help tells what is accepted)\n";
  });
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error) == 0 ? 0 : 2);
  }
}

}  // namespace bench
