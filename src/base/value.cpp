#include "base/value.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>

#include "base/error.hpp"

namespace wold {

namespace {

std::string number_text(double number) {
  std::string text = fmt::format("{}", number);
  // Parameters are mostly floats: the shortest text that reads back as the same float is meant.
  const auto single = static_cast<float>(number);
  if (static_cast<double>(single) == number) text = fmt::format("{}", single);
  return text;
}

struct ToText {
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(std::int64_t value) const { return fmt::format("{}", value); }
  std::string operator()(double value) const { return number_text(value); }
  std::string operator()(const std::string& value) const { return fmt::format("\"{}\"", value); }
  std::string operator()(const std::vector<double>& values) const {
    std::string text = "[";
    for (const double value : values) text += (text.size() > 1 ? ", " : "") + number_text(value);
    return text + "]";
  }
  std::string operator()(const DateTime& value) const { return to_text(value); }
  std::string operator()(const Weights& weights) const {
    std::string text = "{ ";
    for (const auto& [name, weight] : weights)
      text += fmt::format("{}{} = {}", text.size() > 2 ? ", " : "", name, number_text(weight));
    return text + (weights.empty() ? "}" : " }");
  }
  std::string operator()(const std::vector<std::string>& values) const {
    std::string text = "[";
    for (const std::string& value : values)
      text += fmt::format("{}\"{}\"", text.size() > 1 ? ", " : "", value);
    return text + "]";
  }
};

struct KindText {
  std::string operator()(bool) const { return "a boolean"; }
  std::string operator()(std::int64_t) const { return "an integer"; }
  std::string operator()(double) const { return "a number"; }
  std::string operator()(const std::string&) const { return "a text"; }
  std::string operator()(const std::vector<double>& values) const {
    return fmt::format("a list of {} numbers", values.size());
  }
  std::string operator()(const DateTime&) const { return "a date and time"; }
  std::string operator()(const Weights&) const { return "a table of numbers"; }
  std::string operator()(const std::vector<std::string>& values) const {
    return fmt::format("a list of {} texts", values.size());
  }
};

int days_in_month(int year, int month) {
  static constexpr int days[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  const bool leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
  return month == 2 && leap ? 29 : days[month - 1];
}

bool valid(const DateTime& time) {
  return time.month >= 1 && time.month <= 12 && time.day >= 1 &&
         time.day <= days_in_month(time.year, time.month) && time.hour >= 0 && time.hour <= 23 &&
         time.minute >= 0 && time.minute <= 59 && time.second >= 0 && time.second < 61 &&
         std::abs(time.offset_minutes) <= 14 * 60;
}

}  // namespace

std::string kind_text(const Value& value) {
  return std::visit(KindText{}, value);
}

std::string to_text(const Value& value) {
  return std::visit(ToText{}, value);
}

std::string to_text(const DateTime& time) {
  std::string text = fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}", time.year, time.month,
                                 time.day, time.hour, time.minute, static_cast<int>(time.second));
  if (time.offset_minutes == 0) return text + "Z";
  const int offset = std::abs(time.offset_minutes);
  return text + fmt::format("{}{:02}:{:02}", time.offset_minutes < 0 ? '-' : '+', offset / 60,
                            offset % 60);
}

DateTime parse_date_time(std::string_view text) {
  const std::string copy(text);
  DateTime time;
  int used = 0;
  const int fields = std::sscanf(copy.c_str(), "%4d-%2d-%2d%*1[Tt ]%2d:%2d%n", &time.year,
                                 &time.month, &time.day, &time.hour, &time.minute, &used);
  bool good = fields == 5 && used > 0;
  std::string rest = good ? copy.substr(static_cast<std::size_t>(used)) : "";
  if (good && rest.starts_with(':')) {
    good = std::sscanf(rest.c_str(), ":%lf%n", &time.second, &used) == 1;
    if (good) rest = rest.substr(static_cast<std::size_t>(used));
  }
  if (good && !rest.empty() && rest != "Z" && rest != "z") {
    int hours = 0;
    int minutes = 0;
    char sign = 0;
    good = std::sscanf(rest.c_str(), "%c%2d:%2d%n", &sign, &hours, &minutes, &used) == 3 &&
           static_cast<std::size_t>(used) == rest.size() && (sign == '+' || sign == '-');
    time.offset_minutes = (sign == '-' ? -1 : 1) * (hours * 60 + minutes);
  }
  if (!good || !valid(time))
    throw Error(ErrorKind::input,
                fmt::format("'{}' is not a date and time such as 2026-06-21T18:30:00+02:00", text));
  return time;
}

}  // namespace wold
