#include "view/controls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/error.hpp"

namespace wold {

namespace {

using enum ControlGroup;

constexpr auto table = std::to_array<Control>({
    {Action::none, flying, "look", "Drag", "Look around: drag with the right or left button."},
    {Action::forward, flying, "forward", "W Up", "Fly forward, where you look."},
    {Action::backward, flying, "backward", "S Down", "Fly backward."},
    {Action::left, flying, "left", "A Left", "Fly to the left."},
    {Action::right, flying, "right", "D Right", "Fly to the right."},
    {Action::up, flying, "up", "E Page_Up", "Rise."},
    {Action::down, flying, "down", "Q Page_Down", "Sink, down to just above the ground."},
    {Action::faster, flying, "faster", "Shift", "Six times as fast while held."},
    {Action::slower, flying, "slower", "Alt", "A sixth as fast while held."},
    {Action::none, flying, "speed", "Wheel", "Change the speed, 0.5 m/s to 2 km/s."},
    {Action::zoom, flying, "zoom", "Z", "With the wheel, change the field of view."},
    {Action::walk, flying, "walk", "G", "Walk on the ground, eyes at 1.8 m, or fly again."},
    {Action::home, flying, "home", "Home", "Back to where the scene's camera stands."},
    {Action::camera_1, flying, "camera_1", "1", "Go to a camera of the scene."},
    {Action::camera_2, flying, "camera_2", "2", ""},
    {Action::camera_3, flying, "camera_3", "3", ""},
    {Action::camera_4, flying, "camera_4", "4", ""},
    {Action::camera_5, flying, "camera_5", "5", ""},
    {Action::camera_6, flying, "camera_6", "6", ""},
    {Action::camera_7, flying, "camera_7", "7", ""},
    {Action::camera_8, flying, "camera_8", "8", ""},
    {Action::camera_9, flying, "camera_9", "9", ""},
    {Action::earlier, light, "earlier", "[ ,", "Turn the time of day back while held."},
    {Action::later, light, "later", "] .", "Let the time of day run while held."},
    {Action::animate_sun, light, "animate_sun", "Space", "Let the sun move by itself, or stop it."},
    {Action::brighter, light, "brighter", "+ =", "Brighten the picture by a quarter stop.", true},
    {Action::darker, light, "darker", "-", "Darken the picture by a quarter stop.", true},
    {Action::path_trace, pictures, "path_trace", "P", "Path-trace this view, beside it."},
    {Action::test_rays, pictures, "test_rays", "L", "Show the paths of a few test rays."},
    {Action::shader, pictures, "shader", "M",
     "Show the land as its shader draws it, or the scene."},
    {Action::screenshot, pictures, "screenshot", "F12", "Write a picture of the view."},
    {Action::copy_camera, pictures, "copy_camera", "C Ctrl+C",
     "Copy the camera as TOML, to be put into the scene."},
    {Action::add_path_key, pictures, "add_path_key", "K",
     "Add the camera to the camera path, as its next key."},
    {Action::reload, pictures, "reload", "F5", "Read the scene file again."},
    {Action::undo, window, "undo", "Ctrl+Z", "Undo a change of a parameter.", true},
    {Action::redo, window, "redo", "Ctrl+Y", "Do it again.", true},
    {Action::panel, window, "panel", "Tab", "Show or hide the panel of parameters."},
    {Action::help, window, "help", "H F1", "Show or hide this help."},
    {Action::full_screen, window, "full_screen", "F11", "Full screen, or a window again."},
    {Action::quit, window, "quit", "Escape Ctrl+Q", "Close what is open, else quit."},
});

std::vector<std::string> make_key_names() {
  std::vector<std::string> names;
  for (char c = 'A'; c <= 'Z'; ++c) names.emplace_back(1, c);
  for (char c = '0'; c <= '9'; ++c) names.emplace_back(1, c);
  for (int k = 1; k <= 12; ++k) names.push_back(fmt::format("F{}", k));
  for (const char* name :
       {"Up",    "Down", "Left",  "Right",  "Page_Up", "Page_Down", "Home",   "End",
        "Shift", "Alt",  "Space", "Escape", "Tab",     "Enter",     "Delete", "[",
        "]",     ",",    ".",     "+",      "-",       "="})
    names.emplace_back(name);
  return names;
}

std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> words;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    if (end > 0) words.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return words;
}

template <class Row>
std::string by_groups(const char* heading, const Row& row) {
  std::string text;
  for (const ControlGroup group : {flying, light, pictures, window}) {
    text += fmt::format(fmt::runtime(heading), group_title(group));
    for (const Control& control : table)
      if (control.group == group && !control.text.empty()) text += row(control);
  }
  return text;
}

}  // namespace

std::span<const Control> all_controls() {
  return table;
}

std::string_view group_title(ControlGroup group) {
  switch (group) {
    case flying: return "Flying and walking";
    case light: return "Light";
    case pictures: return "Pictures and scene";
    case window: return "Window";
  }
  return {};
}

const Control& control_of(Action action) {
  const auto found = std::find_if(table.begin(), table.end(),
                                  [&](const Control& c) { return c.action == action; });
  if (action == Action::none || found == table.end())
    throw Error(ErrorKind::internal, "an action is not in the table of controls");
  return *found;
}

const std::vector<std::string>& key_names() {
  static const std::vector<std::string> names = make_key_names();
  return names;
}

Action action_of(std::string_view key, bool ctrl) {
  const std::string wanted = ctrl ? fmt::format("Ctrl+{}", key) : std::string(key);
  for (const Control& control : table) {
    if (control.action == Action::none) continue;
    for (const std::string_view name : split(control.keys))
      if (name == wanted) return control.action;
  }
  return Action::none;
}

std::string keys_text(const Control& control) {
  if (control.action == Action::camera_1) return "1 to 9";
  if (control.action == Action::zoom) return "Z and wheel";
  std::string text;
  for (const std::string_view key : split(control.keys)) {
    text += fmt::format("{}{}", text.empty() ? "" : " or ", key);
  }
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

Action parse_action(std::string_view name) {
  std::vector<std::string> names;
  for (const Control& control : table) {
    if (control.action == Action::none) continue;
    if (control.name == name) return control.action;
    names.emplace_back(control.name);
  }
  throw Error(ErrorKind::input, fmt::format("nothing that can be done is called '{}'.{}", name,
                                            suggestion(name, names)));
}

std::string controls_help() {
  return by_groups("{}:\n", [](const Control& control) {
    return fmt::format("  {:<18}{}\n", keys_text(control), control.text);
  });
}

std::string controls_markdown() {
  return by_groups("\n### {}\n\n| Keys | What they do |\n|---|---|\n", [](const Control& control) {
    return fmt::format("| {} | {} |\n", keys_text(control), control.text);
  });
}

}  // namespace wold
