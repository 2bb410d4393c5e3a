#include "view/camera_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "image/atomic_file.hpp"
#include "scene/toml_values.hpp"
#include "view/path_curves.hpp"

namespace wold {

namespace {

/// A key as a file has it; an empty list is not given.
struct KeyTable {
  double time = 0;
  std::vector<double> position;
  std::vector<double> target;
  std::vector<double> look_direction;
  double field_of_view = 55;
  double hour = 12;
  std::vector<double> sun;
  double exposure = 0;
};

Description<KeyTable> describe(const KeyTable&) {
  using K = KeyTable;
  const Limits meters{.unit = "m"};
  return Description<K>("key", "Where the camera is at a time, and what it looks at.")
      .add("time", &K::time, {.unit = "s", .min = 0, .max = 1e6}, "When, from the film's start.")
      .add("position", &K::position, meters, "Place [east, north, up].")
      .add("target", &K::target, meters, "Place [east, north, up] to look at.")
      .add("look_direction", &K::look_direction, "Direction [east, north, up] of view.")
      .add("field_of_view", &K::field_of_view, {.unit = "degrees", .min = 1, .max = 160},
           "Angle across the longer side of the picture.")
      .add("hour", &K::hour, {.unit = "h", .min = -24, .max = 240},
           "Time of day of the sun; beyond 24 the next day.")
      .add("sun", &K::sun, {.unit = "degrees", .min = -360, .max = 720},
           "Where the sun stands, [elevation, azimuth from north by east].")
      .add("exposure", &K::exposure, {.unit = "stops", .min = -30, .max = 30},
           "Brightness: +1 doubles the light.");
}

DVec3 vector_of(const std::vector<double>& list) {
  return {list[0], list[1], list[2]};
}

void check_length(const toml::table& table, const char* name, const std::vector<double>& list,
                  std::size_t length) {
  if (!table.contains(name) || list.size() == length) return;
  throw Error(ErrorKind::input,
              fmt::format("'{}' has {} numbers, but must have {}", name, list.size(), length),
              location_of(table.get(name)->source()));
}

CameraKey key_of(const toml::table& table) {
  KeyTable read;
  assign_all(describe(read), &read, table);
  const SourceLocation where = location_of(table.source());
  for (const char* name : {"time", "position"})
    if (!table.contains(name))
      throw Error(ErrorKind::input, fmt::format("a [[key]] needs '{}'", name), where);
  if (table.contains("target") == table.contains("look_direction"))
    throw Error(ErrorKind::input, "a [[key]] needs either 'target' or 'look_direction'", where);
  check_length(table, "position", read.position, 3);
  check_length(table, "target", read.target, 3);
  check_length(table, "look_direction", read.look_direction, 3);
  check_length(table, "sun", read.sun, 2);

  CameraKey key;
  key.time = read.time;
  key.position = vector_of(read.position);
  if (!read.target.empty()) key.target = vector_of(read.target);
  if (!read.look_direction.empty()) key.direction = vector_of(read.look_direction);
  const double length = glm::length(key.direction ? *key.direction : *key.target - key.position);
  if (!(length > 1e-9))
    throw Error(ErrorKind::input, "this [[key]] looks nowhere: its direction has no length", where);
  if (key.direction) *key.direction /= length;
  if (table.contains("field_of_view")) key.field_of_view = read.field_of_view;
  if (table.contains("hour")) key.hour = read.hour;
  if (!read.sun.empty()) key.sun = DVec2(read.sun[0], read.sun[1]);
  if (table.contains("exposure")) key.exposure = read.exposure;
  return key;
}

void add_key(CameraPath& path, const CameraKey& key, const SourceLocation& where) {
  if (!path.keys.empty() && key.time <= path.end())
    throw Error(
        ErrorKind::input,
        fmt::format("the times of keys must rise, but {} s follows {} s", key.time, path.end()),
        where);
  path.keys.push_back(key);
}

/// A value that only some keys give.
template <class Get>
std::optional<double> value_at(const CameraPath& path, double time, const Get& get) {
  std::vector<double> times;
  std::vector<double> values;
  for (const CameraKey& key : path.keys)
    if (const std::optional<double> value = get(key)) {
      times.push_back(key.time);
      values.push_back(*value);
    }
  if (times.empty()) return {};
  return monotone_at(times, values, time);
}

std::vector<double> times_of(const CameraPath& path) {
  std::vector<double> times;
  for (const CameraKey& key : path.keys) times.push_back(key.time);
  return times;
}

DVec3 direction_at(const CameraPath& path, double time, const DVec3& position) {
  const std::vector<double> times = times_of(path);
  std::vector<DVec3> targets;
  std::vector<DVec3> directions;
  for (const CameraKey& key : path.keys) {
    if (key.target) targets.push_back(*key.target);
    directions.push_back(key.direction ? *key.direction
                                       : glm::normalize(*key.target - key.position));
  }
  if (targets.size() == path.keys.size()) {
    const DVec3 way = spline_at(times, targets, time) - position;
    if (glm::length(way) > 1e-9) return glm::normalize(way);
  }
  return sphere_curve_at(times, directions, time);
}

std::string list_toml(const DVec3& v) {
  return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", v.x, v.y, v.z);
}

}  // namespace

std::string camera_key_reference() {
  const KeyTable key;
  return reference_markdown(describe(key), &key);
}

CameraPath parse_camera_path(const std::string& text, const std::string& source) {
  const toml::table root = parse_toml(text, source);
  CameraPath path;
  for (const auto& [name, node] : root) {
    const std::vector<std::string> known{"key"};
    if (name != "key")
      throw Error(ErrorKind::input,
                  fmt::format("unknown '{}' in a camera path.{}", name.str(),
                              suggestion(name.str(), known)),
                  key_location(name, node));
    const auto* array = node.as_array();
    if (array == nullptr || !array->is_homogeneous(toml::node_type::table))
      throw Error(ErrorKind::input, "'key' must be a list of sections, [[key]]",
                  location_of(node.source()));
    for (const toml::node& item : *array)
      add_key(path, key_of(*item.as_table()), location_of(item.source()));
  }
  if (path.keys.empty())
    throw Error(ErrorKind::input, "a camera path needs at least one [[key]]", {source, 0, 0});
  return path;
}

CameraPath read_camera_path(const std::string& file) {
  return parse_camera_path(read_file(file), file);
}

PathView camera_at(const CameraPath& path, double time) {
  const double t = std::clamp(time, path.begin(), path.end());
  std::vector<DVec3> places;
  for (const CameraKey& key : path.keys) places.push_back(key.position);
  const DVec3 position = spline_at(times_of(path), places, t);
  PathView view;
  view.camera.position = Vec3(position);
  view.camera.direction = Vec3(direction_at(path, t, position));
  if (const auto angle = value_at(path, t, [](const CameraKey& k) { return k.field_of_view; }))
    view.camera.field_of_view = static_cast<float>(*angle);
  view.hour = value_at(path, t, [](const CameraKey& k) { return k.hour; });
  view.exposure = value_at(path, t, [](const CameraKey& k) { return k.exposure; });
  const auto sun = [&](int part) {
    return value_at(path, t, [part](const CameraKey& k) {
      return k.sun ? std::optional<double>((*k.sun)[part]) : std::nullopt;
    });
  };
  if (const auto elevation = sun(0)) view.sun = DVec2(*elevation, *sun(1));
  return view;
}

std::string key_toml(const CameraKey& key) {
  std::string text =
      fmt::format("[[key]]\ntime = {}\nposition = {}\n", key.time, list_toml(key.position));
  if (key.target) text += fmt::format("target = {}\n", list_toml(*key.target));
  if (key.direction) text += fmt::format("look_direction = {}\n", list_toml(*key.direction));
  if (key.field_of_view) text += fmt::format("field_of_view = {:.6g}\n", *key.field_of_view);
  if (key.hour) text += fmt::format("hour = {:.6g}\n", *key.hour);
  if (key.sun) text += fmt::format("sun = [{:.6g}, {:.6g}]\n", key.sun->x, key.sun->y);
  if (key.exposure) text += fmt::format("exposure = {:.6g}\n", *key.exposure);
  return text;
}

void append_key(const std::string& file, const CameraKey& key) {
  std::string text;
  if (std::filesystem::exists(file)) text = read_file(file);
  if (!text.empty() && text.find("[[key]]") != std::string::npos) {
    CameraPath path = parse_camera_path(text, file);
    add_key(path, key, {file, 0, 0});
  }
  if (!text.empty()) text += text.ends_with('\n') ? "\n" : "\n\n";
  text += key_toml(key);
  parse_camera_path(text, file);
  write_file(file, text);
}

double next_key_time(const std::string& file, const DVec3& position) {
  if (!std::filesystem::exists(file)) return 0;
  const CameraPath path = read_camera_path(file);
  const double way = glm::length(position - path.keys.back().position);
  return path.end() + std::round(10 * std::clamp(way / 30, 2.0, 20.0)) / 10;
}

}  // namespace wold
