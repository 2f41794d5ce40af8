// Shading of a batch: gather what the vertices are, sample the light, ask the library, and scatter shadow rays and the
// rays that go on.
#include "fresnel.h"
#include "lights.h"
#include "sobol.h"
#include "worker.h"

namespace wavefront {
namespace {

constexpr std::uint32_t kSureDepth = 3, kMostDepth = 64;  // of Russian roulette

/// Normal maps: the tangent frame's normal as a colour.
Vec3 mapped_normal(const Texture& map, const Surface& s) {
  Vec3 n = 2.f * look_up(map, s.uv) - Vec3{1.f, 1.f, 1.f};
  return dot(n, n) > 0.01f ? normalize(to_world(frame_of(s.shading_normal, s.tangent), n)) : s.shading_normal;
}

/// A view that the geometry shows to be on one side is so for the shading normal as well: where it is not, the normal
/// is turned towards the view until it just is.
Vec3 towards(Vec3 normal, Vec3 wo, float side) {
  constexpr float kGrazing = 0.01f;
  float cos = side * dot(normal, wo);
  return cos < kGrazing ? normalize(normal + (side * (kGrazing - cos)) * wo) : normal;
}

void gather(const Scene& scene, const Settings& settings, std::uint32_t first, std::uint32_t last, Worker& w) {
  Paths& paths = w.paths;
  Batch& b = w.batch;
  Vertices& v = w.vertices;
  b.count = 0;
  for (std::uint32_t at = first; at < last; ++at) {
    std::uint32_t p = w.hits.order[at], i = b.count;
    Primitive primitive = w.hits.primitive[p];
    Vec3 origin = paths.origin.get(p), direction = paths.direction.get(p), wo = -1.f * direction;
    Surface s = surface_at(scene, primitive, origin, direction);
    const Material& m = scene.materials[scene.material_of(primitive)];
    if (!is_zero(m.emission)) {  // lights do not reflect
      float weight =
          settings.mis ? mis_weight(paths.pdf[p], light_pdf(scene, primitive, origin, s.position, s.normal)) : 1.f;
      w.radiance.add(paths.slot[p], weight * (paths.throughput.get(p) * m.emission));
      continue;
    }
    float side = dot(s.normal, wo) < 0.f ? -1.f : 1.f;
    if (m.normal_map >= 0) s.shading_normal = mapped_normal(scene.textures[m.normal_map], s);
    v.path[i] = p;
    v.material[i] = &m;
    v.position[i] = s.position;
    v.normal[i] = s.normal;
    v.color[i] = m.color_map >= 0 ? m.color * look_up(scene.textures[m.color_map], s.uv) : m.color;
    v.frame[i] = frame_of(towards(s.shading_normal, wo, side), s.tangent);
    b.wo.set(i, to_local(v.frame[i], wo));
    float rough = m.roughness_map >= 0 ? look_up(scene.textures[m.roughness_map], s.uv).x : 1.f;
    b.alpha_x[i] = std::max(1e-4f, m.alpha_x * rough), b.alpha_y[i] = std::max(1e-4f, m.alpha_y * rough);
    b.theta_z[i] =
        m.theta_z + (m.angle_map >= 0 ? 2.f * kPi * look_up_nearest(scene.textures[m.angle_map], s.uv).x : 0.f);
    b.eta[i] = m.eta;
    Random4 r = random4(paths.sample[p], paths.seed[p], 2 * paths.depth[p] + 1);
    b.u.set(i, {r.x[0], r.x[1], r.x[2]});
    v.keep[i] = r.x[3];
    r = random4(paths.sample[p], paths.seed[p], 2 * paths.depth[p] + 2);
    v.light_u[i] = r.x[0], v.light_v[i] = r.x[1], v.select[i] = r.x[2];
    ++b.count;
  }
}

/// The point off the surface that rays to a side start from. Light is sampled from there as well: from the surface
/// itself, the distance to the rim of a sphere would be another one, and the sphere would shade itself.
Vec3 off_surface(const Scene& scene, const Vertices& v, std::uint32_t i, float side) {
  return v.position[i] + (side < 0.f ? -scene.epsilon : scene.epsilon) * v.normal[i];
}

void sample_lights(const Scene& scene, const Settings& settings, Worker& w) {
  Batch& b = w.batch;
  Vertices& v = w.vertices;
  vndf::sample_disk(vndf::DiskMap::concentric, b.count, {v.light_u.data(), v.light_v.data()},
                    {v.disk_x.data(), v.disk_y.data()});
  for (std::uint32_t i = 0; i < b.count; ++i) {
    auto from = [&](float side) {
      return sample_light(scene, off_surface(scene, v, i, side), {v.light_u[i], v.light_v[i]},
                          {v.disk_x[i], v.disk_y[i]}, v.select[i]);
    };
    LightSample& light = v.light[i] = settings.mis ? from(b.wo.z[i]) : LightSample{};
    // Light on the other side of glass.
    if (dot(light.wi, v.normal[i]) * b.wo.z[i] < 0.f && std::isfinite(light.distance)) light = from(-b.wo.z[i]);
    if (!(light.pdf > 0.f)) light = {v.normal[i], 0.f, {0.f, 0.f, 0.f}, 1.f};
    b.light.set(i, to_local(v.frame[i], light.wi));
  }
}

/// The cosine-weighted direction of the batch's random numbers, for diffuse bodies, where `wanted` says so.
template <class Wanted>
void sample_cosines(Batch& b, Vertices& v, Wanted wanted) {
  vndf::sample_disk(vndf::DiskMap::concentric, b.count, {b.u.x.data(), b.u.y.data()},
                    {v.disk_x.data(), v.disk_y.data()});
  for (std::uint32_t i = 0; i < b.count; ++i) {
    if (!wanted(i)) continue;
    float x = v.disk_x[i], y = v.disk_y[i];
    b.wi.set(i, {x, y, std::copysign(std::sqrt(std::max(0.f, 1.f - x * x - y * y)), b.wo.z[i])});
  }
}

/// Of a direction, over the side of the surface that is seen.
float height(const Batch& b, std::uint32_t i, float z) {
  return b.wo.z[i] < 0.f ? -z : z;
}

/// What light from one direction counts, and the density that the BSDF finds it with.
struct Response {
  Vec3 f_cos;
  float pdf;
};

/// Plastic: the coat, and of what it lets in and out the body.
Vec3 body_of_plastic(const Batch& b, const Vertices& v, std::uint32_t i, float wi_z) {
  float in = 1.f - dielectric_fresnel(std::max(0.f, wi_z), b.eta[i]);
  float out = 1.f - dielectric_fresnel(std::abs(b.wo.z[i]), b.eta[i]);
  return (in * out * wi_z / kPi) * v.color[i];
}
float chance_of_coat(const Batch& b, std::uint32_t i) {
  return 0.2f + 0.8f * dielectric_fresnel(std::abs(b.wo.z[i]), b.eta[i]);
}
Response plastic(const Batch& b, const Vertices& v, std::uint32_t i, float wi_z, float cosine, float f_cos, float pdf) {
  if (!(wi_z > 0.f)) return {{0.f, 0.f, 0.f}, 0.f};
  float f = dielectric_fresnel(cosine, b.eta[i]) * f_cos, coat = chance_of_coat(b, i);
  return {Vec3{f, f, f} + body_of_plastic(b, v, i, wi_z), coat * pdf + (1.f - coat) * wi_z / kPi};
}

Response light_response(Kind kind, const Batch& b, const Vertices& v, std::uint32_t i) {
  float z = b.light.z[i], f_cos = b.light_f_cos[i], pdf = b.light_pdf[i];
  switch (kind) {
    case Kind::diffuse:
      z = std::max(0.f, height(b, i, z)) / kPi;
      return {z * v.color[i], z};
    case Kind::plastic:
      return plastic(b, v, i, height(b, i, z), b.light_cosine[i], f_cos, pdf);
    case Kind::dielectric: {
      bool crosses = (z < 0.f) != (b.wo.z[i] < 0.f);
      return {f_cos * (crosses ? v.color[i] : Vec3{1.f, 1.f, 1.f}), pdf};
    }
    default:
      return {f_cos * conductor_fresnel(b.light_cosine[i], v.material[i]->n, v.material[i]->k), pdf};
  }
}

/// f cos / pdf of the direction that was sampled.
Vec3 sample_weight(Kind kind, Batch& b, const Vertices& v, std::uint32_t i) {
  switch (kind) {
    case Kind::diffuse:
      b.pdf[i] = std::abs(b.wi.z[i]) / kPi;
      return v.color[i];
    case Kind::plastic: {
      Response r = plastic(b, v, i, height(b, i, b.wi.z[i]), b.cosine[i], b.weight[i], b.pdf[i]);
      b.pdf[i] = r.pdf;
      return r.pdf > 0.f ? (1.f / r.pdf) * r.f_cos : Vec3{0.f, 0.f, 0.f};
    }
    case Kind::dielectric:
      return b.weight[i] * (b.side[i] < 0.f ? v.color[i] : Vec3{1.f, 1.f, 1.f});
    default:
      return b.weight[i] * conductor_fresnel(b.cosine[i], v.material[i]->n, v.material[i]->k);
  }
}

/// The geometry has to agree with the local frame about the side that a direction is on, or light would leak.
bool right_side(float local_z, float world_cos) {
  return local_z * world_cos > 0.f;
}

void scatter_shadows(const Scene& scene, Kind kind, Worker& w) {
  Batch& b = w.batch;
  Vertices& v = w.vertices;
  for (std::uint32_t i = 0; i < b.count; ++i) {
    const LightSample& light = v.light[i];
    if (is_zero(light.radiance)) continue;
    float cos = dot(light.wi, v.normal[i]);
    Response r = light_response(kind, b, v, i);
    if (is_zero(r.f_cos) || !right_side(b.light.z[i], cos)) continue;
    std::uint32_t s = w.shadows.count++, p = v.path[i];
    w.shadows.origin.set(s, off_surface(scene, v, i, cos));
    w.shadows.direction.set(s, light.wi);
    w.shadows.distance[s] = light.distance * (1.f - 0x1p-12f) - scene.epsilon;
    w.shadows.radiance.set(
        s, (mis_weight(light.pdf, r.pdf) / light.pdf) * (w.paths.throughput.get(p) * (r.f_cos * light.radiance)));
    w.shadows.slot[s] = w.paths.slot[p];
  }
}

void scatter_paths(const Scene& scene, Kind kind, Worker& w) {
  Batch& b = w.batch;
  Vertices& v = w.vertices;
  for (std::uint32_t i = 0; i < b.count; ++i) {
    std::uint32_t p = v.path[i], to = w.next.count, depth = w.paths.depth[p] + 1;
    Vec3 throughput = w.paths.throughput.get(p) * sample_weight(kind, b, v, i);
    if (!(largest(throughput) > 0.f) || depth >= kMostDepth) continue;
    Vec3 wi = to_world(v.frame[i], b.wi.get(i));
    float cos = dot(wi, v.normal[i]);
    if (!right_side(b.wi.z[i], cos)) continue;
    // Glass takes nothing away. Its radiance is condensed within, which is no reason to end a path, and is undone where
    // the path leaves: the roulette waits for another surface.
    if (depth >= kSureDepth && kind != Kind::dielectric) {
      float chance = std::min(0.95f, largest(throughput));
      if (v.keep[i] >= chance) continue;
      throughput = (1.f / chance) * throughput;
    }
    w.next.origin.set(to, off_surface(scene, v, i, cos));
    w.next.direction.set(to, normalize(wi));
    w.next.throughput.set(to, throughput);
    w.next.pdf[to] = b.pdf[i];
    w.next.slot[to] = w.paths.slot[p];
    w.next.seed[to] = w.paths.seed[p];
    w.next.sample[to] = w.paths.sample[p];
    w.next.depth[to] = depth;
    ++w.next.count;
  }
}

}  // namespace

void shade(const Scene& scene, const Settings& settings, const Bin& bin, std::uint32_t first, std::uint32_t last,
           Worker& w) {
  Batch& b = w.batch;
  gather(scene, settings, first, last, w);
  w.statistics.vertices += last - first;
  w.clock.lap(w.statistics, Stage::gather);
  sample_lights(scene, settings, w);
  w.clock.lap(w.statistics, Stage::lights);

  const Material* leaning = bin.material >= 0 ? &scene.materials[bin.material] : nullptr;
  vndf::Ellipsoid shape({1.f, 1.f});
  if (leaning) shape = {{leaning->alpha_x, leaning->alpha_y}, leaning->theta_x, leaning->theta_y, leaning->theta_z};
  if (bin.kind != Kind::diffuse) shade_batch(bin.kind, shape, settings.sampling, b);
  if (bin.kind != Kind::diffuse) w.statistics.shaded_by_library += b.count;
  if (bin.kind == Kind::diffuse) sample_cosines(b, w.vertices, [](std::uint32_t) { return true; });
  if (bin.kind == Kind::plastic) {
    sample_cosines(b, w.vertices, [&](std::uint32_t i) { return b.u.z[i] >= chance_of_coat(b, i); });
    evaluate_batch(settings.sampling, b);
  }
  w.clock.lap(w.statistics, Stage::library);
  scatter_shadows(scene, bin.kind, w);
  scatter_paths(scene, bin.kind, w);
  w.clock.lap(w.statistics, Stage::scatter);
}

}  // namespace wavefront
