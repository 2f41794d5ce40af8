// OBJ files with the PBR keys of their materials: Pr, Pm, aniso, anisor, Ni, Tf, Ke, map_Kd, map_Pr, norm. And two of
// our own: lean_x and lean_y, theta_x and theta_y in turns.
#include <cstdlib>
#include <filesystem>
#include <map>
#include <stdexcept>

#include <tiny_obj_loader.h>

#include "images.h"

namespace wavefront {
namespace {

Vec3 vec3(const float* v) {
  return {v[0], v[1], v[2]};
}

/// A complex index that has `color` as its reflectance along the normal, Gulbrandsen 2014, for a grey edge tint of a
/// half.
void set_index(Vec3 color, Material& m) {
  auto index = [](float r, float& n, float& k) {
    r = std::max(0.01f, std::min(r, 0.99f));
    float root = std::sqrt(r);
    n = 0.5f * (1.f - r) / (1.f + r) + 0.5f * (1.f + root) / (1.f - root);
    k = std::sqrt(std::max(0.f, (r * (n + 1.f) * (n + 1.f) - (n - 1.f) * (n - 1.f)) / (1.f - r)));
  };
  index(color.x, m.n.x, m.k.x), index(color.y, m.n.y, m.k.y), index(color.z, m.n.z, m.k.z);
}

float number(const tinyobj::material_t& given, const char* key) {
  auto found = given.unknown_parameter.find(key);
  return found == given.unknown_parameter.end() ? 0.f : std::strtof(found->second.c_str(), nullptr);
}

class Textures {
 public:
  Textures(std::filesystem::path folder, Scene& scene) : folder_(std::move(folder)), scene_(scene) {}
  int number_of(const std::string& name, bool colors) {
    if (name.empty()) return -1;
    auto [entry, is_new] = numbers_.try_emplace(name, static_cast<int>(scene_.textures.size()));
    if (is_new) scene_.textures.push_back(read_texture(folder_ / name, colors));
    return entry->second;
  }

 private:
  std::filesystem::path folder_;
  Scene& scene_;
  std::map<std::string, int> numbers_;
};

Material material_of(const tinyobj::material_t& given, Textures& textures) {
  Material m;
  m.color = vec3(given.diffuse);
  m.emission = vec3(given.emission);
  float alpha = given.roughness * given.roughness;
  float aspect = std::sqrt(1.f - 0.9f * std::min(1.f, std::max(0.f, given.anisotropy)));  // Burley 2012
  m.alpha_x = std::max(1e-3f, alpha / aspect), m.alpha_y = std::max(1e-3f, alpha * aspect);
  m.theta_z = 2.f * kPi * given.anisotropy_rotation;
  m.theta_x = 2.f * kPi * number(given, "lean_x"), m.theta_y = 2.f * kPi * number(given, "lean_y");
  m.eta = given.ior > 1.001f ? given.ior : 1.5f;
  m.color_map = textures.number_of(given.diffuse_texname, true);
  m.roughness_map = textures.number_of(given.roughness_texname, false);
  auto angles = given.unknown_parameter.find("map_anisor");
  if (angles != given.unknown_parameter.end()) m.angle_map = textures.number_of(angles->second, false);
  m.normal_map = textures.number_of(given.normal_texname, false);
  Vec3 filter = vec3(given.transmittance);
  if (given.metallic >= 0.5f) {
    set_index(m.color, m);
    m.kind = m.theta_x != 0.f || m.theta_y != 0.f   ? Kind::leaning
             : m.theta_z != 0.f || m.angle_map >= 0 ? Kind::brushed
                                                    : Kind::conductor;
  } else if (largest(filter) > 0.f || given.dissolve < 0.5f) {
    m.kind = Kind::dielectric;
    m.color = largest(filter) > 0.f ? filter : Vec3{1.f, 1.f, 1.f};
    m.eta = given.ior > 0.f ? given.ior : 1.5f;
  } else if (given.roughness > 0.f) {
    m.kind = Kind::plastic;
  }
  return m;
}

/// All of it in view, from a little above.
void aim(Scene& scene) {
  Vec3 low = scene.triangles[0].corners[0].position, high = low;
  for (const Triangle& t : scene.triangles)
    for (const Corner& c : t.corners) {
      low = {std::min(low.x, c.position.x), std::min(low.y, c.position.y), std::min(low.z, c.position.z)};
      high = {std::max(high.x, c.position.x), std::max(high.y, c.position.y), std::max(high.z, c.position.z)};
    }
  scene.camera.at = 0.5f * (low + high);
  scene.camera.from = scene.camera.at + length(high - low) * Vec3{0.4f, 0.4f, 1.2f};
}

}  // namespace

Scene read_obj(const std::string& file) {
  auto fail = [&](const std::string& why) { throw std::runtime_error(file + ": " + why); };
  tinyobj::ObjReader reader;
  if (!reader.ParseFromFile(file)) fail("cannot be read as OBJ");
  const auto& attributes = reader.GetAttrib();
  Scene scene;
  Textures textures(std::filesystem::path(file).parent_path(), scene);
  for (const auto& given : reader.GetMaterials()) scene.materials.push_back(material_of(given, textures));
  scene.materials.push_back({});  // of faces that have none

  auto corner = [&](const tinyobj::index_t& i) {
    if (i.normal_index < 0) fail("a face has no normals");
    auto at = [](const std::vector<float>& values, int index, std::size_t size) {
      return &values.at(size * static_cast<std::size_t>(index) + size - 1) - (size - 1);
    };
    const float *position = at(attributes.vertices, i.vertex_index, 3),
                *normal = at(attributes.normals, i.normal_index, 3);
    if (i.texcoord_index < 0) return Corner{vec3(position), vec3(normal), {0.f, 0.f}};
    const float* uv = at(attributes.texcoords, i.texcoord_index, 2);
    return Corner{vec3(position), vec3(normal), {uv[0], uv[1]}};
  };
  for (const auto& shape : reader.GetShapes()) try {
      const auto& mesh = shape.mesh;
      for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
        scene.triangles.push_back(
            {{corner(mesh.indices[t]), corner(mesh.indices[t + 1]), corner(mesh.indices[t + 2])}});
        int material = mesh.material_ids[t / 3];
        scene.materials_of_triangles.push_back(material >= 0 ? material : static_cast<int>(scene.materials.size()) - 1);
      }
    } catch (const std::out_of_range&) {
      fail("a face has an index out of range");
    }
  if (scene.triangles.empty()) fail("has no faces");
  aim(scene);
  return scene;
}

}  // namespace wavefront
