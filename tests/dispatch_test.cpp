// Which kernels a name runs. Compiled together with src/dispatch/ and, instead of the kernels, with tables whose
// functions note who was called: what dispatch does is then seen, not inferred. Built twice: over the library's rows,
// and over the rows in stub_rows/, some of which no machine supports.
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "dispatch/processor.h"
#include "kernel_tables.h"

namespace {

thread_local std::string last_call;

std::string called(const std::string& isa, const std::string& kernels, const std::string& function, std::size_t index) {
  return isa + ": " + kernels + ", " + function + " " + std::to_string(index);
}

constexpr char kPlain[] = "plain", kSeparable[] = "separable", kBounded[] = "bounded",
               kBoundedSeparable[] = "bounded separable", kOneShape[] = "one shape", kTurned[] = "turned",
               kTilted[] = "tilted";
constexpr char kNormals[] = "normals", kDisk[] = "disk", kReflection[] = "reflection", kDielectric[] = "dielectric",
               kEvaluateReflection[] = "evaluate reflection", kEvaluateDielectric[] = "evaluate dielectric",
               kPdfNormals[] = "pdf of normals";

/// A kernel that notes who it is, whatever its arguments.
template <const char* isa, const char* kernels, const char* function, std::size_t index, class... Arguments>
void note(Arguments...) noexcept {
  last_call = called(isa, kernels, function, index);
}
template <const char* isa, const char* kernels, const char* function, std::size_t index, class... Arguments>
void fill(void (*&entry)(Arguments...) noexcept) {
  entry = note<isa, kernels, function, index, Arguments...>;
}

/// One function for one matrix and for many.
template <const char* isa, const char* function, std::size_t index, class In, class Out>
void note_matrix(std::size_t, const In&, const vndf::Matrices& matrices, const Out&) noexcept {
  last_call = called(isa, matrices.per_lane ? kTilted : kOneShape, function, index);
}
template <const char* isa, const char* function, std::size_t index, class In, class Out, std::size_t maskings>
void fill(vndf::BySurface<In, Out, maskings>& k) {
  fill<isa, kPlain, function, index>(k.alpha[0]);
  if constexpr (maskings > 1) fill<isa, kSeparable, function, index>(k.alpha[1]);
  fill<isa, kTurned, function, index>(k.turned);
  k.matrix = note_matrix<isa, function, index, In, Out>;
}
template <const char* isa, const char* function, class Kernels>
void fill_warps(Kernels (&warps)[3]) {
  fill<isa, function, 0>(warps[0]);
  fill<isa, function, 1>(warps[1]);
  fill<isa, function, 2>(warps[2]);
}
template <const char* isa, std::size_t index, class Kernel>
void fill_bounded(Kernel (&maskings)[2]) {
  fill<isa, kBounded, kReflection, index>(maskings[0]);
  fill<isa, kBoundedSeparable, kReflection, index>(maskings[1]);
}

/// The tables of a set.
template <const char* isa>
struct Stubs {
  vndf::NormalsTable normals;
  vndf::DiskTable disk;
  vndf::ReflectionTable reflection;
  vndf::EvaluationTable evaluation;
  vndf::DensityTable density;
  vndf::DielectricTable dielectric;
  vndf::DielectricEvaluationTable dielectric_evaluation;

  Stubs() {
    fill_warps<isa, kNormals>(normals.warps);
    fill<isa, kPlain, kDisk, 0>(disk.maps[0]);
    fill<isa, kPlain, kDisk, 1>(disk.maps[1]);
    fill_warps<isa, kReflection>(reflection.warps);
    fill_bounded<isa, 0>(reflection.bounded[0]);
    fill_bounded<isa, 1>(reflection.bounded[1]);
    fill_bounded<isa, 2>(reflection.bounded[2]);
    fill<isa, kEvaluateReflection, 0>(evaluation.all);
    fill<isa, kBounded, kEvaluateReflection, 0>(evaluation.bounded[0]);
    fill<isa, kBoundedSeparable, kEvaluateReflection, 0>(evaluation.bounded[1]);
    fill<isa, kPdfNormals, 0>(density.all);
    fill_warps<isa, kDielectric>(dielectric.warps);
    fill<isa, kEvaluateDielectric, 0>(dielectric_evaluation.all);
  }
};

struct Row {
  const char* name;
  bool supported;
};
const Row kRows[] = {
#define VNDF_ISA(name, supported) {#name, supported},
#include "isa_rows.h"
};

}  // namespace

