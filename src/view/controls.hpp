#pragma once
// What the viewer's user does in one frame, and the one table of everything that can be done: the
// handling of keys, the help in the window and the reference pages follow from it.

#include <bitset>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/vec.hpp"

namespace wold {

enum class Action {
  none,  ///< a row of the table about the mouse
  forward,
  backward,
  left,
  right,
  up,
  down,
  faster,
  slower,
  walk,
  home,
  camera_1,
  camera_2,
  camera_3,
  camera_4,
  camera_5,
  camera_6,
  camera_7,
  camera_8,
  camera_9,
  zoom,
  earlier,
  later,
  animate_sun,
  brighter,
  darker,
  path_trace,
  test_rays,
  shader,
  reload,
  copy_camera,
  add_path_key,
  screenshot,
  undo,
  redo,
  panel,
  help,
  full_screen,
  quit,
  count
};

class ActionSet {
 public:
  bool has(Action action) const { return bits_[static_cast<std::size_t>(action)]; }
  void add(Action action) { bits_.set(static_cast<std::size_t>(action)); }
  void remove(Action action) { bits_.reset(static_cast<std::size_t>(action)); }
  void clear() { bits_.reset(); }
  bool empty() const { return bits_.none(); }
  friend bool operator==(const ActionSet&, const ActionSet&) = default;

 private:
  std::bitset<static_cast<std::size_t>(Action::count)> bits_;
};

/// One frame of the user's doings.
struct Controls {
  double seconds = 0;  ///< since the frame before
  ActionSet held;      ///< down at the end of the frame
  ActionSet pressed;   ///< went down within it, or was repeated by the keyboard
  Vec2 look{0};        ///< of the mouse while a button holds the view, right and down, in parts of
                       ///< the window's longer side
  float wheel = 0;     ///< notches, away from the user positive

  friend bool operator==(const Controls&, const Controls&) = default;
};

enum class ControlGroup { flying, light, pictures, window };

/// A row of the table.
struct Control {
  Action action = Action::none;
  ControlGroup group = ControlGroup::window;
  std::string_view name;  ///< as recordings write it: "forward"
  /// Keys with a space between, the names of `key_names`; "Ctrl+Z" for one with Ctrl held. For the
  /// mouse, what the help shows.
  std::string_view keys;
  std::string_view text;  ///< what it does; empty: spoken for by another row
  bool repeats = false;   ///< a held key presses again and again
};

std::span<const Control> all_controls();
std::string_view group_title(ControlGroup group);
/// The row of an action other than `none`.
const Control& control_of(Action action);

/// All keys that may stand in the table: "A", "F5", "Escape", "Page Up".
const std::vector<std::string>& key_names();

/// What a key does, Action::none for nothing.
Action action_of(std::string_view key, bool ctrl);

/// "W or Up": the keys of a row for a reader. Digits of cameras are put together.
std::string keys_text(const Control& control);

/// Throws Error(input) with the nearest name.
Action parse_action(std::string_view name);

/// The table for a terminal, and as a section of a Markdown page.
std::string controls_help();
std::string controls_markdown();

}  // namespace wold
