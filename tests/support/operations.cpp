// Each public function is spelled once, for any kind of surface; then come the warps, surfaces and options there are.
// What is new in the library (a function, an option, an optional output, a surface) is added here, and golden_hashes.h
// gets the lines that golden_test prints. The other suites follow the table.
#include "operations.h"  // beside this file: hosts have no path to it

#include <cstdlib>

namespace vndf::testing {
namespace {

using Inputs = std::vector<Input>;
using Outputs = std::vector<Output>;
using Rows = std::vector<Operation>;

template <class T>
std::vector<T> operator+(std::vector<T> a, const std::vector<T>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// Columns of a row, by the member of In or Out where a call finds them.
template <class Group>
Input input(const std::string& name, Kind kind, Group In::*group, Column Group::*column) {
  return {name, kind, [=](In& in) -> Column& { return in.*group.*column; }};
}
Inputs inputs(const std::string& name, Kind kind, Columns3 In::*group) {
  return {input(name + ".x", kind, group, &Columns3::x), input(name + ".y", kind, group, &Columns3::y),
          input(name + ".z", kind, group, &Columns3::z)};
}
Inputs inputs(const std::string& name, Kind kind, Columns2 In::*group) {
  return {input(name + ".x", kind, group, &Columns2::x), input(name + ".y", kind, group, &Columns2::y)};
}
Inputs inputs(const std::string& name, Kind kind, Column In::*column) {
  return {{name, kind, [=](In& in) -> Column& { return in.*column; }}};
}
template <class Group>
Output output(const std::string& name, Result result, Group Out::*group, float* Group::*column) {
  return {name, result, [=](Out& out) -> float*& { return out.*group.*column; }};
}
Outputs outputs(const std::string& name, Result result, Out3 Out::*group) {
  return {output(name + ".x", result, group, &Out3::x), output(name + ".y", result, group, &Out3::y),
          output(name + ".z", result, group, &Out3::z)};
}
Outputs outputs(const std::string& name, Result result, Out2 Out::*group) {
  return {output(name + ".x", result, group, &Out2::x), output(name + ".y", result, group, &Out2::y)};
}
Outputs outputs(const std::string& name, Result result, float* Out::*column) {
  return {{name, result, [=](Out& out) -> float*& { return out.*column; }}};
}
Outputs optional(Outputs columns) {
  for (Output& column : columns) column.optional = true;
  return columns;
}

const Inputs wo = inputs("wo", Kind::view, &In::wo), wi = inputs("wi", Kind::light, &In::wi),
             wm = inputs("wm", Kind::normal, &In::wm), alpha = inputs("alpha", Kind::alpha, &In::alpha),
             theta = inputs("theta", Kind::theta, &In::theta), theta_z = {theta[2]},
             eta = inputs("eta", Kind::eta, &In::eta),
             probability = inputs("reflection_probability", Kind::probability, &In::reflection_probability),
             u3 = inputs("u", Kind::u, &In::u), u2 = {u3[0], u3[1]};

const Outputs out_wm = outputs("wm", Result::normal, &Out::wm), out_wi = outputs("wi", Result::direction, &Out::wi),
              point = outputs("t", Result::point, &Out::t), pdf = outputs("pdf", Result::density, &Out::pdf),
              weight = outputs("weight", Result::weight, &Out::weight),
              f_cos = outputs("f_cos", Result::f_cos, &Out::f_cos), side = outputs("side", Result::side, &Out::side),
              wo_dot_wm = outputs("wo_dot_wm", Result::cosine, &Out::wo_dot_wm),
              wi_dot_wm = outputs("wi_dot_wm", Result::cosine, &Out::wi_dot_wm),
              reflectance = outputs("reflectance", Result::share, &Out::reflectance);

/// Options of a dielectric, of which a lane may have some of its own.
struct Dielectric {
  Masking masking = Masking::height_correlated;
  AcrossMasking across = AcrossMasking::separable;
  bool radiance = false, given = false;

  Inputs inputs() const { return given ? probability : Inputs(); }
  /// Of energy that Fresnel's share chooses it is at most 1.
  Outputs weight() const { return outputs("weight", radiance || given ? Result::f_cos : Result::weight, &Out::weight); }
  DielectricOptions of(const In& in) const {
    DielectricOptions options = masking;
    options.across = across;
    options.radiance = radiance;
    if (given) options.reflection_probability = in.reflection_probability;
    return options;
  }
};

/// A kind of surface: its name, its columns, and what a function takes for them.
template <class Of>
struct Surface {
  std::string name;
  Inputs inputs;
  Of of;
  bool in_domain = true;
};
template <class Of>
Surface(std::string, Inputs, Of) -> Surface<Of>;
template <class Of>
Surface(std::string, Inputs, Of, bool) -> Surface<Of>;

/// The functions for a kind of surface, with the options that they take for it, and the rows that they add.
template <class Of>
class Functions {
 public:
  Functions(Rows& rows, const Surface<Of>& surface) : rows_(rows), surface_(surface), of_(surface.of) {}

  void normals(Warp warp) {
    add("normals", name_of(warp), wo + surface_.inputs + u2, out_wm, warp,
        [warp, of = of_](std::size_t n, const In& in, const Out& out) {
          sample_normals(warp, n, in.wo, of(in), in.pair(), out.wm);
        });
  }
  void pdf_of_normals() {
    add("pdf_normals", "", wo + wm + surface_.inputs, pdf, Warp::concentric,
        [of = of_](std::size_t n, const In& in, const Out& out) { pdf_normals(n, in.wo, in.wm, of(in), out.pdf); });
  }
  template <class... Options>
  void reflection(Warp warp, const std::string& options_name, const Options&... options) {
    add("reflection", name_of(warp) + options_name, wo + surface_.inputs + u2,
        out_wi + pdf + weight + optional(out_wm + wo_dot_wm), warp,
        [=, of = of_](std::size_t n, const In& in, const Out& out) {
          sample_reflection(warp, n, in.wo, of(in), in.pair(), {out.wi, out.pdf, out.weight, out.wm, out.wo_dot_wm},
                            options...);
        });
  }
  template <class... Options>
  void evaluate(const std::string& options_name, const Options&... options) {
    add("evaluate_reflection", options_name, wo + wi + surface_.inputs, f_cos + pdf + optional(wo_dot_wm),
        Warp::concentric, [=, of = of_](std::size_t n, const In& in, const Out& out) {
          evaluate_reflection(n, in.wo, in.wi, of(in), {out.f_cos, out.pdf, out.wo_dot_wm}, options...);
        });
  }
  void dielectric(Warp warp, const std::string& options_name = "", const Dielectric& options = {}) {
    add("dielectric", name_of(warp) + options_name, wo + surface_.inputs + eta + u3 + options.inputs(),
        out_wi + pdf + options.weight() + side + optional(out_wm + wo_dot_wm + wi_dot_wm + reflectance), warp,
        [=, of = of_](std::size_t n, const In& in, const Out& out) {
          sample_dielectric(
              warp, n, in.wo, of(in), in.eta, in.u,
              {out.wi, out.pdf, out.weight, out.side, out.wm, out.wo_dot_wm, out.wi_dot_wm, out.reflectance},
              options.of(in));
        });
  }
  void evaluate_across(const std::string& options_name = "", const Dielectric& options = {}) {
    add("evaluate_dielectric", options_name, wo + wi + surface_.inputs + eta + options.inputs(), f_cos + pdf,
        Warp::concentric, [=, of = of_](std::size_t n, const In& in, const Out& out) {
          evaluate_dielectric(n, in.wo, in.wi, of(in), in.eta, {out.f_cos, out.pdf}, options.of(in));
        });
  }

 private:
  static std::string name_of(Warp warp) { return std::string("_") + kWarpNames[int(warp)]; }
  template <class Call>
  void add(const std::string& function, const std::string& end, const Inputs& in, const Outputs& out, Warp warp,
           Call call) {
    std::string kind = surface_.name.empty() ? "" : "_" + surface_.name;
    rows_.push_back({function + kind + end, in, out, call, warp, surface_.in_domain});
  }

  Rows& rows_;
  const Surface<Of>& surface_;
  Of of_;
};

void add_disk(Rows& rows) {
  for (DiskMap map : {DiskMap::polar, DiskMap::concentric}) {
    Warp warp = map == DiskMap::polar ? Warp::polar : Warp::concentric;
    rows.push_back({std::string("disk_") + kWarpNames[int(warp)], u2, point,
                    [map](std::size_t n, const In& in, const Out& out) { sample_disk(map, n, in.pair(), out.t); },
                    warp});
  }
}

/// Plain GGX, which has options.
void add_plain(Rows& rows) {
  const Surface plain{"", alpha, [](const In& in) { return in.alpha; }};
  Functions functions(rows, plain);
  for (Warp warp : kWarps) functions.normals(warp);
  functions.pdf_of_normals();
  for (Masking masking : {Masking::height_correlated, Masking::separable}) {
    std::string name = masking == Masking::separable ? "_separable" : "";
    for (bool bounded : {false, true}) {
      std::string reflection_name = (bounded ? "_bounded" : "") + name;
      ReflectionOptions options{masking, bounded};
      for (Warp warp : kWarps) functions.reflection(warp, reflection_name, options);
      functions.evaluate(reflection_name, options);
    }
    for (Warp warp : kWarps) functions.dielectric(warp, name, {masking});
    functions.evaluate_across(name, {masking});
  }
  auto two_sided = [&](const std::string& name, const ReflectionOptions& options) {
    functions.reflection(Warp::concentric, name, options);
    functions.evaluate(name, options);
  };
  two_sided("_two_sided_separable", {Masking::separable, false, true});
  two_sided("_bounded_two_sided", {Masking::height_correlated, true, true});
  auto across = [&](const std::string& name, const Dielectric& options) {
    functions.dielectric(Warp::concentric, name, options);
    functions.evaluate_across(name, options);
  };
  across("_as_reflection", {{}, AcrossMasking::as_reflection});
  across("_correlated_across", {{}, AcrossMasking::height_correlated});
  across("_radiance", {{}, {}, true});
  across("_probability", {{}, {}, false, true});
  across("_radiance_probability_separable", {Masking::separable, {}, true, true});
}

/// Ellipsoids, whose masking is their own.
template <class Of>
void add_ellipsoid(Rows& rows, const Surface<Of>& surface) {
  Functions functions(rows, surface);
  for (Warp warp : kWarps) {
    functions.normals(warp);
    functions.reflection(warp, "");
    functions.dielectric(warp);
  }
  functions.evaluate("");
  functions.evaluate_across();
  const ReflectionOptions two_sided{{}, false, true};
  functions.reflection(Warp::concentric, "_two_sided", two_sided);
  functions.evaluate("_two_sided", two_sided);
  functions.dielectric(Warp::concentric, "_radiance_probability", {{}, {}, true, true});
  functions.evaluate_across("_radiance_probability", {{}, {}, true, true});
  functions.pdf_of_normals();
}

Rows rows() {
  Rows rows;
  add_disk(rows);
  add_plain(rows);
  add_ellipsoid(rows, Surface{"tilted", alpha + theta,
                              [](const In& in) { return Ellipsoid(in.alpha, in.theta.x, in.theta.y, in.theta.z); }});
  add_ellipsoid(
      rows, Surface{"turned", alpha + theta_z, [](const In& in) { return Ellipsoid(in.alpha, 0.f, 0.f, in.theta.z); }});
  // One shape: of angles, of angles beyond what is promised, of a matrix.
  add_ellipsoid(rows, Surface{"constants", Inputs(), [](const In&) {
                                return Ellipsoid({0.3f, 0.6f}, 0.3f, -0.2f, 0.5f);
                              }});
  add_ellipsoid(rows, Surface{"bad_constants", Inputs(),
                              [](const In&) {
                                return Ellipsoid({-0.f, 1e20f}, 2.f, 1e-40f, 7.f);
                              },
                              false});
  add_ellipsoid(
      rows,
      Surface{"matrix", Inputs(), [](const In&) {
                Shape shape;
                if (make_shape({0.4f, 0.1f, 0.3f, -0.2f, 0.5f, -0.1f, 0.05f, 0.1f, 1.2f}, shape) != ShapeError::none)
                  std::abort();
                return shape;
              }});
  for (Operation& row : rows) {
    std::size_t used[16] = {};
    for (Input& input : row.inputs) input.index = used[std::size_t(input.kind)]++;
  }
  return rows;
}

}  // namespace

void Operation::run(std::size_t count, const Column* in, float* const* out) const {
  In from;
  Out to;
  for (std::size_t c = 0; c < inputs.size(); ++c) inputs[c].in(from) = in[c];
  for (std::size_t c = 0; c < outputs.size(); ++c) outputs[c].out(to) = out[c];
  call(count, from, to);
}

template <class Columns>
std::size_t find(const Columns& columns, const std::string& name) {
  std::size_t c = 0;
  while (c < columns.size() && columns[c].name != name) ++c;
  return c;
}
std::size_t Operation::input(const std::string& column) const {
  return find(inputs, column);
}
std::size_t Operation::output(const std::string& column) const {
  return find(outputs, column);
}

bool Operation::takes(Kind kind) const {
  for (const Input& input : inputs)
    if (input.kind == kind) return true;
  return false;
}

const std::vector<Operation>& operations() {
  static const Rows all = rows();
  return all;
}

const Operation* find_operation(const std::string& name) {
  for (const Operation& row : operations())
    if (row.name == name) return &row;
  return nullptr;
}
const Operation& operation(const std::string& name) {
  const Operation* row = find_operation(name);
  if (!row) std::abort();
  return *row;
}

// A sample is named function_surface_warp_options.
const Operation* evaluation_of(const Operation& row) {
  std::string name = row.name, warp = std::string("_") + kWarpNames[int(row.warp)];
  std::size_t at = name.find(warp), samples = name.find("normals") == 0 || row.output("wi.x") < row.outputs.size();
  if (at == std::string::npos || !samples) return nullptr;
  name.erase(at, warp.size());
  return find_operation((name.find("normals") == 0 ? "pdf_" : "evaluate_") + name);
}
const Operation* normals_of(const Operation& row) {
  std::string function = "reflection", warp = kWarpNames[int(row.warp)];
  std::size_t at = row.name.find(warp);
  for (const char* other : {"_bounded", "_two_sided"})
    if (row.name.find(other) != std::string::npos) return nullptr;
  if (row.name.find(function) != 0) return nullptr;
  return find_operation("normals" + row.name.substr(function.size(), at + warp.size() - function.size()));
}

}  // namespace vndf::testing
