// What is rendered, and what rays ask of it: where they meet something, and what light is there.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "vec.h"

struct RTCSceneTy;

namespace wavefront {

/// Ends the program with one line.
[[noreturn]] inline void fail(const std::string& of, const std::string& why) {
  throw std::runtime_error(of + ": " + why);
}

/// Rows from the top; wraps around. RGB, or the same number three times.
struct Texture {
  int width = 0, height = 0;
  std::vector<Vec3> texels;

  Vec3 look_up(Vec2 uv) const;  // bilinear
  Vec3 nearest(Vec2 uv) const;  // for angles, between which one must not interpolate
};
/// Reads .exr (linear) or .png; 8-bit values are made linear if they are `colors`, else divided by 255.
Texture read_texture(const std::string& file, bool colors);

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
  // Textures, or none. Roughness is a factor to alpha; angles are in turns.
  std::shared_ptr<const Texture> color_map = {}, roughness_map = {}, angle_map = {}, normal_map = {};
};

struct Corner {
  Vec3 position, normal;
  Vec2 uv;
};
struct Triangle {
  Corner corners[3];
  int material;

  Vec3 edge(int i) const { return corners[i].position - corners[0].position; }
  Vec3 cross() const { return edge(1).cross(edge(2)); }  // along the normal, twice the area long
};
struct Sphere {
  Vec3 center;
  float radius;
  int material;
};
/// Spheres are numbered after the triangles.
using Primitive = std::uint32_t;
constexpr Primitive kNothing = ~0u;

/// Weights of numbered things, one of which can be chosen by them.
struct Weights {
  double total = 0.;
  std::vector<float> sums;  // up to each, over the total
};

/// Light from far away: an octahedral map of all directions, which needs no trigonometry where it is looked up or
/// sampled. Texels are sampled by their light.
struct Environment {
  int size = 0;
  std::vector<Vec3> texels;
  Weights rows;
  std::vector<Weights> columns;
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
  Environment environment;
  Camera camera;

  // By list_lights: the primitives that emit, and how much.
  std::vector<Primitive> lights;
  Weights light;
  // By build_tree: what rays meet, and how far off a surface they start.
  std::shared_ptr<RTCSceneTy> tree;
  float epsilon = 0.f;

  /// What a function answers for a triangle or a sphere.
  template <class Function>
  auto of_shape(Primitive p, Function function) const {
    return p < triangles.size() ? function(triangles[p]) : function(spheres[p - triangles.size()]);
  }
  const Material& material_of(Primitive p) const {
    return materials[of_shape(p, [](const auto& shape) { return shape.material; })];
  }
};
/// The sky of the default scene, which an OBJ file gets too.
Environment evening();
Scene default_scene();
Scene read_obj(const std::string& file);

// Rays. Embree says which primitive one meets; where, is computed from the ray and the primitive alone, so that of
// Embree's arithmetic, which differs between its instruction sets, nothing but the choice is kept.

/// `configuration` is Embree's.
void build_tree(Scene& scene, const std::string& configuration);
Primitive intersect(const Scene& scene, Vec3 origin, Vec3 direction);
bool occluded(const Scene& scene, Vec3 origin, Vec3 direction, float distance);

struct Surface {
  Vec3 position, normal;         // the geometric one, to the outside
  Vec3 shading_normal, tangent;  // tangent: along u, of any length
  Vec2 uv;                       // of triangles
};
Surface surface_at(const Scene& scene, Primitive primitive, Vec3 origin, Vec3 direction);

// Light, for next event estimation: the sky, triangles and spheres; sampled, and the density of that.

struct LightSample {
  Vec3 wi{0.f};
  float distance = 0.f;  // infinite for the sky
  Vec3 radiance{0.f};
  float pdf = 0.f;  // over solid angle; 0: no light
};
void list_lights(Scene& scene);
/// `u` chooses the point, `disk` is the point of the unit disk that it maps to, `select` chooses the light.
LightSample sample_light(const Scene& scene, Vec3 from, Vec2 u, Vec2 disk, float select);
/// Of a ray that met a primitive that emits, or nothing: what it finds, but for the distance, and the density that
/// sample_light has for it.
LightSample light_met(const Scene& scene, Primitive primitive, Vec3 from, Vec3 direction);
/// Veach's power heuristic. Densities are at most 2^60, so squares are finite.
inline float mis_weight(float pdf, float other) {
  return pdf * pdf / (pdf * pdf + other * other);
}

}  // namespace wavefront
