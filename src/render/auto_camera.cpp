#include "render/auto_camera.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/hash.hpp"
#include "base/parallel.hpp"

namespace wold {

namespace {

constexpr int columns = 32;
constexpr int rows = 18;
constexpr int upper_rows = rows / 4;
constexpr int proposals = 480;
constexpr int places = 8;             // tried for each proposal
constexpr float lens_clearance = 4;   // m, within which plants are in the way
constexpr float wall_distance = 250;  // m, within which ground above the horizon shuts the view
constexpr float even_slope = 18;      // degrees, up to which one stands well
constexpr int depth_classes = 12;     // from 2 m up, doubling

struct Proposal {
  Camera camera;
  float score = 0;
  bool landscape = false;
};

float bump(float x, float middle, float width) {
  const float d = (x - middle) / width;
  return std::exp(-d * d);
}

Vec3 direction_of(float azimuth, float elevation) {
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

/// Of a list that `check_camera` has passed.
Vec3 vector_of(const std::vector<double>& list) {
  return {static_cast<float>(list[0]), static_cast<float>(list[1]), static_cast<float>(list[2])};
}

void check_length(const std::vector<double>& list, const char* name,
                  std::initializer_list<std::size_t> allowed) {
  if (std::find(allowed.begin(), allowed.end(), list.size()) != allowed.end()) return;
  throw Error(ErrorKind::input,
              fmt::format("'{}' in 'camera' is a list of {} numbers, but must be of {}", name,
                          list.size(), fmt::join(allowed, " or ")));
}

/// The camera of the settings, with a position and a direction where they give none; without tilt.
Camera aimed(const Ground& ground, const CameraSettings& s, Vec3 position, Vec3 direction) {
  Camera camera;
  camera.field_of_view = s.field_of_view;
  camera.aperture = s.aperture;
  camera.focus = s.focus;
  camera.position = position;
  camera.direction = direction;
  if (s.position.size() == 2) {
    const DVec2 place(s.position[0], s.position[1]);
    camera.position = Vec3(Vec2(place), ground.base(place).height + s.look_height);
  } else if (!s.position.empty()) {
    camera.position = vector_of(s.position);
  }
  if (!s.target.empty()) {
    const Vec3 towards = vector_of(s.target) - camera.position;
    const float distance = glm::length(towards);
    camera.direction = distance > 0 ? towards / distance : Vec3(0, 1, 0);
  } else if (!s.look_direction.empty()) {
    camera.direction = glm::normalize(vector_of(s.look_direction));
  }
  return camera;
}

Camera tilted(Camera camera, float tilt) {
  if (tilt == 0) return camera;
  const float elevation = std::asin(std::clamp(camera.direction.z, -1.0F, 1.0F)) + radians(tilt);
  const float azimuth = std::atan2(camera.direction.y, camera.direction.x);
  camera.direction = direction_of(azimuth, std::clamp(elevation, -0.4999F * pi, 0.4999F * pi));
  return camera;
}

float score_of(const ViewStatistics& v, float side_light, bool plants) {
  float score = 2.2F * bump(v.sky, 0.34F, 0.16F) + 1.2F * v.depth_variety +
                0.7F * std::min(1.0F, v.skyline / 0.08F) + 0.6F * side_light + 0.8F * v.sky_above -
                6 * v.near_share - 3 * v.wall;
  if (plants)
    score += 1.3F * bump(v.plants, 0.34F, 0.2F) + 0.6F * std::min(1.0F, v.middle_share / 0.2F) +
             0.9F * std::min(1.0F, v.far_share / 0.12F);
  else
    score += 2.4F * std::min(1.0F, v.far_share / 0.35F) -  // bare land is worth its shapes
             4 * std::max(0.0F, v.near_ground + v.wall - 0.3F);
  return score;
}

class Finder {
 public:
  Finder(const RayScene& scene, const CameraSettings& settings, float aspect, std::uint64_t seed)
      : scene_(scene),
        settings_(settings),
        aspect_(aspect),
        seed_(seed),
        plants_(!scene.world().instances.empty()) {}

  Proposal judged(int number, float height_factor) const {
    Proposal p{proposed(number, height_factor), 0, false};
    const ViewStatistics view = look_around(scene_, p.camera, aspect_);
    const Vec3 sun = scene_.world().sky.sun_direction();
    const Vec2 along = glm::normalize(Vec2(p.camera.direction) + Vec2(1e-6F, 0));
    const Vec2 sunward = glm::normalize(Vec2(sun) + Vec2(1e-6F, 0));
    const float side_light = bump(glm::dot(along, sunward), -0.15F, 0.6F);
    p.landscape = shows_landscape(view, plants_);
    p.score = score_of(view, side_light, plants_) + 0.4F * height_rank(p.camera.position) -
              std::max(0.0F, slope_at(DVec2(Vec2(p.camera.position))) - even_slope) / 15;
    return p;
  }

 private:
  float random(int number, int which) const {
    return uniform(random_bits(seed_, hash_text(std::string_view("camera")), number, which));
  }

  /// 0 in the lowest place of the field, 1 in the highest: a little height opens the view.
  float height_rank(Vec3 position) const {
    if (!settings_.expected_height.empty())
      return -std::abs(position.z - static_cast<float>(settings_.expected_height[0])) / 20;
    const Range range = scene_.world().ground.height_range();
    return std::clamp((position.z - range.low) / std::max(1.0F, range.high - range.low), 0.0F,
                      1.0F);
  }

  /// Of the ground below, degrees.
  float slope_at(DVec2 place) const {
    return degrees(std::atan(glm::length(scene_.world().ground.base(place).gradient)));
  }

  Camera proposed(int number, float height_factor) const {
    const Ground& ground = scene_.world().ground;
    const DVec2 size = ground.field().size();
    const double offset =
        std::min(static_cast<double>(settings_.edge_min_offset), 0.4 * std::min(size.x, size.y));
    const DVec2 room = size - 2 * offset;
    DVec2 place{0};
    for (int k = 0; k < places; ++k) {  // the first even one
      place = ground.field().origin + offset +
              room * DVec2(static_cast<double>(random(number, 4 * k)),
                           static_cast<double>(random(number, 4 * k + 1)));
      if (slope_at(place) < even_slope) break;
    }
    const Vec3 position(Vec2(place),
                        ground.base(place).height + settings_.look_height * height_factor);
    const float elevation = radians(std::lerp(-9.0F, 5.0F, random(number, 3)));
    return aimed(ground, settings_, position, direction_of(2 * pi * random(number, 2), elevation));
  }

  const RayScene& scene_;
  const CameraSettings& settings_;
  float aspect_;
  std::uint64_t seed_;
  bool plants_;
};

Proposal best_of(const Finder& finder, float height_factor, Progress& progress) {
  std::vector<Proposal> list(proposals);
  progress.begin("looking for a view", proposals, "views");
  parallel_for(0, proposals, [&](int k) {
    list[static_cast<std::size_t>(k)] = finder.judged(k, height_factor);
    progress.advance();
  });
  progress.end();
  const auto worse = [](const Proposal& a, const Proposal& b) {
    return a.landscape != b.landscape ? b.landscape : a.score < b.score;
  };
  return *std::max_element(list.begin(), list.end(), worse);
}

}  // namespace

Description<CameraSettings> describe(const CameraSettings&) {
  using C = CameraSettings;
  const Limits meters{.unit = "m"};
  return Description<C>("camera",
                        "Where the picture is taken from; what is not given is chosen to show the "
                        "landscape well.")
      .add("name", &C::name, "Name for `--camera`.")
      .add("position", &C::position, meters,
           "Place [east, north, up]; [east, north] stands on the ground; empty: chosen.")
      .add("target", &C::target, meters, "Place [east, north, up] to look at.")
      .add("look_direction", &C::look_direction,
           "Direction [east, north, up] of view; empty: chosen.")
      .add("look_height", &C::look_height, {.unit = "m", .min = 0.01, .max = 1e5},
           "Height above ground where the position does not give it.")
      .add("edge_min_offset", &C::edge_min_offset, {.unit = "m", .min = 0, .max = 1e6},
           "Least distance of a chosen place from the border.")
      .add("expected_height", &C::expected_height, meters,
           "Choose a place near this height of ground; empty: any.")
      .add("field_of_view", &C::field_of_view, {.unit = "degrees", .min = 1, .max = 160},
           "Angle across the longer side of the picture.")
      .add("tilt", &C::tilt, {.unit = "degrees", .min = -90, .max = 90}, "Turns the view up.")
      .add("aperture", &C::aperture, {.unit = "m", .min = 0, .max = 10},
           "Diameter of the lens; 0 keeps everything sharp.")
      .add("focus", &C::focus, {.unit = "m", .min = 0.01, .max = 1e6}, "Distance that is sharp.");
}

void check_camera(const CameraSettings& c) {
  check_length(c.position, "position", {0, 2, 3});
  check_length(c.target, "target", {0, 3});
  check_length(c.look_direction, "look_direction", {0, 3});
  check_length(c.expected_height, "expected_height", {0, 1});
  const bool no_direction =
      (!c.look_direction.empty() && glm::length(vector_of(c.look_direction)) < 1e-6F) ||
      (!c.target.empty() && c.target == c.position);
  if (no_direction)
    throw Error(ErrorKind::input,
                "a camera looks nowhere: its look_direction is zero or its target is its position");
}

ViewStatistics look_around(const RayScene& scene, const Camera& camera, float aspect) {
  const CameraRays rays(camera, static_cast<int>(std::lround(1000 * aspect)), 1000);
  RayCount count;
  ViewStatistics v;
  std::array<float, depth_classes> classes{};
  std::array<float, columns> edge{};
  int surfaces = 0;
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j) {
      const Vec2 pixel((static_cast<float>(i) + 0.5F) * 1000 * aspect / columns,
                       (static_cast<float>(j) + 0.5F) * 1000 / rows);
      const Hit hit = scene.intersect(rays.ray(pixel, Vec2(0)), 0, true, count);
      if (!hit.valid()) {
        v.sky += 1;
        if (j < upper_rows) v.sky_above += 1;
        edge[static_cast<std::size_t>(i)] = static_cast<float>(j + 1) / rows;
        continue;
      }
      ++surfaces;
      const bool plant = hit.instance != Hit::ground;
      (plant ? v.plants : v.ground) += 1;
      if (plant && hit.distance < lens_clearance) v.near_share += 1;
      if (!plant && hit.distance < wall_distance) (j < rows / 2 ? v.wall : v.near_ground) += 1;
      if (hit.distance > 30 && hit.distance < 400) v.middle_share += 1;
      if (hit.distance >= 400) v.far_share += 1;
      const int depth = static_cast<int>(std::log2(std::max(hit.distance, 2.0F) / 2));
      classes[static_cast<std::size_t>(std::min(depth, depth_classes - 1))] += 1;
    }
  }
  constexpr float all = columns * rows;
  for (float* share : {&v.sky, &v.ground, &v.plants, &v.near_share, &v.middle_share, &v.far_share,
                       &v.wall, &v.near_ground})
    *share /= all;
  v.sky_above /= static_cast<float>(columns * upper_rows);
  for (const float number : classes) {
    if (number == 0) continue;
    const float p = number / static_cast<float>(surfaces);
    v.depth_variety -= p * std::log(p) / std::log(static_cast<float>(depth_classes));
  }
  float mean = 0;
  for (const float e : edge) mean += e / columns;
  for (const float e : edge) v.skyline += (e - mean) * (e - mean) / columns;
  v.skyline = std::sqrt(v.skyline);
  return v;
}

bool shows_landscape(const ViewStatistics& v, bool plants) {
  return v.sky >= 0.08F && v.sky <= 0.75F && v.ground >= 0.06F && v.near_share <= 0.02F &&
         v.sky_above >= 0.2F && (!plants || v.plants >= 0.04F);
}

bool is_placed(const CameraSettings& s) {
  return !s.position.empty() && (!s.target.empty() || !s.look_direction.empty());
}

Camera placed_camera(const Ground& ground, const CameraSettings& settings) {
  check_camera(settings);
  return tilted(aimed(ground, settings, Vec3(0), Vec3(0, 1, 0)), settings.tilt);
}

Camera find_camera(const RayScene& scene, const CameraSettings& settings, float aspect,
                   std::uint64_t seed, Progress& progress) {
  if (is_placed(settings)) return placed_camera(scene.world().ground, settings);
  check_camera(settings);
  const Finder finder(scene, settings, aspect, seed);
  Proposal best = best_of(finder, 1, progress);
  // Dense forest may hide everything from its floor: then the camera is raised.
  for (float factor = 4; !best.landscape && factor <= 64 && settings.position.empty(); factor *= 4)
    best = best_of(finder, factor, progress);
  return tilted(best.camera, settings.tilt);
}

}  // namespace wold
