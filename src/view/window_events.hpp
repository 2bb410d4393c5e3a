#pragma once
// From the events of a window to the controls of a frame, without a window.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "view/controls.hpp"

namespace wold {

/// The key of the table that a key of the keyboard is, from where it is (named as on an American
/// keyboard) and what is printed on it ("" if nothing is known). Keys to fly with go by place, so
/// that W A S D lie together on every keyboard, as do digits; commands go by what is printed.
std::string key_for(std::string_view place, std::string_view label);

class WindowEvents {
 public:
  enum class Change { down, repeat, up };
  /// A key named as in the table. Keys that go down while a text is `typing` are not ours.
  void key(const std::string& key, bool ctrl, Change change, bool typing = false);
  /// A mouse button holds the view from its going down outside the interface until it is let go.
  void button(int number, bool down, bool over_interface);
  /// In parts of the window's longer side, right and down.
  void mouse_moved(Vec2 way);
  void wheel(float notches, bool over_interface);
  /// Keys and buttons are let go of: their release will not be heard.
  void focus_lost();
  /// As if it were pressed: the window's own close button is Action::quit.
  void press(Action action) { controls_.pressed.add(action); }

  bool looking() const { return !buttons_.empty(); }
  /// What happened since the last call.
  Controls take(double seconds);

 private:
  Controls controls_;
  std::vector<std::pair<std::string, Action>> down_;
  std::vector<int> buttons_;
};

}  // namespace wold
