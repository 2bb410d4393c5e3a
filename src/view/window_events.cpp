#include "view/window_events.hpp"

#include <algorithm>

namespace wold {

namespace {

bool goes_by_place(std::string_view key) {
  if (key.size() == 1 && key[0] >= '0' && key[0] <= '9') return true;
  const Action action = action_of(key, false);
  return action >= Action::forward && action <= Action::down;
}

bool is_key(std::string_view name) {
  return std::find(key_names().begin(), key_names().end(), name) != key_names().end();
}

}  // namespace

std::string key_for(std::string_view place, std::string_view label) {
  if (goes_by_place(place) || !is_key(label) || goes_by_place(label)) return std::string(place);
  return std::string(label);
}

void WindowEvents::key(const std::string& key, bool ctrl, Change change, bool typing) {
  if (change == Change::up) {
    std::erase_if(down_, [&](const auto& d) { return d.first == key; });
    return;
  }
  const Action action = action_of(key, ctrl);
  if (typing || action == Action::none) return;
  if (change == Change::repeat && !control_of(action).repeats) return;
  controls_.pressed.add(action);
  if (change == Change::down) down_.emplace_back(key, action);
}

void WindowEvents::button(int number, bool down, bool over_interface) {
  std::erase(buttons_, number);
  if (down && !over_interface) buttons_.push_back(number);
}

void WindowEvents::mouse_moved(Vec2 way) {
  if (looking()) controls_.look += way;
}

void WindowEvents::wheel(float notches, bool over_interface) {
  if (!over_interface) controls_.wheel += notches;
}

void WindowEvents::focus_lost() {
  down_.clear();
  buttons_.clear();
}

Controls WindowEvents::take(double seconds) {
  Controls taken = controls_;
  taken.seconds = seconds;
  for (const auto& [key, action] : down_) taken.held.add(action);
  controls_ = {};
  return taken;
}

}  // namespace wold
