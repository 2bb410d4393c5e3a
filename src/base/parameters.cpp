#include "base/parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace wold {

namespace {

std::string range_text(const Limits& limits) {
  const bool has_min = std::isfinite(limits.min);
  const bool has_max = std::isfinite(limits.max);
  if (has_min && has_max) return fmt::format("{} to {}", limits.min, limits.max);
  if (has_min) return fmt::format("{} or more", limits.min);
  if (has_max) return fmt::format("{} or less", limits.max);
  return {};
}

std::string kind_name(const Parameter& p) {
  switch (p.kind) {
    case ParameterKind::boolean: return "true or false";
    case ParameterKind::integer: return "an integer";
    case ParameterKind::number: return "a number";
    case ParameterKind::text: return "a text";
    case ParameterKind::file: return "a file name";
    case ParameterKind::choice: return fmt::format("one of {}", fmt::join(p.choices, ", "));
    case ParameterKind::numbers:
      if (p.ascending) return "two numbers [low, high]";
      return p.max_items > 0 ? fmt::format("a list of {} numbers", p.max_items)
                             : "a list of numbers";
    case ParameterKind::texts: return "a list of texts";
    case ParameterKind::date_time: return "a date and time such as 2026-06-21T18:30:00+02:00";
    case ParameterKind::weights: return "a table of names with a weight each";
  }
  return {};
}

/// The value in the kind that the parameter wants, or the value unchanged.
Value converted(const Parameter& p, const Value& value) {
  if (p.kind == ParameterKind::number)
    if (const auto* integer = std::get_if<std::int64_t>(&value))
      return static_cast<double>(*integer);
  if (p.kind == ParameterKind::integer)
    if (const auto* number = std::get_if<double>(&value))
      if (std::floor(*number) == *number && std::abs(*number) < 0x1p53)
        return static_cast<std::int64_t>(*number);
  if (p.kind == ParameterKind::date_time)
    if (const auto* text = std::get_if<std::string>(&value)) return parse_date_time(*text);
  const bool empty_list = std::holds_alternative<std::vector<double>>(value) &&
                          std::get<std::vector<double>>(value).empty();
  if (p.kind == ParameterKind::texts && empty_list) return std::vector<std::string>{};
  return value;
}

bool right_kind(const Parameter& p, const Value& value) {
  switch (p.kind) {
    case ParameterKind::boolean: return std::holds_alternative<bool>(value);
    case ParameterKind::integer: return std::holds_alternative<std::int64_t>(value);
    case ParameterKind::number: return std::holds_alternative<double>(value);
    case ParameterKind::text:
    case ParameterKind::file:
    case ParameterKind::choice: return std::holds_alternative<std::string>(value);
    case ParameterKind::numbers: return std::holds_alternative<std::vector<double>>(value);
    case ParameterKind::texts: return std::holds_alternative<std::vector<std::string>>(value);
    case ParameterKind::date_time: return std::holds_alternative<DateTime>(value);
    case ParameterKind::weights: return std::holds_alternative<Weights>(value);
  }
  return false;
}

bool in_range(const Parameter& p, double number) {
  return std::isfinite(number) && number >= p.limits.min && number <= p.limits.max;
}

bool in_range(const Parameter& p, const Value& value) {
  const auto inside = [&](double number) { return in_range(p, number); };
  switch (p.kind) {
    case ParameterKind::integer: return inside(static_cast<double>(std::get<std::int64_t>(value)));
    case ParameterKind::number: return inside(std::get<double>(value));
    case ParameterKind::numbers: {
      const auto& list = std::get<std::vector<double>>(value);
      const auto count = static_cast<int>(list.size());
      const bool right_count = p.max_items == 0 || (count >= p.min_items && count <= p.max_items);
      return right_count && std::all_of(list.begin(), list.end(), inside) &&
             (!p.ascending || list[0] <= list[1]);
    }
    case ParameterKind::weights: {
      const auto& weights = std::get<Weights>(value);
      return std::all_of(weights.begin(), weights.end(), [&](const auto& entry) {
        return inside(entry.second) && entry.second >= 0;
      });
    }
    default: return true;
  }
}

std::string allowed_suffix(const Parameter& p) {
  const std::string range = range_text(p.limits);
  std::string text = range.empty() ? "" : ", " + range;
  if (!p.limits.unit.empty()) text += (range.empty() ? ", in " : " ") + p.limits.unit;
  return text;
}

std::string default_text(const Parameter& p, const void* defaults) {
  const std::string text = to_text(p.get(defaults));
  return text == "\"\"" ? "none" : text;
}

/// A bar would end the cell.
std::string table_cell(const std::string& text) {
  std::string cell;
  for (const char c : text) cell += c == '|' ? std::string("\\|") : std::string(1, c);
  return cell;
}

}  // namespace

