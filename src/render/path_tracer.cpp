#include "render/path_tracer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wold {

namespace {

// Pairs of random numbers that one bounce may draw; the camera draws the first ones.
constexpr std::uint32_t camera_pairs = 2;
constexpr std::uint32_t bounce_pairs = 4;
constexpr int first_roulette_bounce = 1;
// Above 1 fewer paths end early: dark leaves and rock would be noisy otherwise.
constexpr float roulette_factor = 2;
// After a diffuse bounce texture is averaged over this share of the distance.
constexpr float diffuse_spread = 0.15F;

float power_heuristic(float a, float b) {
  return a * a / (a * a + b * b);
}

float largest(Vec3 v) {
  return std::max({v.x, v.y, v.z});
}

bool black(Vec3 v) {
  return v.x <= 0 && v.y <= 0 && v.z <= 0;
}

/// How far from a surface a ray starts so as not to meet it again: rounding of world positions, and
/// of the distance.
float clearance(Vec3 position) {
  const Vec3 a = glm::abs(position);
  return 2e-4F + 4e-7F * std::max({a.x, a.y, a.z});
}

/// Whether light may pass between the surface and a direction: not through what is opaque, wherever
/// the normal for shading points.
bool open_to(const SurfacePoint& s, Vec3 direction) {
  return !black(s.transmittance) || glm::dot(direction, s.geometric_normal) > 0;
}

Ray leaving(const SurfacePoint& s, Vec3 direction) {
  const float side = glm::dot(direction, s.geometric_normal) < 0 ? -1.0F : 1.0F;
  return {s.position + side * clearance(s.position) * s.geometric_normal, direction};
}

SurfacePoint model_surface(const World& world, const Hit& hit, Vec3 view_direction,
                           float footprint) {
  const ModelInstance& instance = world.instances[hit.instance];
  const Model& model = world.models[instance.model];
  const TriangleMesh& mesh = model.mesh;
  const UVec3 corner = mesh.triangles[hit.triangle];
  const float w = 1 - hit.u - hit.v;
  const auto mixed = [&](const std::vector<Vec3>& list) {
    return w * list[corner.x] + hit.u * list[corner.y] + hit.v * list[corner.z];
  };
  std::size_t part = 0;
  while (part + 1 < mesh.parts.size() && hit.triangle >= mesh.parts[part + 1].first_triangle)
    ++part;
  const SurfaceMaterial& material = world.materials[model.part_materials[part]];

  SurfacePoint s;
  s.position = hit.position;
  s.geometric_normal = glm::dot(hit.normal, view_direction) > 0 ? -hit.normal : hit.normal;
  s.normal = s.geometric_normal;
  if (!mesh.normals.empty()) {
    Vec3 n = glm::normalize(instance_matrix(instance) * mixed(mesh.normals));
    if (glm::dot(n, s.geometric_normal) < 0) n = -n;
    if (std::isfinite(n.x + n.y + n.z)) s.normal = n;
  }
  // Neighbouring triangles make one leaf or needle twig; eight is near enough for their tint.
  const SurfaceColor color = material.at(mixed(mesh.positions), footprint / instance.scale,
                                         instance.individual, hit.triangle / 8);
  s.reflectance = color.reflectance;
  s.transmittance = color.transmittance;
  s.roughness = material.roughness();
  return s;
}

SurfacePoint ground_surface(const World& world, const Hit& hit, Vec3 view_direction,
                            float footprint) {
  SurfacePoint s;
  s.position = hit.position;
  s.geometric_normal = hit.normal.z < 0 ? -hit.normal : hit.normal;
  if (glm::dot(s.geometric_normal, view_direction) > 0) s.geometric_normal = -s.geometric_normal;
  const GroundSurface ground =
      world.ground.surface(DVec2(hit.position.x, hit.position.y), footprint);
  s.normal = ground.normal;
  s.reflectance = ground.reflectance;
  s.roughness = ground.roughness;
  return s;
}

/// A shading normal that faces away from the viewer, as happens at silhouettes, is brought to the
/// edge of view.
Vec3 facing(Vec3 normal, Vec3 view_direction) {
  const float d = glm::dot(normal, view_direction);
  constexpr float margin = 0.01F;
  return d > -margin ? glm::normalize(normal - (d + margin) * view_direction) : normal;
}

/// Light that reaches the surface straight from sun and sky, scattered towards the viewer. After
/// the first surface one of the two is chosen, each with probability 1/2: there a ray saved is
/// worth more than the noise it costs.
Vec3 direct_light(const RayScene& scene, const SurfacePoint& surface, const Bsdf& bsdf, bool both,
                  bool last, Vec2 u_sun, Vec2 u_sky, RayCount& count) {
  const Sky& sky = scene.world().sky;
  const bool sun_only = !both && u_sky.x < 0.5F;
  const bool sky_only = !both && !sun_only;
  Vec3 light(0);
  const auto add = [&](const SkySample& sample, bool by_bsdf_too) {
    if (!(sample.pdf > 0) || !open_to(surface, sample.direction)) return;
    Vec3 value = bsdf.evaluate(sample.direction) * sample.radiance / sample.pdf;
    if (black(value)) return;
    if (by_bsdf_too) value *= power_heuristic(sample.pdf, bsdf.pdf(sample.direction));
    const Ray ray = leaving(surface, sample.direction);
    if (scene.occluded(ray, 0, std::numeric_limits<float>::infinity(), count)) return;
    light += value;
  };
  if (!sky_only) add(sky.sample_sun(u_sun), false);
  if (!sun_only) add(sky.sample_sky(both ? u_sky : Vec2(2 * u_sky.x - 1, u_sky.y)), !last);
  return both ? light : 2.0F * light;
}

/// Adds where a ray came to, and before the first where it began.
void record(const RayScene& scene, const Ray& ray, const Hit& hit,
            std::vector<PathVertex>& vertices, RayCount& count) {
  constexpr float way_out = 100;  // m
  if (vertices.empty()) vertices.push_back({ray.origin, false, false});
  if (!hit.valid()) {
    vertices.push_back({ray.origin + way_out * ray.direction, false, false});
    return;
  }
  const Sky& sky = scene.world().sky;
  const Vec3 normal = glm::dot(hit.normal, ray.direction) > 0 ? -hit.normal : hit.normal;
  const Vec3 above = hit.position + clearance(hit.position) * normal;
  const bool lit = sky.sun_visible() && glm::dot(normal, sky.sun_direction()) > 0 &&
                   !scene.occluded({above, sky.sun_direction()}, 0,
                                   std::numeric_limits<float>::infinity(), count);
  vertices.push_back({hit.position, true, lit});
}

}  // namespace

