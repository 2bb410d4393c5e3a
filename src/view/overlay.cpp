#include "view/overlay.hpp"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "view/controls.hpp"
#include "view/interface.hpp"

namespace wold {

namespace {

constexpr double notice_seconds = 5;
constexpr double fading_seconds = 0.6;
constexpr ImGuiWindowFlags plain = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                   ImGuiWindowFlags_NoSavedSettings |
                                   ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;

ImVec4 color(const Vec4& c, float alpha = 1) {
  return {c.x, c.y, c.z, c.w * alpha};
}
ImVec2 screen() {
  return ImGui::GetIO().DisplaySize;
}
float em() {
  return ImGui::GetFontSize();
}

/// Of what the panel leaves of the width; of a narrow window, of all of it.
float middle(float left_edge) {
  return left_edge < 0.7F * screen().x ? (left_edge + screen().x) / 2 : screen().x / 2;
}
float room(float left_edge) {
  return 2 * (screen().x - middle(left_edge) - em());
}

void text(std::string_view words) {
  ImGui::TextUnformatted(words.data(), words.data() + words.size());
}
void quiet_text(std::string_view words) {
  ImGui::PushStyleColor(ImGuiCol_Text, color(palette::quiet));
  text(words);
  ImGui::PopStyleColor();
}

/// A key as it looks on a keyboard.
void key_cap(std::string_view name) {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const ImVec2 size = ImGui::CalcTextSize(name.data(), name.data() + name.size());
  const float side = 0.36F * em();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 end{at.x + std::max(size.x + 2 * side, 1.55F * em()), at.y + size.y + 0.16F * em()};
  draw->AddRectFilled(at, end, ImGui::GetColorU32(ImGuiCol_FrameBgActive), 0.25F * em());
  draw->AddLine({at.x + 2, end.y - 1}, {end.x - 2, end.y - 1},
                ImGui::GetColorU32(ImGuiCol_ScrollbarGrabActive));
  draw->AddText({(at.x + end.x - size.x) / 2, at.y + 0.06F * em()},
                ImGui::GetColorU32(ImGuiCol_Text), name.data(), name.data() + name.size());
  ImGui::Dummy({end.x - at.x, end.y - at.y});
}

void key_caps(const Control& control) {
  std::string words = keys_text(control);
  bool first = true;
  while (!words.empty()) {
    std::size_t end = words.size();
    std::size_t skip = 0;
    std::string_view joint;
    for (const std::string_view between : {" or ", " to ", " and "})
      if (const std::size_t at = words.find(between); at < end) {
        end = at;
        skip = between.size();
        joint = between;
      }
    if (!first) ImGui::SameLine(0, 0.25F * em());
    key_cap(std::string_view(words).substr(0, end));
    if (joint == " to " || joint == " and ") {
      ImGui::SameLine(0, 0.25F * em());
      quiet_text(joint == " to " ? "–" : "+");
    }
    words.erase(0, end + skip);
    first = false;
  }
}

void help_group(ControlGroup group) {
  ImGui::PushStyleColor(ImGuiCol_Text, color(palette::accent));
  text(group_title(group));
  ImGui::PopStyleColor();
  ImGui::Separator();
  if (!ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) return;
  ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthFixed, 8.4F * em());
  ImGui::TableSetupColumn("text", ImGuiTableColumnFlags_WidthStretch);
  for (const Control& control : all_controls()) {
    if (control.group != group || control.text.empty()) continue;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    key_caps(control);
    ImGui::TableNextColumn();
    ImGui::PushTextWrapPos(0);
    text(control.text);
    ImGui::PopTextWrapPos();
  }
  ImGui::EndTable();
  ImGui::Dummy({0, 0.4F * em()});
}

void help_column(std::initializer_list<ControlGroup> groups) {
  ImGui::TableNextColumn();
  for (const ControlGroup group : groups) {
    ImGui::PushID(static_cast<int>(group));
    help_group(group);
    ImGui::PopID();
  }
}

}  // namespace