std::string Parameter::allowed() const {
  return kind_name(*this) + allowed_suffix(*this);
}

const Parameter* ParameterSet::find(std::string_view wanted) const {
  for (const Parameter& p : parameters)
    if (p.name == wanted) return &p;
  return nullptr;
}

std::vector<std::string> ParameterSet::names() const {
  std::vector<std::string> list;
  for (const Parameter& p : parameters) list.push_back(p.name);
  return list;
}

void ParameterSet::assign(void* object, std::string_view wanted, const Value& given,
                          const SourceLocation& where) const {
  const Parameter* p = find(wanted);
  if (p == nullptr)
    throw Error(
        ErrorKind::input,
        fmt::format("unknown parameter '{}' in '{}'.{}", wanted, name, suggestion(wanted, names())),
        where);
  Value value;
  try {
    value = converted(*p, given);
  } catch (const Error& error) {
    throw error.at(where);
  }
  if (!right_kind(*p, value))
    throw Error(ErrorKind::input,
                fmt::format("'{}' in '{}' is {} ({}), but must be {}", p->name, name,
                            kind_text(given), to_text(given), p->allowed()),
                where);
  if (p->kind == ParameterKind::choice) {
    const auto& chosen = std::get<std::string>(value);
    if (std::find(p->choices.begin(), p->choices.end(), chosen) == p->choices.end())
      throw Error(ErrorKind::input,
                  fmt::format("'{}' in '{}' is '{}', but must be {}.{}", p->name, name, chosen,
                              p->allowed(), suggestion(chosen, p->choices)),
                  where);
  }
  if (!in_range(*p, value))
    throw Error(ErrorKind::input,
                fmt::format("'{}' in '{}' is {}, but must be {}", p->name, name, to_text(given),
                            p->allowed()),
                where);
  p->set(object, value);
}

void ParameterSet::check(const void* object) const {
  for (const Parameter& p : parameters) {
    const Value value = p.get(object);
    if (!in_range(p, value))
      throw Error(ErrorKind::input, fmt::format("'{}' in '{}' is {}, but must be {}", p.name, name,
                                                to_text(value), p.allowed()));
  }
}

std::string help_text(const ParameterSet& set, const void* defaults) {
  std::string text = fmt::format("{}: {}\n", set.name, set.text);
  std::size_t widest = 0;
  for (const Parameter& p : set.parameters) widest = std::max(widest, p.name.size());
  for (const Parameter& p : set.parameters) {
    text += fmt::format("  {:<{}}  {}\n", p.name, widest, p.text);
    text += fmt::format("  {:<{}}    {}; default {}\n", "", widest, p.allowed(),
                        default_text(p, defaults));
  }
  return text;
}

std::string reference_markdown(const ParameterSet& set, const void* defaults) {
  std::string text = fmt::format("# {}\n\n{}\n", set.name, set.text);
  if (set.parameters.empty()) return text;
  text += "\n| parameter | default | allowed | what it does |\n|---|---|---|---|\n";
  for (const Parameter& p : set.parameters)
    text += fmt::format("| `{}` | `{}` | {} | {} |\n", p.name, default_text(p, defaults),
                        p.allowed(), table_cell(p.text));
  return text;
}

}  // namespace wold
