// What is rendered: triangles and spheres, materials, textures, the sky.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "vec.h"

struct RTCSceneTy;

namespace wavefront {

/// Rows from the top; wraps around. RGB, or the same number three times.
struct Texture {
  int width = 0, height = 0;
  std::vector<Vec3> texels;

  Vec3 look_up(Vec2 uv) const;  // bilinear
  Vec3 nearest(Vec2 uv) const;  // for angles, between which one must not interpolate
};

/// What one call of the library can shade together. Paths are binned by it.
enum class Kind {
  diffuse,
  plastic,     // a diffuse body under a rough dielectric coat
  conductor,   // GGX
  brushed,     // GGX whose axes a texture turns
  leaning,     // ellipsoids
  dielectric,  // rough glass
};
constexpr int kKinds = 6;

struct Material {
  Kind kind = Kind::diffuse;
  Vec3 color{0.5f};  // of the diffuse body; of what glass lets through
  float alpha_x = 0.3f, alpha_y = 0.3f;
  Vec3 n{1.5f}, k{0.f};  // of metals
  float eta = 1.5f;
  float theta_x = 0.f, theta_y = 0.f, theta_z = 0.f;
  Vec3 emission{0.f};
  // Textures of the scene, or -1. Roughness is a factor to alpha; angles are in turns.
  int color_map = -1, roughness_map = -1, angle_map = -1, normal_map = -1;
};

struct Corner {
  Vec3 position, normal;
  Vec2 uv;
};
struct Triangle {
  Corner corners[3];
  int material;

  Vec3 edge(int i) const { return corners[i].position - corners[0].position; }
  Vec3 area() const { return 0.5f * edge(1).cross(edge(2)); }  // along the normal
};
struct Sphere {
  Vec3 center;
  float radius;
  int material;
};
/// Spheres are numbered after the triangles.
using Primitive = std::uint32_t;
constexpr Primitive kNothing = ~0u;

/// Chooses among numbered things by their weights.
class Choice {
 public:
  Choice() = default;
  explicit Choice(const std::vector<double>& weights);
  /// u in [0, 1) becomes its place within what is chosen, so that strata stay whole.
  std::size_t choose(float& u) const;
  float chance(std::size_t i) const { return sums_[i] - (i > 0 ? sums_[i - 1] : 0.f); }

 private:
  std::vector<float> sums_;
};

/// Light from far away: an octahedral map of all directions, which needs no trigonometry where it is looked up or
/// sampled. Texels are sampled by their light.
struct Environment {
  int size = 0;
  std::vector<Vec3> texels;
  Choice rows;
  std::vector<Choice> columns;
};
Environment make_environment(int size, const std::function<Vec3(Vec3 direction)>& radiance);
Environment environment_of_latlong(const Texture& map);

struct Camera {
  Vec3 from{0.f, 1.f, 5.f}, at{0.f};
  float fov = 40.f;  // in degrees, of the width
};

struct Scene {
  std::vector<Triangle> triangles;
  std::vector<Sphere> spheres;
  std::vector<Material> materials;
  std::vector<Texture> textures;
  Environment environment;
  Camera camera;

  // By list_lights: the primitives that emit, chosen by their light, and the sum of that.
  std::vector<Primitive> lights;
  Choice choice;
  float light = 0.f;
  // By build_tree: what rays meet, and how far off a surface they start.
  std::shared_ptr<RTCSceneTy> tree;
  float epsilon = 0.f;

  const Material& material_of(Primitive p) const {
    return materials[p < triangles.size() ? triangles[p].material : spheres[p - triangles.size()].material];
  }
};

Scene default_scene();
/// Throws std::runtime_error with one line where the file is of no use.
Scene read_obj(const std::string& file);

}  // namespace wavefront
