// Shading of a batch: gather what the vertices are, sample the light, ask the library, and scatter shadow rays and the
// rays that go on.
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

void gather(const Scene& scene, const Bin& bin, std::uint32_t first, Worker& w) {
  const Paths& paths = *w.paths;
  Batch& b = w.batch;
  b.count = std::min(kBatch, bin.count - first);
  for (std::uint32_t i = 0; i < b.count; ++i) {
    std::uint32_t p = b.path[i] = bin.path[first + i], slot = paths.slot[p];
    Vec3 direction = paths.direction.get(p);
    Surface& s = b.surface[i] = surface_at(scene, w.hits[p], paths.origin.get(p), direction);
    const Material& m = *(b.material[i] = &scene.material_of(w.hits[p]));
    auto mapped = [&](const auto& map, Vec3 without) { return map ? map->look_up(s.uv) : without; };
    if (m.normal_map) {  // the normal of the tangents' frame, as a colour
      Vec3 n = 2.f * mapped(m.normal_map, {}) - Vec3(1.f);
      if (n.dot(n) > 0.01f) s.shading_normal = normalize(frame_of(s.shading_normal, s.tangent).to_world(n));
    }
    float side = s.normal.dot(direction) > 0.f ? -1.f : 1.f, rough = mapped(m.roughness_map, Vec3(1.f)).x;
    b.color[i] = m.color * mapped(m.color_map, Vec3(1.f));
    b.frame[i] = frame_of(towards(s.shading_normal, -direction, side), s.tangent);
    b.wo.set(i, b.frame[i].to_local(-direction));
    b.alpha_x[i] = std::max(1e-4f, m.alpha_x * rough), b.alpha_y[i] = std::max(1e-4f, m.alpha_y * rough);
    float turns = m.angle_map ? m.angle_map->nearest(s.uv).x : 0.f;
    b.theta_x[i] = m.theta_x, b.theta_y[i] = m.theta_y, b.theta_z[i] = m.theta_z + 2.f * kPi * turns;
    b.eta[i] = m.eta;
    Imath::V4f r = random4(w.sample[slot], w.seed[slot], 2 * paths.depth[p] + 1);
    b.u.set(i, {r.x, r.y, r.z});
    b.keep[i] = r.w;
    r = random4(w.sample[slot], w.seed[slot], 2 * paths.depth[p] + 2);
    b.light_u.set(i, {r.x, r.y, r.z});
  }
}

/// The point off the surface that rays to a side start from. Light is sampled from there as well: from the surface
/// itself, the distance to the rim of a sphere would be another one, and the sphere would shade itself.
Vec3 off_surface(const Scene& scene, const Surface& surface, float side) {
  return surface.position + (side < 0.f ? -scene.epsilon : scene.epsilon) * surface.normal;
}

void sample_lights(const Scene& scene, const Task& task, Batch& b) {
  Columns3<kBatch>& disk = b.scratch;  // x and y
  vndf::sample_disk(vndf::DiskMap::concentric, b.count, {b.light_u.x, b.light_u.y}, {disk.x, disk.y});
  for (std::uint32_t i = 0; i < b.count; ++i) {
    auto from = [&](float side) {
      return sample_light(scene, off_surface(scene, b.surface[i], side), {b.light_u.x[i], b.light_u.y[i]},
                          {disk.x[i], disk.y[i]}, b.light_u.z[i]);
    };
    LightSample& light = b.light_sample[i] = task.mis ? from(b.wo.z[i]) : LightSample();
    // Light on the other side of glass.
    if (light.wi.dot(b.surface[i].normal) * b.wo.z[i] < 0.f && std::isfinite(light.distance)) light = from(-b.wo.z[i]);
    if (!(light.pdf > 0.f)) light.wi = b.surface[i].normal, light.radiance = Vec3(0.f);
    b.light.w.set(i, b.frame[i].to_local(light.wi));
  }
}

/// Unpolarised light on a conductor of index n + i k, exactly: Born and Wolf, 14.2.
float conductor_fresnel(float cos, float n, float k) {
  float c2 = cos * cos, s2 = 1.f - c2, n2 = n * n, k2 = k * k;
  float difference = n2 - k2 - s2;
  float root = std::sqrt(difference * difference + 4.f * n2 * k2);  // a^2 + b^2
  float twice_a_cos = 2.f * cos * std::sqrt(std::max(0.f, 0.5f * (root + difference)));
  float rs = (root + c2 - twice_a_cos) / (root + c2 + twice_a_cos);
  float far = c2 * root + s2 * s2, near = twice_a_cos * s2;
  return 0.5f * rs * (1.f + (far - near) / (far + near));
}
/// From outside, eta > 1.
float dielectric_fresnel(float cos, float eta) {
  float g = std::sqrt(std::max(0.f, eta * eta - 1.f + cos * cos));
  float rs = (cos - g) / (cos + g), rp = (eta * eta * cos - g) / (eta * eta * cos + g);
  return 0.5f * (rs * rs + rp * rp);
}

