#include "view/recording.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <cmath>

#include "base/error.hpp"
#include "image/atomic_file.hpp"

namespace wold {

namespace {

constexpr std::string_view heading = "wold recording 1";

std::string names_text(const ActionSet& actions) {
  std::string text;
  for (const Control& control : all_controls())
    if (control.action != Action::none && actions.has(control.action))
      text += fmt::format("{}{}", text.empty() ? "" : ",", control.name);
  return text;
}

/// Takes what stands before `end` off the front of `text`.
std::string_view taken(std::string_view& text, char end) {
  const std::size_t length = std::min(text.find(end), text.size());
  const std::string_view part = text.substr(0, length);
  text.remove_prefix(std::min(length + 1, text.size()));
  return part;
}

template <class Real>
Real number_of(std::string_view text) {
  Real number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(number))
    throw Error(ErrorKind::input, fmt::format("'{}' is not a number", text));
  return number;
}

ActionSet actions_of(std::string_view text) {
  ActionSet actions;
  while (!text.empty()) actions.add(parse_action(taken(text, ',')));
  return actions;
}

void assign(Controls& controls, std::string_view key, std::string_view value) {
  if (key == "look") {
    controls.look.x = number_of<float>(taken(value, ','));
    controls.look.y = number_of<float>(value);
  } else if (key == "wheel") {
    controls.wheel = number_of<float>(value);
  } else if (key == "held") {
    controls.held = actions_of(value);
  } else if (key == "pressed") {
    controls.pressed = actions_of(value);
  } else {
    const std::vector<std::string> known{"look", "wheel", "held", "pressed"};
    throw Error(ErrorKind::input, fmt::format("unknown '{}'.{}", key, suggestion(key, known)));
  }
}

Controls controls_of(std::string_view line) {
  Controls controls;
  controls.seconds = number_of<double>(taken(line, ' '));
  if (controls.seconds < 0)
    throw Error(ErrorKind::input, "a frame begins with its seconds, 0 or more");
  while (!line.empty()) {
    std::string_view item = taken(line, ' ');
    if (item.empty()) continue;
    const std::string_view key = taken(item, '=');
    assign(controls, key, item);
  }
  return controls;
}

}  // namespace

std::string recording_line(const Controls& controls) {
  std::string line = fmt::format("{}", controls.seconds);
  if (controls.look != Vec2(0))
    line += fmt::format(" look={},{}", controls.look.x, controls.look.y);
  if (controls.wheel != 0) line += fmt::format(" wheel={}", controls.wheel);
  if (!controls.held.empty()) line += " held=" + names_text(controls.held);
  if (!controls.pressed.empty()) line += " pressed=" + names_text(controls.pressed);
  return line + "\n";
}

std::vector<Controls> parse_recording(std::string_view text, const std::string& source) {
  std::vector<Controls> frames;
  for (int line = 1; !text.empty() || line == 1; ++line) {
    std::string_view content = taken(text, '\n');
    if (content.ends_with('\r')) content.remove_suffix(1);
    const SourceLocation where{source, line, 0};
    if (line == 1) {
      if (content != heading)
        throw Error(ErrorKind::input,
                    fmt::format("this is no recording: the first line must be '{}'", heading),
                    where);
      continue;
    }
    if (content.empty()) continue;
    try {
      frames.push_back(controls_of(content));
    } catch (const Error& error) {
      throw error.at(where);
    }
  }
  return frames;
}

std::vector<Controls> read_recording(const std::string& file) {
  return parse_recording(read_file(file), file);
}

Recorder::Recorder(const std::string& file) : name_(file), file_(std::fopen(file.c_str(), "w")) {
  if (!file_)
    throw Error(ErrorKind::io, fmt::format("'{}' cannot be written: {}", file, io_reason(errno)));
  fmt::print(file_.get(), "{}\n", heading);
}

void Recorder::add(const Controls& controls) {
  const std::string line = recording_line(controls);
  if (std::fwrite(line.data(), 1, line.size(), file_.get()) != line.size() ||
      std::fflush(file_.get()) != 0)
    throw Error(ErrorKind::io, fmt::format("'{}' cannot be written: {}", name_, io_reason(errno)));
}

}  // namespace wold
