// The few options of the report's programs.
#pragma once

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace report {

/// Reads `--name value` and `--name=value` from left to right.
class Arguments {
 public:
  Arguments(int argc, char** argv) : next_(argv + 1), end_(argv + argc), program_(argv[0]) {
    if (const char* slash = std::strrchr(program_, '/')) program_ = slash + 1;
  }

  bool more() const { return next_ != end_; }

  /// Whether the next argument is this option.
  bool is(const char* option) const {
    std::size_t length = std::strlen(option);
    return std::strncmp(*next_, option, length) == 0 && ((*next_)[length] == '\0' || (*next_)[length] == '=');
  }

  void skip() { ++next_; }

  std::string value() {
    const char* option = *next_++;
    if (const char* equals = std::strchr(option, '=')) return equals + 1;
    if (next_ == end_) fail(std::string(option) + " needs a value");
    return *next_++;
  }

  long long number(long long from, long long to) {
    std::string option = *next_, text = value();
    char* rest = nullptr;
    errno = 0;
    long long number = std::strtoll(text.c_str(), &rest, 10);
    if (text.empty() || *rest || errno || number < from || number > to) {
      fail(option + ": expected an integer from " + std::to_string(from) + " to " + std::to_string(to) + ", not '" +
           text + "'");
    }
    return number;
  }

  /// Answers the options that all programs have, and says whether this was one.
  bool common(const char* help, std::string& out) {
    if (is("--help")) {
      std::fputs(help, stdout);
      std::exit(0);
    }
    if (!is("--out")) return false;
    out = value();
    return true;
  }

  [[noreturn]] void unknown() const { fail(std::string("unknown argument '") + *next_ + "'"); }

  /// One line on stderr, status 2.
  [[noreturn]] void fail(const std::string& message) const {
    std::fprintf(stderr, "%s: %s (--help tells the options)\n", program_, message.c_str());
    std::exit(2);
  }

 private:
  char** next_;
  char** end_;
  const char* program_;
};

/// The file named, or stdout for "-". Exits with status 1 and the reason if it cannot be written.
inline std::FILE* open_output(const std::string& path) {
  if (path == "-") return stdout;
  std::FILE* file = std::fopen(path.c_str(), "w");
  if (!file) {
    std::perror(path.c_str());
    std::exit(1);
  }
  return file;
}

/// Closes it and exits with status 1 unless everything was written.
inline void close_output(std::FILE* file, const std::string& path) {
  bool failed = std::ferror(file) != 0;
  failed |= file == stdout ? std::fflush(file) != 0 : std::fclose(file) != 0;
  if (failed) {
    std::fprintf(stderr, "%s: could not be written\n", path.c_str());
    std::exit(1);
  }
}

}  // namespace report
