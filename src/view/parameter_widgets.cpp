#include "view/parameter_widgets.hpp"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

#include "base/error.hpp"
#include "base/hash.hpp"
#include "image/color.hpp"
#include "view/slider_range.hpp"

namespace wold {

namespace {

using Edited = std::optional<Value>;

ImGuiSliderFlags flags_of(const SliderRange& range) {
  return range.logarithmic ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None;
}

/// "%.4g m", with what printf would take for its own doubled.
std::string number_format(const char* number, const std::string& unit) {
  std::string format = number;
  if (unit == "degrees") return format + "°";
  if (!unit.empty()) format += ' ';
  for (const char c : unit) format += c == '%' ? "%%" : std::string(1, c);
  return format;
}

/// Whole numbers where there are thousands, else four digits.
const char* digits_for(double value) {
  return std::abs(value) >= 1000 && std::abs(value) < 1e7 ? "%.0f" : "%.4g";
}

double held(const Limits& limits, double x) {
  return std::clamp(x, limits.min, limits.max);
}

Edited edit_number(const Parameter& p, double value, double usual) {
  const SliderRange range = slider_range(p.limits, usual, value);
  double edited = value;
  if (!ImGui::SliderScalar("##value", ImGuiDataType_Double, &edited, &range.low, &range.high,
                           number_format(digits_for(value), p.limits.unit).c_str(),
                           flags_of(range)))
    return {};
  return held(p.limits, edited);
}

/// Seeds and the like are typed or thrown, not slid.
bool any_number(const Parameter& p) {
  return p.name.find("seed") != std::string::npos;
}

Edited edit_integer(const Parameter& p, std::int64_t value, std::int64_t usual) {
  std::int64_t edited = value;
  bool changed = false;
  if (any_number(p)) {
    const float side = ImGui::GetFrameHeight();
    ImGui::SetNextItemWidth(ImGui::CalcItemWidth() - side - ImGui::GetStyle().ItemInnerSpacing.x);
    changed = ImGui::InputScalar("##value", ImGuiDataType_S64, &edited);
    ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
    if (ImGui::Button("⚄", {side, side})) {
      edited = static_cast<std::int64_t>(hash_text(std::to_string(value)) % 1000000);
      changed = true;
    }
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Another one");
  } else {
    const SliderRange range =
        slider_range(p.limits, static_cast<double>(usual), static_cast<double>(value));
    const auto low = static_cast<std::int64_t>(std::ceil(range.low));
    const auto high = static_cast<std::int64_t>(std::floor(range.high));
    changed = ImGui::SliderScalar("##value", ImGuiDataType_S64, &edited, &low, &high,
                                  number_format("%lld", p.limits.unit).c_str(), flags_of(range));
  }
  if (!changed) return {};
  return static_cast<std::int64_t>(held(p.limits, static_cast<double>(edited)));
}

/// A text that counts when Enter is pressed or the field is left. Dear ImGui keeps what is being
/// typed; the last of it is kept here, as leaving a field does not hand it over.
std::optional<std::string> edit_text(const std::string& value, const char* hint) {
  static ImGuiID typing = 0;
  static std::string typed;
  const ImGuiID id = ImGui::GetID("##value");
  std::string text = id == typing ? typed : value;
  const bool entered =
      ImGui::InputTextWithHint("##value", hint, &text, ImGuiInputTextFlags_EnterReturnsTrue);
  if (ImGui::IsItemActive()) {
    typing = id;
    typed = text;
  }
  const bool left = ImGui::IsItemDeactivatedAfterEdit();
  if (!ImGui::IsItemActive() && id == typing) typing = 0;
  if ((entered || left) && text != value) return text;
  return {};
}

Edited edit_color(const std::vector<double>& value) {
  std::array<float, 3> shown{};
  for (std::size_t k = 0; k < 3; ++k) shown[k] = linear_to_srgb(static_cast<float>(value[k]));
  if (!ImGui::ColorEdit3("##value", shown.data(), ImGuiColorEditFlags_DisplayHSV)) return {};
  std::vector<double> edited;
  for (const float c : shown) edited.push_back(static_cast<double>(srgb_to_linear(c)));
  return edited;
}

Edited edit_numbers(const Parameter& p, const std::vector<double>& value, const Value& usual) {
  if (value.size() == 3 && p.name.find("color") != std::string::npos) return edit_color(value);
  if (p.max_items == 0 || value.empty() || value.size() > 4) {
    const auto text = edit_text(list_text(value), "automatic");
    if (text) return parse_list(*text);
    return {};
  }
  SliderRange range{value[0], value[0], true};
  const auto& usuals = std::get<std::vector<double>>(usual);
  for (std::size_t k = 0; k < value.size(); ++k) {
    const double ordinary = k < usuals.size() ? usuals[k] : value[k];
    const SliderRange one = slider_range(p.limits, ordinary, value[k]);
    range.low = std::min(range.low, one.low);
    range.high = std::max(range.high, one.high);
    range.logarithmic = range.logarithmic && one.logarithmic;
  }
  std::vector<double> edited = value;
  if (!ImGui::SliderScalarN("##value", ImGuiDataType_Double, edited.data(),
                            static_cast<int>(edited.size()), &range.low, &range.high,
                            digits_for(range.high), flags_of(range)))
    return {};
  for (double& x : edited) x = held(p.limits, x);
  if (p.ascending && edited[0] > edited[1]) {
    // The end that was moved pushes the other one along.
    if (edited[0] != value[0])
      edited[1] = edited[0];
    else
      edited[0] = edited[1];
  }
  return edited;
}

Edited edit_choice(const Parameter& p, const std::string& value) {
  Edited edited;
  if (!ImGui::BeginCombo("##value", value.c_str())) return edited;
  for (const std::string& choice : p.choices) {
    if (ImGui::Selectable(choice.c_str(), choice == value)) edited = choice;
    if (choice == value) ImGui::SetItemDefaultFocus();
  }
  ImGui::EndCombo();
  return edited;
}

Edited edit_date_time(const DateTime& value) {
  DateTime edited = value;
  double hour = hour_of(value);
  const double midnight = 0;
  const double last = 24 - 1.0 / 60;
  const int minutes = static_cast<int>(hour * 60 + 1e-6);
  const std::string clock = fmt::format("{:02}:{:02}", minutes / 60, minutes % 60);
  const float width = ImGui::CalcItemWidth();
  bool changed =
      ImGui::SliderScalar("##hour", ImGuiDataType_Double, &hour, &midnight, &last, clock.c_str());
  if (changed) edited = with_hour(value, hour);
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  const auto field = [&](const char* id, int& number, int low, int high, const char* format,
                         bool same_line) {
    if (same_line) ImGui::SameLine(0, gap);
    ImGui::SetNextItemWidth((width - 2 * gap) / 3);
    changed |= ImGui::DragInt(id, &number, 0.08F, low, high, format, ImGuiSliderFlags_AlwaysClamp);
  };
  constexpr std::array months{"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                              "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
  field("##day", edited.day, 1, 31, "%d.", false);
  field("##month", edited.month, 1, 12,
        months[static_cast<std::size_t>(std::clamp(edited.month, 1, 12) - 1)], true);
  field("##year", edited.year, 1, 9999, "%d", true);
  if (!changed) return {};
  // 31 April is 30 April.
  for (; edited.day > 28; --edited.day) {
    try {
      parse_date_time(to_text(edited));
      break;
    } catch (const Error&) {
    }
  }
  return edited;
}

Edited edit_weights(const Weights& value) {
  Weights edited = value;
  bool changed = false;
  if (value.empty()) ImGui::TextDisabled("none");
  for (auto& [name, weight] : edited) {
    const SliderRange range = slider_range({.unit = {}, .min = 0}, std::max(weight, 1.0), weight);
    ImGui::PushID(name.c_str());
    const float width = ImGui::CalcItemWidth();
    ImGui::SetNextItemWidth(0.55F * width);
    changed |= ImGui::SliderScalar("##value", ImGuiDataType_Double, &weight, &range.low,
                                   &range.high, "%.3g");
    weight = std::max(weight, 0.0);
    ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
    ImGui::TextDisabled("%s", name.c_str());
    ImGui::PopID();
  }
  if (!changed) return {};
  return edited;
}

Edited edit_texts(const std::vector<std::string>& value) {
  std::string joined = fmt::format("{}", fmt::join(value, ", "));
  const auto text = edit_text(joined, "none");
  if (!text) return {};
  std::vector<std::string> list;
  std::string word;
  for (const char c : *text + ",") {
    if (c != ',') {
      if (c != ' ' || !word.empty()) word += c;
    } else if (!word.empty()) {
      list.push_back(std::move(word));
      word.clear();
    }
  }
  return list;
}

}  // namespace

Edited edit_parameter(const Parameter& p, const Value& value, const Value& usual) {
  switch (p.kind) {
    case ParameterKind::boolean: {
      bool on = std::get<bool>(value);
      if (ImGui::Checkbox("##value", &on)) return on;
      return {};
    }
    case ParameterKind::integer:
      return edit_integer(p, std::get<std::int64_t>(value), std::get<std::int64_t>(usual));
    case ParameterKind::number:
      return edit_number(p, std::get<double>(value), std::get<double>(usual));
    case ParameterKind::text:
    case ParameterKind::file: {
      const auto text = edit_text(std::get<std::string>(value), "none");
      if (text) return *text;
      return {};
    }
    case ParameterKind::choice: return edit_choice(p, std::get<std::string>(value));
    case ParameterKind::numbers:
      return edit_numbers(p, std::get<std::vector<double>>(value), usual);
    case ParameterKind::texts: return edit_texts(std::get<std::vector<std::string>>(value));
    case ParameterKind::date_time: return edit_date_time(std::get<DateTime>(value));
    case ParameterKind::weights: return edit_weights(std::get<Weights>(value));
  }
  return {};
}

std::string title_of(std::string_view name) {
  std::string title;
  for (const char c : name) {
    const bool digit = c >= '0' && c <= '9';
    if (digit && !title.empty() && std::isalpha(static_cast<unsigned char>(title.back())))
      title += ' ';
    title += c == '_' ? ' ' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  if (!title.empty())
    title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
  return title;
}

std::string list_text(const std::vector<double>& numbers) {
  std::string text;
  for (const double x : numbers) text += fmt::format("{}{}", text.empty() ? "" : ", ", x);
  return text;
}

std::vector<double> parse_list(std::string_view text) {
  std::vector<double> numbers;
  const auto is_gap = [](char c) { return c == ' ' || c == ',' || c == '[' || c == ']'; };
  while (!text.empty()) {
    if (is_gap(text.front())) {
      text.remove_prefix(1);
      continue;
    }
    const auto end = std::find_if(text.begin(), text.end(), is_gap);
    const std::string_view word = text.substr(0, static_cast<std::size_t>(end - text.begin()));
    double number = 0;
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc() || stop != word.data() + word.size())
      throw Error(ErrorKind::input,
                  fmt::format("'{}' is not a number; lists are typed as 10, 20", word));
    numbers.push_back(number);
    text.remove_prefix(word.size());
  }
  return numbers;
}

double hour_of(const DateTime& time) {
  return time.hour + time.minute / 60.0 + time.second / 3600;
}

DateTime with_hour(DateTime time, double hour) {
  const double clamped = std::clamp(hour, 0.0, 24 - 1.0 / 3600);
  const auto seconds = static_cast<int>(std::lround(std::min(clamped * 3600, 86399.0)));
  time.hour = seconds / 3600;
  time.minute = seconds / 60 % 60;
  time.second = seconds % 60;
  return time;
}

}  // namespace wold
