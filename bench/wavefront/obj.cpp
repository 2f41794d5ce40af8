// OBJ files with the PBR keys of their materials: Pr, Pm, aniso, anisor, Ni, Tf, Ke, map_Kd, map_Pr, norm. And three of
// our own: lean_x and lean_y, theta_x and theta_y in turns, and map_anisor.
#include <cstdlib>
#include <filesystem>
#include <map>

#include <ImathBox.h>
#include <tiny_obj_loader.h>

#include "scene.h"

namespace wavefront {
namespace {

/// A complex index 1 + i k that has `r` as its reflectance along the normal.
float absorption(float r) {
  r = std::clamp(r, 0.01f, 0.99f);
  return 2.f * std::sqrt(r / (1.f - r));
}

/// `texture` answers what is in a file.
template <class TextureOf>
Material material_of(tinyobj::material_t given, TextureOf texture) {
  auto& own = given.unknown_parameter;
  auto turns = [&](const char* key) { return 2.f * kPi * std::strtof(own[key].c_str(), nullptr); };
  Material m;
  m.color = Vec3(given.diffuse[0], given.diffuse[1], given.diffuse[2]);
  m.emission = Vec3(given.emission[0], given.emission[1], given.emission[2]);
  Vec3 filter(given.transmittance[0], given.transmittance[1], given.transmittance[2]);
  float alpha = given.roughness * given.roughness;
  float aspect = std::sqrt(1.f - 0.9f * std::clamp(given.anisotropy, 0.f, 1.f));  // Burley 2012
  m.alpha_x = std::max(1e-3f, alpha / aspect), m.alpha_y = std::max(1e-3f, alpha * aspect);
  m.theta_x = turns("lean_x"), m.theta_y = turns("lean_y");
  m.theta_z = 2.f * kPi * given.anisotropy_rotation;
  m.n = Vec3(1.f), m.k = {absorption(m.color.x), absorption(m.color.y), absorption(m.color.z)};
  m.color_map = texture(given.diffuse_texname, true);
  m.roughness_map = texture(given.roughness_texname, false);
  m.angle_map = texture(own["map_anisor"], false);
  m.normal_map = texture(given.normal_texname, false);
  bool metal = given.metallic >= 0.5f, glass = !metal && (largest(filter) > 0.f || given.dissolve < 0.5f);
  m.eta = glass && given.ior > 0.f ? given.ior : given.ior > 1.001f ? given.ior : 1.5f;
  if (glass) m.color = largest(filter) > 0.f ? filter : Vec3(1.f);
  bool leans = m.theta_x != 0.f || m.theta_y != 0.f, turned = m.theta_z != 0.f || m.angle_map;
  Kind of_metal = leans ? Kind::leaning : turned ? Kind::brushed : Kind::conductor;
  Kind of_body = given.roughness > 0.f ? Kind::plastic : Kind::diffuse;
  m.kind = metal ? of_metal : glass ? Kind::dielectric : of_body;
  return m;
}

}  // namespace

Scene read_obj(const std::string& file) {
  tinyobj::ObjReader reader;
  if (!reader.ParseFromFile(file)) fail(file, "cannot be read as OBJ");
  if (reader.Warning().find("not found") != std::string::npos)
    fail(file, "a material, or a file of them, is not found");
  const auto& attributes = reader.GetAttrib();
  Scene scene;
  scene.environment = evening();
  std::map<std::string, std::shared_ptr<const Texture>> textures;
  auto texture = [&](const std::string& name, bool colors) {
    auto& read = textures[name];
    auto path = std::filesystem::path(file).parent_path() / name;
    if (!read && !name.empty()) read = std::make_shared<Texture>(read_texture(path, colors));
    return read;
  };
  for (const auto& given : reader.GetMaterials()) scene.materials.push_back(material_of(given, texture));
  const auto plain = static_cast<int>(scene.materials.size());
  scene.materials.push_back({});  // of faces that have none

  Imath::Box3f box;
  auto corner = [&](const tinyobj::index_t& i) {
    if (i.normal_index < 0) fail(file, "a face has no normals");
    auto at = [&](const std::vector<float>& values, int index, std::size_t size) {
      if (index < 0 || index >= static_cast<int>(values.size() / size)) fail(file, "a face has an index out of range");
      return &values[size * static_cast<std::size_t>(index)];
    };
    const float *p = at(attributes.vertices, i.vertex_index, 3), *n = at(attributes.normals, i.normal_index, 3);
    box.extendBy({p[0], p[1], p[2]});
    const float none[2] = {}, *uv = i.texcoord_index < 0 ? none : at(attributes.texcoords, i.texcoord_index, 2);
    return Corner{{p[0], p[1], p[2]}, {n[0], n[1], n[2]}, {uv[0], uv[1]}};
  };
  for (const auto& shape : reader.GetShapes())
    for (std::size_t t = 0; t < shape.mesh.material_ids.size(); ++t) {
      const tinyobj::index_t* i = &shape.mesh.indices[3 * t];
      int material = shape.mesh.material_ids[t];
      Triangle triangle{{corner(i[0]), corner(i[1]), corner(i[2])}, material < 0 ? plain : material};
      auto is_length = [](Vec3 v) { return v.dot(v) > 1e-36f && v.dot(v) < 1e36f; };
      if (!is_length(triangle.cross())) fail(file, "triangle " + std::to_string(t + 1) + " has no area, or too much");
      for (const Corner& c : triangle.corners)
        if (!is_length(c.normal)) fail(file, "triangle " + std::to_string(t + 1) + " has a normal of no length");
      scene.triangles.push_back(triangle);
    }
  if (scene.triangles.empty()) fail(file, "has no faces");
  // All of it in view, from a little above.
  scene.camera.at = box.center();
  scene.camera.from = scene.camera.at + box.size().length() * Vec3(0.4f, 0.4f, 1.2f);
  return scene;
}

}  // namespace wavefront
