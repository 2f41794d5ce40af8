// Shading of a batch: gather what the vertices are, sample the light, ask the library, and scatter shadow rays and the
// rays that go on.
#include "fresnel.h"
#include "intersect.h"
#include "queues.h"
#include "sobol.h"

namespace wavefront {
namespace {

constexpr std::uint32_t kSureDepth = 3, kMostDepth = 64;  // of Russian roulette

/// A view that the geometry shows to be on one side is so for the shading normal as well: where it is not, the normal
/// is turned towards the view until it just is.
Vec3 towards(Vec3 normal, Vec3 wo, float side) {
  constexpr float kGrazing = 0.01f;
  float cos = side * normal.dot(wo);
  return cos < kGrazing ? normalize(normal + (side * (kGrazing - cos)) * wo) : normal;
}

void gather(const Scene& scene, const Task& task, std::uint32_t first, std::uint32_t last, Worker& w) {
  const Paths& paths = *w.paths;
  Batch& b = w.batch;
  Vertices& v = w.vertices;
  b.count = 0;
  for (std::uint32_t at = first; at < last; ++at) {
    std::uint32_t p = w.hits.order[at], slot = paths.slot[p], i = b.count;
    Primitive primitive = w.hits.primitive[p];
    Vec3 origin = paths.origin.get(p), direction = paths.direction.get(p);
    Surface s = surface_at(scene, primitive, origin, direction);
    const Material& m = scene.material_of(primitive);
    if (m.emission != Vec3(0.f)) {  // lights do not reflect
      float weight = task.mis ? mis_weight(paths.pdf[p], light_pdf(scene, primitive, origin, s.position)) : 1.f;
      w.slots.radiance.add(slot, weight * (paths.throughput.get(p) * m.emission));
      continue;
    }
    auto mapped = [&](int map, Vec3 without) { return map >= 0 ? scene.textures[map].look_up(s.uv) : without; };
    if (m.normal_map >= 0) {  // the normal of the tangents' frame, as a colour
      Vec3 n = 2.f * mapped(m.normal_map, {}) - Vec3(1.f);
      if (n.dot(n) > 0.01f) s.shading_normal = normalize(frame_of(s.shading_normal, s.tangent).to_world(n));
    }
    float side = s.normal.dot(direction) > 0.f ? -1.f : 1.f, rough = mapped(m.roughness_map, Vec3(1.f)).x;
    v.path[i] = p, v.material[i] = &m;
    v.position[i] = s.position, v.normal[i] = s.normal;
    v.color[i] = m.color * mapped(m.color_map, Vec3(1.f));
    v.frame[i] = frame_of(towards(s.shading_normal, -direction, side), s.tangent);
    b.wo.set(i, v.frame[i].to_local(-direction));
    b.alpha_x[i] = std::max(1e-4f, m.alpha_x * rough), b.alpha_y[i] = std::max(1e-4f, m.alpha_y * rough);
    float turns = m.angle_map >= 0 ? scene.textures[m.angle_map].nearest(s.uv).x : 0.f;
    b.theta_x[i] = m.theta_x, b.theta_y[i] = m.theta_y, b.theta_z[i] = m.theta_z + 2.f * kPi * turns;
    b.eta[i] = m.eta;
    Random4 r = random4(w.slots.sample[slot], w.slots.seed[slot], 2 * paths.depth[p] + 1);
    b.u.set(i, {r.x[0], r.x[1], r.x[2]});
    v.keep[i] = r.x[3];
    r = random4(w.slots.sample[slot], w.slots.seed[slot], 2 * paths.depth[p] + 2);
    v.light_u.set(i, {r.x[0], r.x[1], r.x[2]});
    ++b.count;
  }
}

/// The point off the surface that rays to a side start from. Light is sampled from there as well: from the surface
/// itself, the distance to the rim of a sphere would be another one, and the sphere would shade itself.
Vec3 off_surface(const Scene& scene, const Vertices& v, std::uint32_t i, float side) {
  return v.position[i] + (side < 0.f ? -scene.epsilon : scene.epsilon) * v.normal[i];
}

void sample_lights(const Scene& scene, const Task& task, Worker& w) {
  Batch& b = w.batch;
  Vertices& v = w.vertices;
  Columns3<kBatch>& disk = b.normal;  // x and y
  vndf::sample_disk(vndf::DiskMap::concentric, b.count, {v.light_u.x, v.light_u.y}, {disk.x, disk.y});
  for (std::uint32_t i = 0; i < b.count; ++i) {
    auto from = [&](float side) {
      return sample_light(scene, off_surface(scene, v, i, side), {v.light_u.x[i], v.light_u.y[i]},
                          {disk.x[i], disk.y[i]}, v.light_u.z[i]);
    };
    LightSample& light = v.light[i] = task.mis ? from(b.wo.z[i]) : LightSample();
    // Light on the other side of glass.
    if (light.wi.dot(v.normal[i]) * b.wo.z[i] < 0.f && std::isfinite(light.distance)) light = from(-b.wo.z[i]);
    if (!(light.pdf > 0.f)) light.wi = v.normal[i], light.radiance = Vec3(0.f);
    b.light.w.set(i, v.frame[i].to_local(light.wi));
  }
}

float chance_of_coat(Kind kind, const Batch& b, std::uint32_t i) {
  return kind == Kind::diffuse ? 0.f : 0.2f + 0.8f * dielectric_fresnel(std::abs(b.wo.z[i]), b.eta[i]);
}
/// The cosine-weighted direction of the batch's random numbers, for diffuse bodies, where they do not choose the coat.
void sample_bodies(Kind kind, Batch& b) {
  Columns3<kBatch>& disk = b.normal;
  vndf::sample_disk(vndf::DiskMap::concentric, b.count, {b.u.x, b.u.y}, {disk.x, disk.y});
  for (std::uint32_t i = 0; i < b.count; ++i) {
    if (b.u.z[i] < chance_of_coat(kind, b, i)) continue;
    float x = disk.x[i], y = disk.y[i];
    b.next.w.set(i, {x, y, std::copysign(std::sqrt(std::max(0.f, 1.f - x * x - y * y)), b.wo.z[i])});
  }
}

/// What light from a direction counts, and the density that the BSDF finds it with.
struct Response {
  Vec3 value;
  float pdf;
};
Response response(Kind kind, const Batch& b, const Vertices& v, const Directions& d, std::uint32_t i) {
  float value = d.value[i], pdf = d.pdf[i];
  float wi = b.wo.z[i] < 0.f ? -d.w.z[i] : d.w.z[i];  // over the side that is seen
  switch (kind) {
    case Kind::diffuse:
      return {std::max(0.f, wi) / kPi * v.color[i], std::max(0.f, wi) / kPi};
    case Kind::plastic: {  // the coat, and of what it lets in and out the body
      if (!(wi > 0.f)) return {Vec3(0.f), 0.f};
      float coat = chance_of_coat(kind, b, i), eta = b.eta[i];
      float in = 1.f - dielectric_fresnel(wi, eta), out = 1.f - dielectric_fresnel(std::abs(b.wo.z[i]), eta);
      return {Vec3(dielectric_fresnel(d.cosine[i], eta) * value) + (in * out * wi / kPi) * v.color[i],
              coat * pdf + (1.f - coat) * wi / kPi};
    }
    case Kind::dielectric:
      return {value * (wi < 0.f ? v.color[i] : Vec3(1.f)), pdf};
    default:
      return {value * conductor_fresnel(d.cosine[i], v.material[i]->n, v.material[i]->k), pdf};
  }
}

/// The geometry has to agree with the local frame about the side that a direction is on, or light would leak.
bool right_side(float local_z, float world_cos) {
  return local_z * world_cos > 0.f;
}

void scatter_shadow(const Scene& scene, Kind kind, std::uint32_t i, Worker& w) {
  const LightSample& light = w.vertices.light[i];
  if (light.radiance == Vec3(0.f)) return;
  float cos = light.wi.dot(w.vertices.normal[i]);
  Response r = response(kind, w.batch, w.vertices, w.batch.light, i);
  if (r.value == Vec3(0.f) || !right_side(w.batch.light.w.z[i], cos)) return;
  ShadowRays& shadows = w.shadows;
  std::uint32_t s = shadows.count++, p = w.vertices.path[i];
  shadows.origin.set(s, off_surface(scene, w.vertices, i, cos));
  shadows.direction.set(s, light.wi);
  shadows.distance[s] = light.distance * (1.f - 0x1p-12f) - scene.epsilon;
  shadows.radiance.set(
      s, (mis_weight(light.pdf, r.pdf) / light.pdf) * (w.paths->throughput.get(p) * (r.value * light.radiance)));
  shadows.slot[s] = w.paths->slot[p];
}

void scatter_path(const Scene& scene, Kind kind, std::uint32_t i, Worker& w) {
  Paths& next = *w.next;
  std::uint32_t p = w.vertices.path[i], to = next.count, depth = w.paths->depth[p] + 1;
  Response r = response(kind, w.batch, w.vertices, w.batch.next, i);
  if (kind == Kind::diffuse || kind == Kind::plastic) r.value *= r.pdf > 0.f ? 1.f / r.pdf : 0.f;
  Vec3 throughput = w.paths->throughput.get(p) * r.value;
  Vec3 wi = w.vertices.frame[i].to_world(w.batch.next.w.get(i));
  float cos = wi.dot(w.vertices.normal[i]);
  if (!(largest(throughput) > 0.f) || depth >= kMostDepth || !right_side(w.batch.next.w.z[i], cos)) return;
  // Glass takes nothing away. Its radiance is condensed within, which is no reason to end a path, and is undone where
  // the path leaves: the roulette waits for another surface.
  if (depth >= kSureDepth && kind != Kind::dielectric) {
    float chance = std::min(0.95f, largest(throughput));
    if (w.vertices.keep[i] >= chance) return;
    throughput *= 1.f / chance;
  }
  next.origin.set(to, off_surface(scene, w.vertices, i, cos));
  next.direction.set(to, normalize(wi));
  next.throughput.set(to, throughput);
  next.pdf[to] = r.pdf;
  next.slot[to] = w.paths->slot[p], next.depth[to] = depth;
  ++next.count;
}

}  // namespace

void shade(const Scene& scene, const Task& task, Kind kind, std::uint32_t first, std::uint32_t last, Worker& w) {
  gather(scene, task, first, last, w);
  w.statistics[Figure::vertices] += last - first;
  w.lap(Figure::gather);
  sample_lights(scene, task, w);
  w.lap(Figure::lights);
  shade_batch(kind, task.sampling, w.batch);
  if (kind == Kind::diffuse || kind == Kind::plastic) sample_bodies(kind, w.batch);
  if (kind == Kind::plastic) evaluate_coat(task.sampling, w.batch);
  if (kind != Kind::diffuse) w.statistics[Figure::shaded] += w.batch.count;
  w.lap(Figure::library);
  for (std::uint32_t i = 0; i < w.batch.count; ++i) {
    scatter_shadow(scene, kind, i, w);
    scatter_path(scene, kind, i, w);
  }
  w.lap(Figure::scatter);
}

}  // namespace wavefront
