// The public functions as rows of one table: every warp, surface and option, with columns in and columns out. A promise
// that all functions make is tested on all rows. Nothing here but the library's own headers: hosts compile it too.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <vndf/ellipsoid.h>

namespace vndf::testing {

/// What is in a column of the inputs. It decides which values are tried.
enum class Kind { view, light, normal, alpha, theta, eta, u, probability };

/// What is in a column of the outputs. It decides what holds for every value.
enum class Result { normal, direction, point, cosine, density, weight, f_cos, side, share };

/// The columns of a call by name. A row reads those that its inputs name.
struct In {
  Columns3 wo{0, 0, 0}, wi = wo, wm = wo;
  Columns2 alpha{0, 0};
  Columns3 theta{0, 0, 0};
  Column eta = 0;
  Columns3 u = wo;
  Column reflection_probability = 0;

  Columns2 pair() const { return {u.x, u.y}; }
};
struct Out {
  Out3 wm{}, wi{};
  Out2 t{};
  float *pdf{}, *weight{}, *f_cos{}, *side{}, *wo_dot_wm{}, *wi_dot_wm{}, *reflectance{};
};

/// A column of a row. `index` counts the columns of its kind in that row.
struct Input {
  std::string name;
  Kind kind;
  std::function<Column&(In&)> in;
  std::size_t index = 0;
};
struct Output {
  std::string name;
  Result result;
  std::function<float*&(Out&)> out;
  bool optional = false;  ///< may be a null pointer
};

struct Operation {
  std::string name;
  std::vector<Input> inputs;
  std::vector<Output> outputs;
  std::function<void(std::size_t count, const In& in, const Out& out)> call;
  Warp warp = Warp::concentric;  ///< decides which random numbers are hard
  bool in_domain = true;         ///< false: a surface beyond what is promised, which has bits all the same

  /// Columns in the order of `inputs` and `outputs`.
  void run(std::size_t count, const Column* in, float* const* out) const;
  bool takes(Kind kind) const;
  /// The number of a column, or that of the columns where there is none of this name.
  std::size_t input(const std::string& column) const;
  std::size_t output(const std::string& column) const;
};

/// The rows. To add one, see operations.cpp.
const std::vector<Operation>& operations();
/// The row of this name, which must be there; or a null pointer if there is none.
const Operation& operation(const std::string& name);
const Operation* find_operation(const std::string& name);
/// By their names, the row that evaluates the samples of a row, and the one whose normals its samples have; or null.
const Operation* evaluation_of(const Operation& row);
const Operation* normals_of(const Operation& row);

constexpr Warp kWarps[] = {Warp::polar, Warp::concentric, Warp::spherical_cap};
constexpr const char* kWarpNames[] = {"polar", "concentric", "spherical_cap"};

}  // namespace vndf::testing
