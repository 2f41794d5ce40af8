// All subjects by name, for suites that try each of them.
#pragma once

#include "ratio/evaluation.h"
#include "ratio/normals.h"
#include "ratio/reflection.h"

namespace vndf::ratio {

/// What a generic lambda sees of a type: Of<Subject>::type.
template <class Subject>
struct Of {
  using type = Subject;
};

template <Warp warp, class F>
void for_each_sampler(const F& f) {
  const std::string name = kWarpNames[int(warp)];
  f("normals_" + name, Of<Normals<warp>>{});
  f("reflection_" + name, Of<Reflection<Plain, warp, false>>{});
  f("reflection_bounded_" + name, Of<Reflection<Plain, warp, true>>{});
  f("reflection_turned_" + name, Of<Reflection<Turned, warp, false>>{});
  f("reflection_tilted_" + name, Of<Reflection<Tilted, warp, false>>{});
  f("dielectric_" + name, Of<Dielectric<Plain, warp>>{});
  f("dielectric_tilted_" + name, Of<Dielectric<Tilted, warp>>{});
}

/// Calls f with the name of a subject and its type.
template <class F>
void for_each_subject(const F& f) {
  for_each_sampler<Warp::polar>(f);
  for_each_sampler<Warp::concentric>(f);
  for_each_sampler<Warp::spherical_cap>(f);
  f("evaluate_reflection", Of<EvaluatedReflection<Plain, false>>{});
  f("evaluate_reflection_bounded", Of<EvaluatedReflection<Plain, true>>{});
  f("evaluate_reflection_turned", Of<EvaluatedReflection<Turned, false>>{});
  f("evaluate_reflection_tilted", Of<EvaluatedReflection<Tilted, false>>{});
  f("evaluate_dielectric", Of<EvaluatedDielectric<Plain>>{});
  f("evaluate_dielectric_tilted", Of<EvaluatedDielectric<Tilted>>{});
  f("pdf_normals", Of<DensityOfNormals<Plain>>{});
  f("pdf_normals_turned", Of<DensityOfNormals<Turned>>{});
  f("pdf_normals_tilted", Of<DensityOfNormals<Tilted>>{});
}

}  // namespace vndf::ratio