namespace vndf {
#define VNDF_ISA(name, supported)                                                    \
  namespace name {                                                                   \
  constexpr char kName[] = #name;                                                    \
  static const Stubs<kName> stubs;                                                   \
  extern const NormalsTable sample_normals;                                          \
  extern const DiskTable sample_disk;                                                \
  extern const ReflectionTable sample_reflection;                                    \
  extern const EvaluationTable evaluate_reflection;                                  \
  extern const DensityTable pdf_normals;                                             \
  extern const DielectricTable sample_dielectric;                                    \
  extern const DielectricEvaluationTable evaluate_dielectric;                        \
  const NormalsTable sample_normals = stubs.normals;                                 \
  const DiskTable sample_disk = stubs.disk;                                          \
  const ReflectionTable sample_reflection = stubs.reflection;                        \
  const EvaluationTable evaluate_reflection = stubs.evaluation;                      \
  const DensityTable pdf_normals = stubs.density;                                    \
  const DielectricTable sample_dielectric = stubs.dielectric;                        \
  const DielectricEvaluationTable evaluate_dielectric = stubs.dielectric_evaluation; \
  }
#include "isa_rows.h"
}  // namespace vndf

namespace {

using namespace vndf;

const Columns2 kAlpha{0.5f, 0.5f};
constexpr Warp kAllWarps[] = {Warp::polar, Warp::concentric, Warp::spherical_cap};

std::string call_disk(DiskMap map) {
  sample_disk(map, 0, {0.f, 0.f}, {});
  return last_call;
}

void expect_last_call(const char* kernels, const char* function, std::size_t index) {
  EXPECT_EQ(last_call, called(active_isa(), kernels, function, index));
}

// Calls with alpha, an Ellipsoid or a Shape.
const Columns3 kUp{0.f, 0.f, 1.f};
template <class S>
void expect_normals(const char* kernels, const S& shape) {
  if (kernels == kSeparable) kernels = kPlain;  // normals have no masking
  for (Warp warp : kAllWarps) {
    sample_normals(warp, 0, kUp, shape, {0.f, 0.f}, {});
    expect_last_call(kernels, kNormals, std::size_t(warp));
  }
  pdf_normals(0, kUp, kUp, shape, nullptr);
  expect_last_call(kernels, kPdfNormals, 0);
}
template <class S, class... Options>
void expect_reflection(const char* kernels, const S& shape, const Options&... options) {
  for (Warp warp : kAllWarps) {
    sample_reflection(warp, 0, kUp, shape, {0.f, 0.f}, {}, options...);
    expect_last_call(kernels, kReflection, std::size_t(warp));
  }
  evaluate_reflection(0, kUp, kUp, shape, {}, options...);
  expect_last_call(kernels, kEvaluateReflection, 0);
}
template <class S, class... Options>
void expect_dielectric(const char* kernels, const S& shape, const Options&... options) {
  if (kernels == kSeparable) kernels = kPlain;  // which take their masking as they run
  for (Warp warp : kAllWarps) {
    sample_dielectric(warp, 0, kUp, shape, 1.5f, kUp, {}, options...);
    expect_last_call(kernels, kDielectric, std::size_t(warp));
  }
  evaluate_dielectric(0, kUp, kUp, shape, 1.5f, {}, options...);
  expect_last_call(kernels, kEvaluateDielectric, 0);
}
template <class S>
void expect_all(const char* kernels, const S& shape) {
  expect_normals(kernels, shape);
  expect_reflection(kernels, shape);
  expect_dielectric(kernels, shape);
}

std::string polar_disk(const std::string& isa) {
  return called(isa, kPlain, kDisk, 0);
}
std::string best() {
  std::string name;
  for (const Row& row : kRows)
    if (row.supported) name = row.name;
  return name;
}

void expect_calls_on(const std::string& isa) {
  EXPECT_EQ(active_isa(), isa);
  expect_all(kPlain, kAlpha);
  for (DiskMap map : {DiskMap::polar, DiskMap::concentric})
    EXPECT_EQ(call_disk(map), called(isa, kPlain, kDisk, std::size_t(map)));
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

TEST(Dispatch, EveryOptionRunsItsKernels) {
  const auto correlated = Masking::height_correlated, separable = Masking::separable;
  expect_reflection(kPlain, kAlpha, ReflectionOptions{correlated, false});
  expect_reflection(kSeparable, kAlpha, ReflectionOptions{separable, false});
  expect_reflection(kBounded, kAlpha, ReflectionOptions{correlated, true});
  expect_reflection(kBoundedSeparable, kAlpha, ReflectionOptions{separable, true});
  expect_dielectric(kPlain, kAlpha, correlated);
  expect_dielectric(kSeparable, kAlpha, separable);
}

// ellipsoid.h states what each way of giving the angles costs.
TEST(Dispatch, EllipsoidsRunTheCheapestKernels) {
  const float number = 0;
  const Column angles[] = {0.f, -0.f, 0.3f, &number}, alphas[] = {0.5f, &number};
  auto is_zero = [](const Column& c) { return !c.data && c.value == 0; };
  for (const Column& alpha_x : alphas)
    for (const Column& alpha_y : alphas)
      for (const Column& x : angles)
        for (const Column& y : angles)
          for (const Column& z : angles) {
            bool upright = is_zero(x) && is_zero(y);
            bool constants = !alpha_x.data && !alpha_y.data && !x.data && !y.data && !z.data;
            bool plain = upright && is_zero(z);
            const char* kernels = plain ? kSeparable : constants ? kOneShape : upright ? kTurned : kTilted;
            expect_all(kernels, Ellipsoid({alpha_x, alpha_y}, x, y, z));
          }
}

TEST(Dispatch, ShapesRunTheirKernels) {
  expect_all(kOneShape, Shape());
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
#if defined(_WIN32)
  _putenv_s("VNDF_ISA", value ? value : "");  // which is how it is unset there
#else
  if (value)
    setenv("VNDF_ISA", value, 1);
  else
    unsetenv("VNDF_ISA");
#endif
  // Not by googletest: it does so itself where a death test is a copy of this process.
  std::FILE* file = std::tmpfile();
  const int terminal = dup(STDERR_FILENO);
  dup2(fileno(file), STDERR_FILENO);
  std::vector<std::thread> threads;
  std::vector<std::string> calls(8);
  for (std::string& call : calls) threads.emplace_back([&call] { call = call_disk(DiskMap::polar); });
  for (std::thread& thread : threads) thread.join();
  dup2(terminal, STDERR_FILENO);
  std::string written(std::size_t(std::ftell(file)), ' ');
  std::rewind(file);
  written.resize(std::fread(&written[0], 1, written.size(), file));
  int complaints = 0;
  for (std::size_t at = 0; (at = written.find("VNDF_ISA", at)) != std::string::npos; ++at) ++complaints;
  for (const std::string& call : calls)
    if (call != polar_disk(active_isa())) std::fprintf(stderr, "threads disagree; ");
  std::fprintf(stderr, "ran %s; %d complaints; %s", calls[0].c_str(), complaints, written.c_str());
  std::exit(0);
}

class Environment : public ::testing::Test {
 protected:
  // A program under an emulator cannot be started anew, only copied: there the environment says "fast".
  void SetUp() override {
    if (!std::getenv("GTEST_DEATH_TEST_STYLE")) ::testing::FLAGS_gtest_death_test_style = "threadsafe";
  }
  static void expect_first_calls(const char* value, const std::string& written) {
    EXPECT_EXIT(report_first_calls(value), ::testing::ExitedWithCode(0), written);
  }
};
// Googletest runs suites of this name first, each in a process that has not called the library.
using EnvironmentDeathTest = Environment;

TEST_F(EnvironmentDeathTest, UnsetOrEmptyPicksTheBest) {
  expect_first_calls(nullptr, "^ran " + polar_disk(best()) + "; 0 complaints; $");
  expect_first_calls("", "^ran " + polar_disk(best()) + "; 0 complaints; $");
}

TEST_F(EnvironmentDeathTest, NamesForce) {
  for (const Row& row : kRows)
    if (row.supported) expect_first_calls(row.name, "^ran " + polar_disk(row.name) + "; 0 complaints; $");
}

TEST_F(EnvironmentDeathTest, OtherNamesAreReportedOnceAndIgnored) {
  expect_first_calls("nonsense", "^ran " + polar_disk(best()) + "; 1 complaints; .*VNDF_ISA=nonsense ignored");
  for (const Row& row : kRows)
    if (!row.supported)
      expect_first_calls(row.name,
                         "^ran " + polar_disk(best()) + "; 1 complaints; .*VNDF_ISA=" + row.name + " ignored");
}

}  // namespace