SurfacePoint surface_at(const World& world, const Hit& hit, Vec3 view_direction, float footprint) {
  SurfacePoint s = hit.instance == Hit::ground
                       ? ground_surface(world, hit, view_direction, footprint)
                       : model_surface(world, hit, view_direction, footprint);
  s.normal = facing(s.normal, view_direction);
  return s;
}

PathSample trace_path(const RayScene& scene, const PathSettings& settings, const Ray& camera_ray,
                      float pixel_angle, Sampler& sampler, RayCount& count) {
  const World& world = scene.world();
  const Sky& sky = world.sky;
  PathSample result;
  Ray ray = camera_ray;
  Vec3 throughput(1);
  float bsdf_pdf = 0;
  float footprint_ratio = pixel_angle;  // footprint over distance
  float footprint = 0;
  for (int bounce = 0;; ++bounce) {
    const Hit hit = scene.intersect(ray, 0, bounce == 0, count);
    if (settings.vertices != nullptr) record(scene, ray, hit, *settings.vertices, count);
    if (!hit.valid()) {
      if (bounce == 0) {
        sampler.skip_to(camera_pairs);
        result.radiance += sky.seen(ray.origin, ray.direction, sampler.next().x);
      } else {
        result.radiance += throughput * sky.radiance(ray.direction) *
                           power_heuristic(bsdf_pdf, sky.sky_pdf(ray.direction));
      }
      break;
    }
    if (sky.has_air()) {
      const AirLight air = sky.air_light(ray.origin, ray.direction, hit.distance);
      result.radiance += throughput * air.light;
      throughput *= air.transmittance;
    }
    footprint += footprint_ratio * hit.distance;
    const SurfacePoint surface = surface_at(world, hit, ray.direction, footprint);
    if (bounce == 0) {
      result.albedo = surface.reflectance + surface.transmittance;
      result.normal = surface.normal;
      result.depth = hit.distance;
      result.cover = 1;
    }
    const Bsdf bsdf(surface.normal, -ray.direction, surface.reflectance, surface.transmittance,
                    surface.roughness);
    sampler.skip_to(camera_pairs + static_cast<std::uint32_t>(bounce) * bounce_pairs);
    const bool last = bounce >= settings.max_bounces;
    const Vec2 u_sun = sampler.next();
    const Vec2 u_sky = sampler.next();
    result.radiance +=
        throughput * direct_light(scene, surface, bsdf, bounce == 0, last, u_sun, u_sky, count);
    if (last) break;

    const Vec2 u = sampler.next();
    const Vec2 choice = sampler.next();
    const BsdfSample next = bsdf.sample(u, choice.x);
    if (!(next.pdf > 0) || !open_to(surface, next.direction)) break;
    throughput *= next.weight;
    if (bounce >= first_roulette_bounce) {
      const float survival = std::min(0.95F, roulette_factor * largest(throughput));
      if (choice.y >= survival) break;
      throughput /= survival;
    }
    if (black(throughput)) break;
    bsdf_pdf = next.pdf;
    footprint_ratio = diffuse_spread;
    ray = leaving(surface, next.direction);
  }
  return result;
}

}  // namespace wold
