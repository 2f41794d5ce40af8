// vndf_warps: the unit square, as a checker and as a point set, warped into the plane of slopes by each map.
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include <vndf/vndf.h>

#include "arguments.h"
#include "peers.h"

namespace {

using namespace vndf;

struct Point {
  float x, y;
};

/// Unit square to slopes (-wm.x / wm.z, -wm.y / wm.z), for a view `degrees` from the normal and leaning towards +x,
/// alpha = 1.
using Map = std::function<std::vector<Point>(const std::vector<Point>& square, double degrees)>;

struct NamedMap {
  std::string name;
  Map map;
};

/// The columns are laid out once for every map.
struct Columns {
  std::vector<float> values[10];
  const float* in[7];
  float* out[3];

  Columns(const std::vector<Point>& square, double degrees) {
    double radians = degrees * 3.14159265358979323846 / 180;
    const float constant[5] = {float(std::sin(radians)), 0.f, float(std::cos(radians)), 1.f, 1.f};
    for (int column = 0; column < 5; ++column) values[column].assign(square.size(), constant[column]);
    for (const Point& u : square) {
      values[5].push_back(u.x);
      values[6].push_back(u.y);
    }
    for (int column = 7; column < 10; ++column) values[column].resize(square.size());
    for (int column = 0; column < 7; ++column) in[column] = values[column].data();
    for (int column = 0; column < 3; ++column) out[column] = values[7 + column].data();
  }

  std::vector<Point> slopes() const {
    // Horizontal normals have infinite slopes: drawn far outside every window instead.
    constexpr float kFar = 200;
    std::vector<Point> points;
    for (std::size_t i = 0; i < values[7].size(); ++i) {
      float x = -out[0][i], y = -out[1][i], z = out[2][i];
      float horizontal = std::hypot(x, y);
      float scale = horizontal > kFar * z ? kFar / horizontal : 1 / z;
      points.push_back({x * scale, y * scale});
    }
    return points;
  }
};

std::vector<NamedMap> maps() {
  auto ours = [](Warp warp) {
    return [warp](const std::vector<Point>& square, double degrees) {
      Columns columns(square, degrees);
      const float* const* in = columns.in;
      sample_normals(warp, square.size(), {in[0], in[1], in[2]}, {in[3], in[4]}, {in[5], in[6]},
                     {columns.out[0], columns.out[1], columns.out[2]});
      return columns.slopes();
    };
  };
  std::vector<NamedMap> maps = {{"polar", ours(Warp::polar)},
                                {"concentric", ours(Warp::concentric)},
                                {"spherical_cap", ours(Warp::spherical_cap)}};
  for (const peers::Peer& peer : peers::peers()) {
    // Those whose parameterisation is not one of the library's and that sample the same normals.
    if (!peer.supported || std::string(peer.warp) != "own" || std::string(peer.operation) != "sample_normals") continue;
    // Another way to compute a map that is there: the same picture.
    if (std::string(peer.name).rfind(maps.back().name + "_", 0) == 0) continue;
    maps.push_back({peer.name, [&peer](const std::vector<Point>& square, double degrees) {
                      Columns columns(square, degrees);
                      peer.sample(square.size(), columns.in, columns.out);
                      return columns.slopes();
                    }});
  }
  return maps;
}

/// The ends of the square are where some peers divide by 0: a hair inside.
Point inside(double x, double y) {
  auto clamp = [](double v) { return float(std::fmin(std::fmax(v, 1e-6), 1 - 1e-6)); };
  return {clamp(x), clamp(y)};
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

bool finite(const std::vector<Point>& points) {
  for (const Point& p : points) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) return false;
  }
  return true;
}

/// Appends what of (from, to] is needed to stay within a hair of all points between, seen from the distance at which a
/// figure is drawn: the outer parts of the plane are shown smaller or not at all.
void simplify(const std::vector<Point>& points, std::size_t from, std::size_t to, std::vector<Point>& out) {
  Point a = points[from], b = points[to];
  double dx = double(b.x) - a.x, dy = double(b.y) - a.y, length = std::hypot(dx, dy);
  std::size_t farthest = from;
  double largest = 1;
  for (std::size_t i = from + 1; i < to; ++i) {
    double px = double(points[i].x) - a.x, py = double(points[i].y) - a.y;
    double off = length > 0 ? std::fabs(px * dy - py * dx) / length : std::hypot(px, py);
    off /= 0.003 * (1 + std::hypot(points[i].x, points[i].y));
    if (off > largest) {
      largest = off;
      farthest = i;
    }
  }
  if (farthest == from) {
    out.push_back(b);
  } else {
    simplify(points, from, farthest, out);
    simplify(points, farthest, to, out);
  }
}

void write(std::FILE* file, const std::vector<Point>& points) {
  const char* separator = "[";
  for (const Point& p : points) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) continue;
    std::fprintf(file, "%s[%.4g,%.4g]", separator, p.x, p.y);
    separator = ",";
  }
  std::fputs(*separator == '[' ? "[]" : "]", file);
}

constexpr char kHelp[] =
    R"(vndf_warps: a checker and a point set of the unit square, warped into slope space by each map

  --points N   points of the set (default 512)
  --out FILE   where the JSON goes (default -, standard output)
)";

}  // namespace

int main(int argc, char** argv) {
  int points = 512;
  std::string out = "-";
  report::Arguments arguments(argc, argv);
  while (arguments.more()) {
    if (arguments.common(kHelp, out)) continue;
    if (arguments.is("--points")) {
      points = int(arguments.number(1, 1 << 20));
    } else {
      arguments.unknown();
    }
  }

  std::FILE* file = report::open_output(out);
  std::fputs("{\"maps\": [", file);
  const char* separator = "\n";
  for (const NamedMap& map : maps()) {
    for (double degrees : {0., 45., 75., 88.}) {
      std::fprintf(file, "%s{\"map\": \"%s\", \"degrees\": %g,\n\"points\": ", separator, map.name.c_str(), degrees);
      write(file, map.map(point_set(points), degrees));
      std::fputs(",\n\"checker\": [", file);
      separator = "\n";
      for (const std::vector<Point>& cell : checker(12, 48)) {
        std::vector<Point> warped = map.map(cell, degrees);
        if (!finite(warped)) continue;
        warped.push_back(warped.front());
        std::vector<Point> outline = {warped.front()};
        simplify(warped, 0, warped.size() - 1, outline);
        std::fputs(separator, file);
        write(file, outline);
        separator = ",\n";
      }
      std::fputs("]}", file);
      separator = ",\n";
    }
  }
  std::fputs("\n]}\n", file);
  report::close_output(file, out);
}
