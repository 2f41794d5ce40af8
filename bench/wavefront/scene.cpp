#include "scene.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <map>
#include <numeric>
#include <stdexcept>
#include <utility>

#include <tbb/task_arena.h>

#include "lights.h"

namespace wavefront {
namespace {

struct Cell {
  float x, y;     // coordinates in texels
  int left, top;  // of the texel
};
Cell cell_of(const Texture& t, Vec2 uv, float offset) {
  float x = (uv.x - std::floor(uv.x)) * t.width - offset;
  float y = (1.f - (uv.y - std::floor(uv.y))) * t.height - offset;
  return {x, y, static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y))};
}
const Vec3& texel(const Texture& t, int x, int y) {
  x = x < 0 ? x + t.width : x >= t.width ? x - t.width : x;
  y = y < 0 ? y + t.height : y >= t.height ? y - t.height : y;
  return t.texels[static_cast<std::size_t>(y) * t.width + x];
}

Vec3 geometric(const Triangle& t) {
  return cross(t.corners[1].position - t.corners[0].position, t.corners[2].position - t.corners[0].position);
}

void check(const Scene& s) {
  auto fail = [](const std::string& what) { throw std::runtime_error(what); };
  if (s.triangles.empty() && s.spheres.empty()) fail("the scene has no triangle");
  for (std::size_t i = 0; i < s.triangles.size(); ++i) {
    std::string name = "triangle " + std::to_string(i + 1);
    for (const Corner& c : s.triangles[i].corners) {
      if (!is_finite(c.position) || !is_finite(c.normal)) fail(name + " has a corner that is not finite");
      if (!(dot(c.normal, c.normal) > 1e-12f)) fail(name + " has a normal of no length");
    }
    if (!(length(geometric(s.triangles[i])) > 1e-18f)) fail(name + " has no area");
  }
  for (const Texture& t : s.textures)
    for (const Vec3& v : t.texels)
      if (!is_finite(v)) fail("a texture has a texel that is not finite");
  for (const SkyTexel& t : s.environment.texels)
    if (!is_finite(t.radiance)) fail("the environment has a texel that is not finite");
}

/// Surfaces of one kind are shaded together, whatever their roughness: that is a column. But a leaning one is one
/// ellipsoid.
void number_bins(Scene& s) {
  std::map<std::pair<Kind, int>, int> numbers;
  for (std::size_t i = 0; i < s.materials.size(); ++i) {
    Kind kind = s.materials[i].kind;
    int material = kind == Kind::leaning ? static_cast<int>(i) : -1;
    auto [entry, is_new] = numbers.try_emplace({kind, material}, static_cast<int>(s.bins.size()));
    if (is_new) s.bins.push_back({kind, material});
    s.materials[i].bin = entry->second;
  }
}

void list_lights(Scene& s) {
  std::size_t count = s.triangles.size() + s.spheres.size();
  s.light_share.assign(count, 0.f);
  double sum = 0;
  for (Primitive p = 0; p < count; ++p) {
    float light = luminance(s.materials[s.material_of(p)].emission);
    if (!(light > 0.f)) continue;
    bool flat = p < s.triangles.size();
    float r = flat ? 0.f : s.spheres[p - s.triangles.size()].radius;
    s.light_share[p] = light * (flat ? 0.5f * length(geometric(s.triangles[p])) : kPi * r * r);
    s.lights.push_back(p);
    sum += s.light_share[p];
  }
  double so_far = 0;
  for (Primitive p : s.lights) {
    so_far += s.light_share[p];
    s.light_sums.push_back(static_cast<float>(so_far / sum));
    s.light_share[p] = static_cast<float>(s.light_share[p] / sum);
  }
}

void make_tangents(Scene& s) {
  for (const Triangle& t : s.triangles) {
    const Corner* c = t.corners;
    float u1 = c[1].uv.x - c[0].uv.x, v1 = c[1].uv.y - c[0].uv.y;
    float u2 = c[2].uv.x - c[0].uv.x, v2 = c[2].uv.y - c[0].uv.y;
    float d = u1 * v2 - u2 * v1;
    Vec3 along = v2 * (c[1].position - c[0].position) - v1 * (c[2].position - c[0].position);
    float size = length(along);
    s.tangents.push_back(std::abs(d) > 1e-12f && size > 0.f ? ((d < 0.f ? -1.f : 1.f) / size) * along : Vec3{});
  }
}

void build_tree(Scene& s, const std::string& configuration) {
  std::shared_ptr<RTCDeviceTy> device(rtcNewDevice(configuration.c_str()), rtcReleaseDevice);
  if (!device) throw std::runtime_error("Embree does not accept the configuration " + configuration);
  s.tree.reset(rtcNewScene(device.get()), [device](RTCScene tree) { rtcReleaseScene(tree); });
  rtcSetSceneFlags(s.tree.get(), RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(s.tree.get(), RTC_BUILD_QUALITY_HIGH);
  auto attach = [&](RTCGeometryType type, unsigned id, auto fill) {
    RTCGeometry geometry = rtcNewGeometry(device.get(), type);
    fill(geometry);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(s.tree.get(), geometry, id);
    rtcReleaseGeometry(geometry);
  };
  if (!s.triangles.empty())
    attach(RTC_GEOMETRY_TYPE_TRIANGLE, 0, [&](RTCGeometry g) {
      std::size_t corners = 3 * s.triangles.size();
      rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, s.triangles.data(), 0, sizeof(Corner),
                                 corners);
      void* indices = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, corners / 3);
      std::iota(static_cast<unsigned*>(indices), static_cast<unsigned*>(indices) + corners, 0u);
    });
  if (!s.spheres.empty())
    attach(RTC_GEOMETRY_TYPE_SPHERE_POINT, 1, [&](RTCGeometry g) {
      rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, s.spheres.data(), 0, sizeof(Sphere),
                                 s.spheres.size());
    });
  // By one thread: the tree, and with it which of two triangles a ray through their edge meets, must not depend on how
  // many there are.
  tbb::task_arena(1).execute([&] { rtcCommitScene(s.tree.get()); });
  RTCBounds box;
  rtcGetSceneBounds(s.tree.get(), &box);
  Vec3 extent{box.upper_x - box.lower_x, box.upper_y - box.lower_y, box.upper_z - box.lower_z};
  s.epsilon = 0x1p-17f * length(extent);
}

}  // namespace

Vec3 look_up(const Texture& t, Vec2 uv) {
  Cell c = cell_of(t, uv, 0.5f);
  float x = c.x - static_cast<float>(c.left), y = c.y - static_cast<float>(c.top);
  return (1.f - y) * ((1.f - x) * texel(t, c.left, c.top) + x * texel(t, c.left + 1, c.top)) +
         y * ((1.f - x) * texel(t, c.left, c.top + 1) + x * texel(t, c.left + 1, c.top + 1));
}
Vec3 look_up_nearest(const Texture& t, Vec2 uv) {
  Cell c = cell_of(t, uv, 0.f);
  return texel(t, c.left, c.top);
}

void Scene::finish(const std::string& device) {
  check(*this);
  number_bins(*this);
  list_lights(*this);
  make_tangents(*this);
  build_tree(*this, device);
}

}  // namespace wavefront