float chance_of_coat(Kind kind, const Batch& b, std::uint32_t i) {
  return kind == Kind::diffuse ? 0.f : 0.2f + 0.8f * dielectric_fresnel(std::abs(b.wo.z[i]), b.eta[i]);
}
/// The cosine-weighted direction of the batch's random numbers, for diffuse bodies, where they do not choose the coat.
void sample_bodies(Kind kind, Batch& b) {
  Columns3<kBatch>& disk = b.scratch;
  vndf::sample_disk(vndf::DiskMap::concentric, b.count, {b.u.x, b.u.y}, {disk.x, disk.y});
  for (std::uint32_t i = 0; i < b.count; ++i) {
    if (b.u.z[i] < chance_of_coat(kind, b, i)) continue;
    float x = disk.x[i], y = disk.y[i];
    b.next.w.set(i, {x, y, std::copysign(std::sqrt(std::max(0.f, 1.f - x * x - y * y)), b.wo.z[i])});
  }
}

/// What light from a direction counts, and the density that the BSDF finds it with.
std::pair<Vec3, float> response(Kind kind, const Batch& b, const Directions& d, std::uint32_t i) {
  float value = d.value[i], pdf = d.pdf[i];
  float wi = b.wo.z[i] < 0.f ? -d.w.z[i] : d.w.z[i];  // over the side that is seen
  switch (kind) {
    case Kind::diffuse:
      return {std::max(0.f, wi) / kPi * b.color[i], std::max(0.f, wi) / kPi};
    case Kind::plastic: {  // the coat, and of what it lets in and out the body
      if (!(wi > 0.f)) return {Vec3(0.f), 0.f};
      float coat = chance_of_coat(kind, b, i), eta = b.eta[i];
      float in = 1.f - dielectric_fresnel(wi, eta), out = 1.f - dielectric_fresnel(std::abs(b.wo.z[i]), eta);
      return {Vec3(dielectric_fresnel(d.cosine[i], eta) * value) + (in * out * wi / kPi) * b.color[i],
              coat * pdf + (1.f - coat) * wi / kPi};
    }
    case Kind::dielectric:
      return {value * (wi < 0.f ? b.color[i] : Vec3(1.f)), pdf};
    default: {
      const Vec3 &n = b.material[i]->n, &k = b.material[i]->k;
      auto fresnel = [&](float n, float k) { return conductor_fresnel(d.cosine[i], n, k); };
      return {value * Vec3(fresnel(n.x, k.x), fresnel(n.y, k.y), fresnel(n.z, k.z)), pdf};
    }
  }
}

/// The geometry has to agree with the local frame about the side that a direction is on, or light would leak.
bool right_side(float local_z, float world_cos) {
  return local_z * world_cos > 0.f;
}
/// The ray to the light, and the one that goes on.
void scatter(const Scene& scene, Kind kind, std::uint32_t i, Worker& w) {
  const Batch& b = w.batch;
  const LightSample& light = b.light_sample[i];
  std::uint32_t p = b.path[i], slot = w.paths->slot[p], depth = w.paths->depth[p] + 1;
  Vec3 throughput = w.paths->throughput.get(p), wi = b.frame[i].to_world(b.next.w.get(i));
  float cos = wi.dot(b.surface[i].normal), light_cos = light.wi.dot(b.surface[i].normal);

  auto [lit, lit_pdf] = response(kind, b, b.light, i);
  if (light.pdf > 0.f && lit * light.radiance != Vec3(0.f) && right_side(b.light.w.z[i], light_cos)) {
    Vec3 radiance = (mis_weight(light.pdf, lit_pdf) / light.pdf) * (throughput * (lit * light.radiance));
    std::uint32_t s = w.shadows.add(off_surface(scene, b.surface[i], light_cos), light.wi, radiance, slot);
    w.shadows.distance[s] = light.distance * (1.f - 0x1p-12f) - scene.epsilon;
  }

  auto [value, pdf] = response(kind, b, b.next, i);
  if (kind == Kind::diffuse || kind == Kind::plastic) value *= pdf > 0.f ? 1.f / pdf : 0.f;
  throughput *= value;
  if (!(largest(throughput) > 0.f) || depth >= kMostDepth || !right_side(b.next.w.z[i], cos)) return;
  // Glass takes nothing away. Its radiance is condensed within, which is no reason to end a path, and is undone where
  // the path leaves: the roulette waits for another surface.
  if (depth >= kSureDepth && kind != Kind::dielectric) {
    float chance = std::min(0.95f, largest(throughput));
    if (b.keep[i] >= chance) return;
    throughput *= 1.f / chance;
  }
  std::uint32_t to = w.next->add(off_surface(scene, b.surface[i], cos), normalize(wi), throughput, slot);
  w.next->pdf[to] = pdf;
  w.next->depth[to] = depth;
}

}  // namespace

void shade(const Scene& scene, const Task& task, Kind kind, std::uint32_t first, Worker& w) {
  gather(scene, w.bins[static_cast<std::size_t>(kind)], first, w);
  w.lap("gather");
  sample_lights(scene, task, w.batch);
  w.lap("lights");
  shade_batch(kind, task.sampling, w.batch);
  if (kind == Kind::diffuse || kind == Kind::plastic) sample_bodies(kind, w.batch);
  if (kind == Kind::plastic) evaluate_coat(task.sampling, w.batch);
  w.lap("library");
  for (std::uint32_t i = 0; i < w.batch.count; ++i) scatter(scene, kind, i, w);
  w.lap("scatter");
  w.statistics["vertices"] += w.batch.count;
  if (kind != Kind::diffuse) w.statistics["shaded"] += w.batch.count;
}

}  // namespace wavefront