void draw_help(bool& open) {
  if (!open) return;
  const ImVec2 size{std::min(60 * em(), screen().x - 2 * em()),
                    std::min(42 * em(), screen().y - 2 * em())};
  ImGui::SetNextWindowPos({screen().x / 2, screen().y / 2}, ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::SetNextWindowSize({std::max(size.x, 1.0F), 0});
  ImGui::SetNextWindowSizeConstraints({1, 1}, {std::max(size.x, 1.0F), std::max(size.y, 1.0F)});
  constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                     ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings;
  if (ImGui::Begin("Controls", &open, flags)) {
    const bool wide = size.x > 40 * em();
    if (ImGui::BeginTable("columns", wide ? 2 : 1)) {
      help_column({ControlGroup::flying});
      if (!wide) ImGui::TableNextRow();
      help_column({ControlGroup::light, ControlGroup::pictures, ControlGroup::window});
      ImGui::EndTable();
    }
  }
  ImGui::End();
}

void Messages::error(std::string_view topic, std::string_view words) {
  solved(topic);
  messages_.push_back({true, std::string(topic), std::string(words), 0});
}

void Messages::solved(std::string_view topic) {
  std::erase_if(messages_, [&](const Message& m) { return m.is_error && m.topic == topic; });
}

void Messages::notice(std::string_view words) {
  messages_.push_back({false, "", std::string(words), notice_seconds});
}

bool Messages::has_errors() const {
  return std::any_of(messages_.begin(), messages_.end(),
                     [](const Message& m) { return m.is_error; });
}

void Messages::draw(double seconds, float left_edge) {
  for (Message& m : messages_)
    if (!m.is_error) m.left -= seconds;
  std::erase_if(messages_, [](const Message& m) { return !m.is_error && m.left <= 0; });

  float top = 0.7F * em();
  std::optional<std::size_t> closed;
  for (std::size_t k = 0; k < messages_.size(); ++k) {
    const Message& m = messages_[k];
    const auto alpha =
        m.is_error ? 1.0F : static_cast<float>(std::min(1.0, m.left / fading_seconds));
    const float widest = std::max(std::min(50 * em(), room(left_edge)), 1.0F);
    ImGui::SetNextWindowPos({middle(left_edge), top}, ImGuiCond_Always, {0.5F, 0});
    ImGui::SetNextWindowSizeConstraints({0, 0}, {widest, 1e6F});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, color(m.is_error ? palette::error : palette::panel));
    ImGui::PushStyleVar(ImGuiStyleVar_Alpha, alpha);
    if (ImGui::Begin(fmt::format("##message{}", k).c_str(), nullptr,
                     plain | ImGuiWindowFlags_AlwaysAutoResize)) {
      ImGui::PushTextWrapPos(widest - 4 * em());
      text(m.text);
      ImGui::PopTextWrapPos();
      if (m.is_error) {
        ImGui::SameLine(0, em());
        if (ImGui::SmallButton("✕")) closed = k;
      }
      top += ImGui::GetWindowHeight() + 0.4F * em();
    }
    ImGui::End();
    ImGui::PopStyleVar();
    ImGui::PopStyleColor();
  }
  if (closed) messages_.erase(messages_.begin() + static_cast<std::ptrdiff_t>(*closed));
}

