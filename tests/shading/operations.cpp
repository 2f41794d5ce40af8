#include "shading/operations.h"

#include <array>
#include <limits>

#include <vndf/ellipsoid.h>

#include "reference/hard_cases.h"
#include "shading/inputs.h"

namespace vndf::shading {
namespace {

using reference::Random;
using Ins = std::vector<Column>;
using Outs = std::vector<float*>;

/// The functions of ellipsoid.h for one kind of shapes: `shape_of` makes them of the columns from `letters` on.
template <class ShapeOf>
void add_shapes(std::vector<Operation>& rows, const std::string& kind, const std::string& letters, ShapeOf shape_of) {
  const std::size_t n = letters.size();  // inputs that make the shape, after one direction or two
  for (int w = 0; w < 3; ++w) {
    Warp warp = kWarps[w];
    std::string name = "_" + kind + "_" + kWarpNames[w];
    rows.push_back(
        {"normals" + name, "www" + letters + "uu", 3, [=](std::size_t count, const Ins& in, const Outs& out) {
           sample_normals(warp, count, {in[0], in[1], in[2]}, shape_of(&in[3]), {in[n + 3], in[n + 4]},
                          {out[0], out[1], out[2]});
         }});
    rows.push_back(
        {"reflection" + name, "www" + letters + "uu", 9, [=](std::size_t count, const Ins& in, const Outs& out) {
           sample_reflection(warp, count, {in[0], in[1], in[2]}, shape_of(&in[3]), {in[n + 3], in[n + 4]},
                             {{out[0], out[1], out[2]}, out[3], out[4], {out[5], out[6], out[7]}, out[8]});
         }});
    rows.push_back(
        {"dielectric" + name, "www" + letters + "euuu", 6, [=](std::size_t count, const Ins& in, const Outs& out) {
           sample_dielectric(warp, count, {in[0], in[1], in[2]}, shape_of(&in[3]), in[n + 3],
                             {in[n + 4], in[n + 5], in[n + 6]}, {{out[0], out[1], out[2]}, out[3], out[4], out[5]});
         }});
  }
  rows.push_back({"evaluate_" + kind, "wwwlll" + letters, 2, [=](std::size_t count, const Ins& in, const Outs& out) {
                    evaluate_reflection(count, {in[0], in[1], in[2]}, {in[3], in[4], in[5]}, shape_of(in.data() + 6),
                                        {out[0], out[1]});
                  }});
  rows.push_back({"evaluate_dielectric_" + kind, "wwwlll" + letters + "e", 2,
                  [=](std::size_t count, const Ins& in, const Outs& out) {
                    evaluate_dielectric(count, {in[0], in[1], in[2]}, {in[3], in[4], in[5]}, shape_of(in.data() + 6),
                                        in[n + 6], {out[0], out[1]});
                  }});
  rows.push_back({"pdf_normals_" + kind, "wwwmmm" + letters, 1, [=](std::size_t count, const Ins& in, const Outs& out) {
                    pdf_normals(count, {in[0], in[1], in[2]}, {in[3], in[4], in[5]}, shape_of(in.data() + 6), out[0]);
                  }});
}

void add_shapes(std::vector<Operation>& rows) {
  add_shapes(rows, "tilted", "aattt", [](const Column* in) { return Ellipsoid({in[0], in[1]}, in[2], in[3], in[4]); });
  add_shapes(rows, "turned", "aat", [](const Column* in) { return Ellipsoid({in[0], in[1]}, 0.f, 0.f, in[2]); });
  // One shape: of angles, of angles beyond what is promised, of a matrix.
  add_shapes(rows, "constants", "", [](const Column*) { return Ellipsoid({0.3f, 0.6f}, 0.3f, -0.2f, 0.5f); });
  add_shapes(rows, "bad_constants", "", [](const Column*) { return Ellipsoid({-0.f, 1e20f}, 2.f, 1e-40f, 7.f); });
  add_shapes(rows, "matrix", "", [](const Column*) {
    Shape shape;
    EXPECT_EQ(make_shape({0.4f, 0.1f, 0.3f, -0.2f, 0.5f, -0.1f, 0.05f, 0.1f, 1.2f}, shape), ShapeError::none);
    return shape;
  });
}

float any_bits(Random& random) {
  auto bits = std::uint32_t(random.bits());
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

}  // namespace

const std::vector<Operation>& operations() {
  static const std::vector<Operation> all = [] {
    std::vector<Operation> rows;
    for (int w = 0; w < 3; ++w)
      for (bool bounded : {false, true})
        for (Masking masking : {Masking::height_correlated, Masking::separable}) {
          std::string name = std::string(kWarpNames[w]) + (bounded ? "_bounded" : "") +
                             (masking == Masking::separable ? "_separable" : "");
          ReflectionOptions options{masking, bounded};
          Warp warp = kWarps[w];
          rows.push_back({"reflection_" + name, "wwwaauu", 9, [=](std::size_t n, const auto& in, const auto& out) {
                            sample_reflection(
                                warp, n, {in[0], in[1], in[2]}, {in[3], in[4]}, {in[5], in[6]},
                                {{out[0], out[1], out[2]}, out[3], out[4], {out[5], out[6], out[7]}, out[8]}, options);
                          }});
          if (w == 0)
            rows.push_back({"evaluate_" + name, "wwwlllaa", 2, [=](std::size_t n, const auto& in, const auto& out) {
                              evaluate_reflection(n, {in[0], in[1], in[2]}, {in[3], in[4], in[5]}, {in[6], in[7]},
                                                  {out[0], out[1]}, options);
                            }});
          if (!bounded)
            rows.push_back({"dielectric_" + name, "wwwaaeuuu", 6, [=](std::size_t n, const auto& in, const auto& out) {
                              sample_dielectric(warp, n, {in[0], in[1], in[2]}, {in[3], in[4]}, in[5],
                                                {in[6], in[7], in[8]},
                                                {{out[0], out[1], out[2]}, out[3], out[4], out[5]}, masking);
                            }});
          if (w == 0 && !bounded)
            rows.push_back(
                {"evaluate_dielectric_" + name, "wwwlllaae", 2, [=](std::size_t n, const auto& in, const auto& out) {
                   evaluate_dielectric(n, {in[0], in[1], in[2]}, {in[3], in[4], in[5]}, {in[6], in[7]}, in[8],
                                       {out[0], out[1]}, masking);
                 }});
        }
    rows.push_back({"pdf_normals", "wwwmmmaa", 1, [](std::size_t n, const auto& in, const auto& out) {
                      pdf_normals(n, {in[0], in[1], in[2]}, {in[3], in[4], in[5]}, {in[6], in[7]}, out[0]);
                    }});
    add_shapes(rows);
    return rows;
  }();
  return all;
}

void PrintTo(const Operation& operation, std::ostream* out) {
  *out << operation.name;
}

float bad_value(reference::Random& random, char kind) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity(),
                  kMax = std::numeric_limits<float>::max();
  static const float values[] = {0.f,    -0.f,  1.f,   -1.f,  0x1p-149f, -1e-40f, 1e-38f,  1e-30f,
                                 1e-20f, 1e-6f, 1e6f,  1e20f, -1e30f,    0.5f,    2.f,     1 - 0x1p-24f,
                                 kNan,   kInf,  -kInf, kMax,  -kMax,     100.f,   0x1p75f, -0.3f};
  if (random.below(3) == 0) return values[random.below(sizeof values / sizeof *values)];
  if (random.below(8) == 0) return any_bits(random);
  switch (kind) {
    case 'a':
      return float(random.log_uniform(1e-4, 2));
    case 'u':
      return random.unit();
    case 't':
      return float(random.uniform(-3.2, 3.2));
    case 'e':
      return float(random.uniform(0.4, 2.5));
    default:
      return float(random.uniform(-1, 1));
  }
}

Table inputs(const Operation& operation, std::size_t count, std::uint64_t seed, bool good_only) {
  Table table(operation.inputs.size(), std::vector<float>(count));
  const auto& cases = reference::hard_cases();
  for (std::size_t row = 0; row < cases.size() + 2; ++row) {
    bool hard = row < cases.size();
    std::size_t n = count / (cases.size() + 2) + 1;
    auto in = reference::generate(cases[hard ? row : 0], Warp::concentric, n, seed);
    Directions wm(n), wi(n);
    std::vector<float> pdf(n), weight(n), side(n);
    sample_normals(Warp::concentric, n, in.wo(), in.alpha(), in.u(), wm.out());
    std::vector<float> u3(n);
    for (std::size_t k = 0; k < n; ++k) u3[k] = Random(seed + 1, k).unit();
    sample_dielectric(Warp::concentric, n, in.wo(), in.alpha(), 1.5f, {in.u_x.data(), in.u_y.data(), u3.data()},
                      {wi.out(), pdf.data(), weight.data(), side.data()});
    for (std::size_t k = 0; k < n; ++k) {
      std::size_t i = k * (cases.size() + 2) + row;
      if (i >= count) break;
      Random random(seed, i);
      int w = 0, l = 0, m = 0, a = 0, u = 0;
      bool jitter = random.below(4) == 0;
      for (std::size_t c = 0; c < table.size(); ++c) {
        char kind = operation.inputs[c];
        float value = 0;
        switch (kind) {
          case 'w':
            value = std::array{in.wo_x[k], in.wo_y[k], in.wo_z[k]}[std::size_t(w++)];
            break;
          case 'l':
            value = std::array{wi.x[k], wi.y[k], wi.z[k]}[std::size_t(l++)];
            if (jitter) value = float(random.uniform(-1, 1));
            break;
          case 'm':
            value = std::array{wm.x[k], wm.y[k], wm.z[k]}[std::size_t(m++)];
            break;
          case 'a':
            value = std::array{in.alpha_x[k], in.alpha_y[k]}[std::size_t(a++)];
            break;
          case 't':  // lean a little or as they like
            value = float(random.below(4) ? random.uniform(-0.5, 0.5) : random.uniform(-3.2, 3.2));
            break;
          case 'e':
            value = random.below(2) ? 1.5f : float(random.uniform(0.4, 2.5));
            break;
          default:
            value = u < 2 ? std::array{in.u_x[k], in.u_y[k]}[std::size_t(u)] : random.unit();
            ++u;
        }
        if (!hard && !good_only) value = row % 2 ? bad_value(random, kind) : any_bits(random);
        table[c][i] = value;
      }
    }
  }
  return table;
}

Table evaluate(const Operation& operation, const Table& in) {
  Table out(operation.outputs, std::vector<float>(in[0].size()));
  operation.run(in[0].size(), testing::columns(in), testing::results(out));
  return out;
}

}  // namespace vndf::shading
