// Which kernels a name runs. Compiled together with src/dispatch.cpp and, instead of the kernels, with tables whose
// functions note who was called: what dispatch does is then seen, not inferred. Built twice: over the library's rows,
// and over the rows in stub_rows/, one of which no machine supports.
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "kernel_table.h"

namespace {

thread_local std::string last_call;

void note(const char* isa, const char* function) {
  last_call = std::string(isa) + " " + function;
}

template <const char* isa, int warp>
void note_normals(std::size_t, const vndf::Columns3&, const vndf::Columns2&, const vndf::Columns2&,
                  const vndf::Out3&) noexcept {
  static const char* const names[] = {"normals polar", "normals concentric", "normals spherical_cap"};
  note(isa, names[warp]);
}
template <const char* isa, int map>
void note_disk(std::size_t, const vndf::Columns2&, const vndf::Out2&) noexcept {
  static const char* const names[] = {"disk polar", "disk concentric"};
  note(isa, names[map]);
}

struct Row {
  const char* name;
  bool supported;
};
const Row kRows[] = {
#define VNDF_ISA(name, supported) {#name, supported},
#include "isa_rows.h"
#undef VNDF_ISA
};

}  // namespace

namespace vndf {
#define VNDF_ISA(name, supported)                                                                            \
  static constexpr char name_of_##name[] = #name;                                                            \
  extern const KernelTable kernels_##name;                                                                   \
  const KernelTable kernels_##name = {                                                                       \
      {note_disk<name_of_##name, 0>, note_disk<name_of_##name, 1>},                                          \
      {{{note_normals<name_of_##name, 0>, note_normals<name_of_##name, 1>, note_normals<name_of_##name, 2>}, \
        {},                                                                                                  \
        {},                                                                                                  \
        {},                                                                                                  \
        {},                                                                                                  \
        {}},                                                                                                 \
       {}},                                                                                                  \
      {},                                                                                                    \
      {},                                                                                                    \
      {},                                                                                                    \
      {},                                                                                                    \
  };
#include "isa_rows.h"
#undef VNDF_ISA
}  // namespace vndf

namespace {

using namespace vndf;

std::string call_normals(Warp warp) {
  sample_normals(warp, 0, {0.f, 0.f, 1.f}, {1.f, 1.f}, {0.f, 0.f}, {});
  return last_call;
}
std::string call_disk(DiskMap map) {
  sample_disk(map, 0, {0.f, 0.f}, {});
  return last_call;
}

std::string best() {
  std::string name;
  for (const Row& row : kRows)
    if (row.supported) name = row.name;
  return name;
}

void expect_calls_on(const std::string& isa) {
  EXPECT_EQ(active_isa(), isa);
  EXPECT_EQ(call_normals(Warp::polar), isa + " normals polar");
  EXPECT_EQ(call_normals(Warp::concentric), isa + " normals concentric");
  EXPECT_EQ(call_normals(Warp::spherical_cap), isa + " normals spherical_cap");
  EXPECT_EQ(call_disk(DiskMap::polar), isa + " disk polar");
  EXPECT_EQ(call_disk(DiskMap::concentric), isa + " disk concentric");
}

TEST(Dispatch, ListsTheRows) {
  std::size_t i = 0;
  for (const Isa& isa : isas()) {
    ASSERT_LT(i, std::size(kRows));
    EXPECT_STREQ(isa.name, kRows[i].name);
    EXPECT_EQ(isa.supported, kRows[i].supported);
    ++i;
  }
  EXPECT_EQ(i, std::size(kRows));
}

TEST(Dispatch, EveryNameRunsItsKernels) {
  for (const Row& row : kRows) {
    std::string before = active_isa();
    IsaError error = set_isa(row.name);
    if (row.supported) {
      EXPECT_EQ(error, IsaError::none);
      expect_calls_on(row.name);
    } else {
      EXPECT_EQ(error, IsaError::unsupported);
      expect_calls_on(before);
    }
  }
}

TEST(Dispatch, UnknownNamesChangeNothing) {
  ASSERT_EQ(set_isa(kRows[0].name), IsaError::none);
  for (const char* name : {"", "sse2", "SCALAR", "scalar ", "scala", "scalarx", static_cast<const char*>(nullptr)}) {
    EXPECT_EQ(set_isa(name), IsaError::unknown) << (name ? name : "null");
    expect_calls_on(kRows[0].name);
  }
}

TEST(Dispatch, MessagesSayWhatIsWrong) {
  std::string unknown = message(IsaError::unknown);
  for (const Row& row : kRows) EXPECT_NE(unknown.find(row.name), std::string::npos) << unknown;
  EXPECT_NE(std::string(message(IsaError::unsupported)).find("support"), std::string::npos);
  EXPECT_STRNE(message(IsaError::none), message(IsaError::unknown));
  for (IsaError error : {IsaError::none, IsaError::unknown, IsaError::unsupported})
    EXPECT_EQ(std::string(message(error)).find('\n'), std::string::npos);
}

/// What a fresh process does under VNDF_ISA = value: "<set that ran>; <complaints> complaints", then what it wrote.
/// Many threads begin at once, each with its first call.
[[noreturn]] void report_first_calls(const char* value) {
  if (value)
    setenv("VNDF_ISA", value, 1);
  else
    unsetenv("VNDF_ISA");
  ::testing::internal::CaptureStderr();
  std::vector<std::thread> threads;
  std::vector<std::string> calls(8);
  for (std::string& call : calls) threads.emplace_back([&call] { call = call_disk(DiskMap::polar); });
  for (std::thread& thread : threads) thread.join();
  std::string written = ::testing::internal::GetCapturedStderr();
  int complaints = 0;
  for (std::size_t at = 0; (at = written.find("VNDF_ISA", at)) != std::string::npos; ++at) ++complaints;
  for (const std::string& call : calls)
    if (call != std::string(active_isa()) + " disk polar") std::fprintf(stderr, "threads disagree; ");
  std::fprintf(stderr, "ran %s; %d complaints; %s", calls[0].c_str(), complaints, written.c_str());
  std::exit(0);
}

class Environment : public ::testing::Test {
 protected:
  void SetUp() override { ::testing::FLAGS_gtest_death_test_style = "threadsafe"; }
  static void expect_first_calls(const char* value, const std::string& written) {
    EXPECT_EXIT(report_first_calls(value), ::testing::ExitedWithCode(0), written);
  }
};
// Googletest runs suites of this name first, each in a process that has not called the library.
using EnvironmentDeathTest = Environment;

TEST_F(EnvironmentDeathTest, UnsetOrEmptyPicksTheBest) {
  expect_first_calls(nullptr, "^ran " + best() + " disk polar; 0 complaints; $");
  expect_first_calls("", "^ran " + best() + " disk polar; 0 complaints; $");
}

TEST_F(EnvironmentDeathTest, NamesForce) {
  for (const Row& row : kRows)
    if (row.supported) expect_first_calls(row.name, std::string("^ran ") + row.name + " disk polar; 0 complaints; $");
}

TEST_F(EnvironmentDeathTest, OtherNamesAreReportedOnceAndIgnored) {
  expect_first_calls("nonsense", "^ran " + best() + " disk polar; 1 complaints; .*VNDF_ISA=nonsense ignored");
  for (const Row& row : kRows)
    if (!row.supported)
      expect_first_calls(row.name, "^ran " + best() + " disk polar; 1 complaints; .*VNDF_ISA=" + row.name + " ignored");
}

}  // namespace
