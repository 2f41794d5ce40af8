// What is rendered: triangles and spheres in one Embree scene, materials, textures, lights, the sky.
#pragma once

#include <cstdint>
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
};
/// Bilinear, and the nearest texel: for angles, between which one must not interpolate.
Vec3 look_up(const Texture& texture, Vec2 uv);
Vec3 look_up_nearest(const Texture& texture, Vec2 uv);

/// What one call of the library can shade together. Paths are binned by it.
enum class Kind {
  diffuse,
  plastic,     // a diffuse body under a rough dielectric coat
  conductor,   // GGX
  brushed,     // GGX whose axes a texture turns
  leaning,     // one ellipsoid for each material: five constants
  dielectric,  // rough glass
};

struct Material {
  Kind kind = Kind::diffuse;
  Vec3 color{0.5f, 0.5f, 0.5f};  // of the diffuse body; of what glass lets through
  Vec3 n{1.5f, 1.5f, 1.5f}, k{0.f, 0.f, 0.f};
  float alpha_x = 0.3f, alpha_y = 0.3f;
  float theta_x = 0.f, theta_y = 0.f, theta_z = 0.f;
  float eta = 1.5f;
  Vec3 emission{0.f, 0.f, 0.f};
  // Textures of the scene, or -1. Roughness is a factor to alpha; angles are in turns.
  int color_map = -1, roughness_map = -1, angle_map = -1, normal_map = -1;
  int bin = 0;  // set by Scene::finish
};

struct Corner {
  Vec3 position, normal;
  Vec2 uv;
};
struct Triangle {
  Corner corners[3];
};
struct Sphere {
  Vec3 center;
  float radius;
};
/// Spheres are numbered after the triangles.
using Primitive = std::uint32_t;
constexpr Primitive kNothing = ~0u;

struct SkyTexel {
  Vec3 radiance;
  float pdf;  // over the square [-1, 1]^2
};
/// Light from far away: a map of the whole sphere of directions.
struct Environment {
  // Octahedral: no trigonometry where it is looked up or sampled. Texels are sampled by their light.
  int size = 0;
  std::vector<SkyTexel> texels;
  std::vector<float> rows, columns;  // cumulative
};
/// The map from a function of the direction.
template <class Radiance>
Environment make_environment(int size, Radiance radiance);

struct Camera {
  Vec3 from{0.f, 1.f, 5.f}, at{0.f, 0.f, 0.f};
  float fov = 40.f;  // in degrees, of the width
};

struct Bin {
  Kind kind;
  int material;  // of leaning ones, else of no meaning
};

struct Scene {
  std::vector<Triangle> triangles;
  std::vector<Sphere> spheres;
  std::vector<int> materials_of_triangles, materials_of_spheres;
  std::vector<Material> materials;
  std::vector<Texture> textures;
  Environment environment;
  Camera camera;

  /// Checks, numbers the bins, lists the lights and builds the tree. `device` is Embree's configuration.
  void finish(const std::string& device);

  // Made by finish.
  std::vector<Bin> bins;
  std::vector<Primitive> lights;   // primitives that emit
  std::vector<float> light_sums;   // cumulative share of each
  std::vector<float> light_share;  // by primitive, 0 where it is dark
  std::vector<Vec3> tangents;      // by triangle, along u
  float epsilon = 0.f;             // that rays start off the surface
  std::shared_ptr<RTCSceneTy> tree;

  int material_of(Primitive p) const {
    return p < triangles.size() ? materials_of_triangles[p] : materials_of_spheres[p - triangles.size()];
  }
};

Scene default_scene();
/// Throws std::runtime_error with one line where the file is of no use.
Scene read_obj(const std::string& file);

}  // namespace wavefront
