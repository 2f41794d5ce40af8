// The ratio (reference/ratio.h) of evaluate_reflection, evaluate_dielectric and pdf_normals, for pairs that were
// sampled and for pairs that nobody sampled.
#include "ratio/evaluation.h"

namespace vndf::ratio {
namespace {

template <class Surface>
std::size_t pair_count() {
  return sample_count(Surface::kByLunes ? 10 : 11);
}

template <class Surface, bool bounded>
void measure_reflection(const char* what, const HardCase& row) {
  measure<EvaluatedReflection<Surface, bounded>>(std::string(what) + " " + row.name, row, pair_count<Surface>());
}

template <class Surface>
void measure_normals(const char* what, const HardCase& row) {
  measure<DensityOfNormals<Surface>>(std::string(what) + " " + row.name, row, pair_count<Surface>());
}

template <class Surface>
void measure_dielectric(const char* what, const HardCase& row, const Refraction& refraction) {
  measure<EvaluatedDielectric<Surface>>(std::string(what) + " " + refraction.name + " " + row.name, row,
                                        pair_count<Surface>(), refraction);
}

std::string name_of(const ::testing::TestParamInfo<HardCase>& info) {
  return info.param.name;
}

class Above : public ::testing::TestWithParam<HardCase> {};
INSTANTIATE_TEST_SUITE_P(, Above, ::testing::ValuesIn(rows(Views::unit_above)), name_of);
TEST_P(Above, Reflection) {
  measure_reflection<Plain, false>("evaluate_reflection", GetParam());
}
TEST_P(Above, BoundedReflection) {
  measure_reflection<Plain, true>("bounded evaluate_reflection", GetParam());
}
TEST_P(Above, TurnedReflection) {
  measure_reflection<Turned, false>("turned evaluate_reflection", GetParam());
}
TEST_P(Above, TiltedReflection) {
  measure_reflection<Tilted, false>("tilted evaluate_reflection", GetParam());
}

class Anywhere : public ::testing::TestWithParam<HardCase> {};
INSTANTIATE_TEST_SUITE_P(, Anywhere, ::testing::ValuesIn(rows(Views::unit)), name_of);
TEST_P(Anywhere, Normals) {
  measure_normals<Plain>("pdf_normals", GetParam());
}
TEST_P(Anywhere, TurnedNormals) {
  measure_normals<Turned>("turned pdf_normals", GetParam());
}
TEST_P(Anywhere, TiltedNormals) {
  measure_normals<Tilted>("tilted pdf_normals", GetParam());
}

TEST_P(Anywhere, Dielectric) {
  for (const Refraction& refraction : reference::refractions())
    measure_dielectric<Plain>("evaluate_dielectric", GetParam(), refraction);
}
TEST_P(Anywhere, TiltedDielectric) {
  for (const Refraction& refraction : reference::refractions())
    measure_dielectric<Tilted>("tilted evaluate_dielectric", GetParam(), refraction);
}

}  // namespace
}  // namespace vndf::ratio
