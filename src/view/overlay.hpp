#pragma once
// What lies over the picture besides the panel: the help, messages, the progress of work, the line
// of numbers at the bottom. All between Interface::begin and end.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/vec.hpp"

namespace wold {

/// Every control of the table in the middle of the window; `open` turns false when it is closed.
void draw_help(bool& open);

/// Errors stay, in red, until they are closed or solved; notices go by themselves.
class Messages {
 public:
  /// A new error about a topic ("scene", "render") takes the place of the last one about it.
  void error(std::string_view topic, std::string_view text);
  /// What the errors about this topic told of is right again.
  void solved(std::string_view topic);
  void notice(std::string_view text);
  bool has_errors() const;
  /// In the middle of what lies to the right of `left_edge`, pixels.
  void draw(double seconds, float left_edge = 0);

 private:
  struct Message {
    bool is_error = false;
    std::string topic;
    std::string text;
    double left = 0;  ///< s, of a notice
  };
  std::vector<Message> messages_;
};

/// Work under way.
struct Task {
  std::string title;   ///< "Path tracing"
  std::string detail;  ///< "12 of 64 samples, 40 s left"
  double part = -1;    ///< 0 to 1; negative: nobody knows
  bool cancel = true;  ///< has a button for it
};
/// Returns the one whose cancelling was asked for. `left_edge` as of messages.
std::optional<std::size_t> draw_tasks(std::span<const Task> tasks, float left_edge = 0);

struct StatusLine {
  double frames_per_second = 0;
  double milliseconds = 0;  ///< of drawing a frame
  std::optional<std::int64_t> triangles;
  std::optional<double> shader_scale;  ///< of the window's size, at which the shader is drawn
  DVec3 position{0};                   ///< m
  std::optional<double> height;        ///< m, above ground
  double speed = 0;                    ///< m/s, that keys would fly at
  bool walking = false;
  double sun_elevation = 0;  ///< degrees
  double sun_azimuth = 0;    ///< degrees from north by east
  std::string time;          ///< "16:30", of day
  double exposure = 0;       ///< stops
};
void draw_status(const StatusLine& status);

/// "850", "12.4 k", "3.1 M".
std::string count_text(std::int64_t count);
/// "0.5 m/s", "120 m/s", "1.2 km/s".
std::string speed_text(double speed);

}  // namespace wold
