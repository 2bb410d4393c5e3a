#pragma once
// A camera's way through a scene, from a file of keys:
//
//   [[key]]
//   time = 0
//   position = [0, -300, 120]
//   target = [0, 0, 60]
//   [[key]]
//   time = 8
//   position = [400, 0, 160]
//   look_direction = [-1, 0, -0.2]
//   field_of_view = 40
//   hour = 18.5
//
// Positions lie on a centripetal Catmull-Rom spline through the keys, which makes no loops or cusps
// of its own (Yuksel, Schaefer and Keyser 2011): with knots u_i of distance |p_(i+1) - p_i|^(1/2).
// How far along it the camera is, u(t), is a monotone cubic through (t_i, u_i) (Fritsch and Carlson
// 1980): it never runs backward, and stands still between equal keys. Directions lie on the same
// kind of curve over the sphere, of arcs instead of lines (Barry and Goldman 1988 with spherical
// interpolation), by time; if all keys have a target, the place looked at moves on a spline like
// the position's. What only some keys give (view, sun, exposure) runs monotonically between those.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/parameters.hpp"
#include "render/camera.hpp"

namespace wold {

struct CameraKey {
  double time = 0;                      ///< s
  DVec3 position{0};                    ///< m
  std::optional<DVec3> target;          ///< m
  std::optional<DVec3> direction;       ///< unit length; exactly one of the two
  std::optional<double> field_of_view;  ///< degrees
  std::optional<double> hour;           ///< of the day
  std::optional<DVec2> sun;             ///< elevation and azimuth, degrees
  std::optional<double> exposure;       ///< stops

  friend bool operator==(const CameraKey&, const CameraKey&) = default;
};

/// What a key is in a file, as a section of a Markdown page.
std::string camera_key_reference();

struct CameraPath {
  std::vector<CameraKey> keys;  ///< by time, at least one

  double begin() const { return keys.front().time; }
  double end() const { return keys.back().time; }
};

/// Throws Error(input) with line and column.
CameraPath parse_camera_path(const std::string& text, const std::string& source);
/// Throws Error(io) as well.
CameraPath read_camera_path(const std::string& file);

struct PathView {
  Camera camera;
  std::optional<double> hour;
  std::optional<DVec2> sun;
  std::optional<double> exposure;
};

/// Before the first and after the last key it stays there.
PathView camera_at(const CameraPath& path, double time);

/// The key as it stands in a file.
std::string key_toml(const CameraKey& key);

/// Adds a key to a file, or begins one, whatever else stands in it; whole or not at all. Throws
/// Error(input) if the file is no camera path or its last key is not before this one, Error(io).
void append_key(const std::string& file, const CameraKey& key);

/// A time for a next key there: the last one's and as long as 30 m/s take, 2 s to 20 s; 0 for the
/// first. A missing file has no keys.
double next_key_time(const std::string& file, const DVec3& position);

}  // namespace wold
