// vndf_warps: the unit square, as a checker and as a point set, warped into the plane of slopes by each map.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <vndf/vndf.h>

#include "command_line.h"
#include "output.h"
#include "peers.h"
#include "warps.h"

namespace {

using namespace vndf;
using report::Json;

using Point = std::array<float, 2>;

/// The columns of peers.h.
using Sample = std::function<void(std::size_t count, const float* const in[7], float* const out[3])>;

struct Map {
  std::string name;
  Sample sample;
};

std::vector<Map> maps() {
  std::vector<Map> maps;
  for (auto [warp, name] : bench::kWarps) {
    maps.push_back(
        {name, [warp = warp](std::size_t count, const float* const in[7], float* const out[3]) {
           sample_normals(warp, count, {in[0], in[1], in[2]}, {in[3], in[4]}, {in[5], in[6]}, {out[0], out[1], out[2]});
         }});
  }
  for (const peers::Peer& peer : peers::peers()) {
    // Those whose parameterisation is not one of the library's and that sample the same normals.
    if (!peer.supported || std::string(peer.warp) != "own" || std::string(peer.operation) != "sample_normals") continue;
    // Another way to compute a map that is there: the same picture.
    if (std::string(peer.name).rfind(maps.back().name + "_", 0) == 0) continue;
    maps.push_back({peer.name, peer.sample});
  }
  return maps;
}

/// Unit square to slopes (-wm.x / wm.z, -wm.y / wm.z), for a view `degrees` from the normal and leaning towards +x,
/// alpha = 1.
std::vector<Point> warped(const Map& map, const std::vector<Point>& square, double degrees) {
  double radians = degrees * 3.14159265358979323846 / 180;
  const float constant[5] = {float(std::sin(radians)), 0.f, float(std::cos(radians)), 1.f, 1.f};
  std::vector<float> columns[10];
  for (int column = 0; column < 10; ++column) columns[column].assign(square.size(), column < 5 ? constant[column] : 0);
  for (std::size_t i = 0; i < square.size(); ++i) {
    columns[5][i] = square[i][0];
    columns[6][i] = square[i][1];
  }
  float* at[10];
  for (int column = 0; column < 10; ++column) at[column] = columns[column].data();
  map.sample(square.size(), at, at + 7);

  // Horizontal normals have infinite slopes: drawn far outside every window instead.
  constexpr float kFar = 200;
  std::vector<Point> slopes;
  for (std::size_t i = 0; i < square.size(); ++i) {
    float x = -columns[7][i], y = -columns[8][i], z = columns[9][i];
    float horizontal = std::hypot(x, y);
    float scale = horizontal > kFar * z ? kFar / horizontal : 1 / z;
    slopes.push_back({x * scale, y * scale});
  }
  return slopes;
}

/// The ends of the square are where some peers divide by 0: a hair inside.
Point inside(double x, double y) {
  return {float(std::clamp(x, 1e-6, 1 - 1e-6)), float(std::clamp(y, 1e-6, 1 - 1e-6))};
}

/// The outlines of the dark cells of an n x n checker, `steps` points a side.
std::vector<std::vector<Point>> checker(int n, int steps) {
  std::vector<std::vector<Point>> cells;
  for (int row = 0; row < n; ++row) {
    for (int column = row % 2; column < n; column += 2) {
      std::vector<Point> outline;
      for (int side = 0; side < 4; ++side) {
        for (int step = 0; step < steps; ++step) {
          double t = double(step) / steps;
          double x = side == 0 ? t : side == 1 ? 1 : side == 2 ? 1 - t : 0;
          double y = side == 0 ? 0 : side == 1 ? t : side == 2 ? 1 : 1 - t;
          outline.push_back(inside((column + x) / n, (row + y) / n));
        }
      }
      cells.push_back(outline);
    }
  }
  return cells;
}

/// The first points of the R2 sequence: evenly spread, so that holes and clumps after the warp are the warp's.
std::vector<Point> point_set(int count) {
  constexpr double kPlastic = 1.32471795724474602596;
  std::vector<Point> points;
  for (int i = 1; i <= count; ++i) {
    double x = 0.5 + i / kPlastic, y = 0.5 + i / (kPlastic * kPlastic);
    points.push_back(inside(x - std::floor(x), y - std::floor(y)));
  }
  return points;
}

bool finite(const Point& point) {
  return std::isfinite(point[0]) && std::isfinite(point[1]);
}

Json warped_points(const Map& map, int count, double degrees) {
  Json points = Json::array();
  for (const Point& point : warped(map, point_set(count), degrees)) {
    if (finite(point)) points.push_back(point);
  }
  return points;
}

Json warped_checker(const Map& map, double degrees) {
  Json cells = Json::array();
  for (const std::vector<Point>& cell : checker(12, 24)) {
    std::vector<Point> outline = warped(map, cell, degrees);
    if (std::all_of(outline.begin(), outline.end(), finite)) cells.push_back(outline);
  }
  return cells;
}

}  // namespace

int main(int argc, char** argv) {
  int points = 512;
  CLI::App app("A checker and a point set of the unit square, warped into slope space by each map.", "vndf_warps");
  report::Output output(app);
  bench::add_number(app, "--points", points, "of the set", 1, 1 << 20);
  bench::parse(app, argc, argv);

  Json document;
  for (const Map& map : maps()) {
    for (double degrees : {0., 45., 75., 88.}) {
      document["maps"].push_back({{"map", map.name},
                                  {"degrees", degrees},
                                  {"points", warped_points(map, points, degrees)},
                                  {"checker", warped_checker(map, degrees)}});
    }
  }
  output.write(document);
}