std::optional<std::size_t> draw_tasks(std::span<const Task> tasks, float left_edge) {
  std::optional<std::size_t> cancelled;
  if (tasks.empty()) return cancelled;
  ImGui::SetNextWindowPos({middle(left_edge), screen().y - 2.6F * em()}, ImGuiCond_Always,
                          {0.5F, 1});
  ImGui::SetNextWindowSize({std::max(std::min(30 * em(), room(left_edge)), 1.0F), 0});
  if (ImGui::Begin("##tasks", nullptr, plain | ImGuiWindowFlags_AlwaysAutoResize)) {
    for (std::size_t k = 0; k < tasks.size(); ++k) {
      const Task& task = tasks[k];
      ImGui::PushID(static_cast<int>(k));
      text(task.title);
      ImGui::SameLine(0, 0.7F * em());
      quiet_text(task.detail);
      // Of work whose length nobody knows, the bar runs to and fro.
      const double shown = task.part >= 0 ? task.part : 0.5 + 0.5 * std::sin(2 * ImGui::GetTime());
      const float button = task.cancel ? 5 * em() : 0;
      const std::string percent =
          task.part >= 0 ? fmt::format("{:.0f} %", 100 * std::min(task.part, 1.0)) : "";
      ImGui::ProgressBar(static_cast<float>(std::clamp(shown, 0.0, 1.0)),
                         {ImGui::GetContentRegionAvail().x - button, 0.45F * em()}, "");
      if (task.cancel) {
        ImGui::SameLine();
        ImGui::SetCursorPosY(ImGui::GetCursorPosY() - 0.35F * em());
        quiet_text(percent);
        ImGui::SameLine(ImGui::GetWindowWidth() - 2.4F * em());
        if (ImGui::SmallButton("✕")) cancelled = k;
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("Cancel");
      }
      ImGui::PopID();
    }
  }
  ImGui::End();
  return cancelled;
}

std::string count_text(std::int64_t count) {
  const auto number = static_cast<double>(count);
  if (count < 1000) return fmt::format("{}", count);
  if (count < 1000000) return fmt::format("{:.3g} k", number / 1e3);
  if (count < 1000000000) return fmt::format("{:.3g} M", number / 1e6);
  return fmt::format("{:.3g} G", number / 1e9);
}

std::string speed_text(double speed) {
  if (speed < 10) return fmt::format("{:.1f} m/s", speed);
  if (speed < 1000) return fmt::format("{:.0f} m/s", speed);
  return fmt::format("{:.1f} km/s", speed / 1000);
}

void draw_status(const StatusLine& status) {
  const float height = 1.9F * em();
  ImGui::SetNextWindowPos({0, screen().y}, ImGuiCond_Always, {0, 1});
  ImGui::SetNextWindowSize({screen().x, height});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.8F * em(), 0.35F * em()});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  if (ImGui::Begin("##status", nullptr, plain | ImGuiWindowFlags_NoInputs)) {
    const auto item = [&](const char* name, const std::string& value) {
      quiet_text(name);
      ImGui::SameLine(0, 0.4F * em());
      text(value);
      ImGui::SameLine(0, 1.5F * em());
    };
    item("fps", fmt::format("{:.0f}", status.frames_per_second));
    item("ms", fmt::format("{:.1f}", status.milliseconds));
    if (status.triangles) item("triangles", count_text(*status.triangles));
    if (status.shader_scale) item("shader at", fmt::format("{:.0f} %", 100 * *status.shader_scale));
    const DVec3& p = status.position;
    item("at", fmt::format("{:.0f}, {:.0f}, {:.0f} m", p.x, p.y, p.z));
    if (status.height) item("above ground", fmt::format("{:.3g} m", *status.height));
    item(status.walking ? "walking" : "flying", speed_text(status.speed));
    item("sun", fmt::format("{:.1f}° up, {:.0f}°{}{}", status.sun_elevation, status.sun_azimuth,
                            status.time.empty() ? "" : ", ", status.time));
    item("exposure", fmt::format("{:+.2f}", status.exposure));
    const auto key = [](Action action) {
      const std::string_view keys = control_of(action).keys;
      return keys.substr(0, keys.find(' '));
    };
    const std::string hint =
        fmt::format("{}  help     {}  panel", key(Action::help), key(Action::panel));
    const float width = ImGui::CalcTextSize(hint.c_str()).x;
    const float at = screen().x - width - 0.8F * em();
    if (at > ImGui::GetCursorPosX()) {
      ImGui::SetCursorPosX(at);
      quiet_text(hint);
    }
  }
  ImGui::End();
  ImGui::PopStyleVar(4);
}

}  // namespace wold
