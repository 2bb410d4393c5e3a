#include "scene/toml_values.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace wold {

namespace {

constexpr std::string_view override_prefix = "--set ";

DateTime date_time_of(const toml::date_time& t) {
  DateTime out;
  out.year = t.date.year;
  out.month = t.date.month;
  out.day = t.date.day;
  out.hour = t.time.hour;
  out.minute = t.time.minute;
  out.second = t.time.second + 1e-9 * t.time.nanosecond;
  out.offset_minutes = t.offset ? t.offset->minutes : 0;
  return out;
}

Value list_of(const toml::array& array) {
  if (!array.empty() && array.is_homogeneous(toml::node_type::string)) {
    std::vector<std::string> texts;
    for (const toml::node& item : array) texts.push_back(**item.as_string());
    return texts;
  }
  std::vector<double> numbers;
  for (const toml::node& item : array) {
    const auto number = item.value<double>();
    if (!number || !item.is_number())
      throw Error(ErrorKind::input, "a list must hold only numbers or only texts",
                  location_of(item.source()));
    numbers.push_back(*number);
  }
  return numbers;
}

Value weights_of(const toml::table& table) {
  Weights weights;
  for (const auto& [key, item] : table) {
    if (!item.is_number())
      throw Error(ErrorKind::input, fmt::format("'{}' must be a number here", key.str()),
                  location_of(item.source()));
    weights.emplace_back(std::string(key.str()), *item.value<double>());
  }
  return weights;
}

/// The element of an array of tables that a path component names.
toml::node* element(toml::array& array, const std::string& name) {
  if (!name.empty() &&
      std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; })) {
    const auto index = static_cast<std::size_t>(std::stoul(name.substr(0, 9)));
    return index < array.size() ? array.get(index) : nullptr;
  }
  for (toml::node& node : array) {
    const toml::table* table = node.as_table();
    if (table == nullptr) continue;
    for (const char* key : {"name", "op"})
      if ((*table)[key].value_or(std::string()) == name) return &node;
  }
  return nullptr;
}

std::vector<std::string> split(const std::string& path) {
  std::vector<std::string> parts(1);
  for (const char c : path) {
    if (c == '.')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

toml::table parse_assignment(const std::string& value, const std::string& source) {
  try {
    return toml::parse("value = " + value, source);
  } catch (const toml::parse_error&) {
    toml::table text = toml::parse("value = ''", source);
    *text["value"].as_string() = value;
    return text;
  }
}

}  // namespace

SourceLocation location_of(const toml::source_region& region) {
  SourceLocation where;
  if (region.path) where.file = *region.path;
  if (where.file.starts_with(override_prefix)) return where;
  where.line = static_cast<int>(region.begin.line);
  where.column = static_cast<int>(region.begin.column);
  return where;
}

SourceLocation key_location(const toml::key& key, const toml::node& node) {
  return location_of(key.source().path ? key.source() : node.source());
}

Value value_of(const toml::node& node) {
  if (const auto* v = node.as_boolean()) return v->get();
  if (const auto* v = node.as_integer()) return v->get();
  if (const auto* v = node.as_floating_point()) return v->get();
  if (const auto* v = node.as_string()) return v->get();
  if (const auto* v = node.as_date_time()) return date_time_of(v->get());
  if (const auto* v = node.as_date()) return date_time_of({v->get(), toml::time{}});
  if (const auto* v = node.as_array()) return list_of(*v);
  if (const auto* v = node.as_table()) return weights_of(*v);
  throw Error(ErrorKind::input, "a time without a date says too little here",
              location_of(node.source()));
}

void assign_all(const ParameterSet& set, void* object, const toml::table& table,
                std::span<const std::string> skip) {
  for (const auto& [key, node] : table) {
    const std::string name(key.str());
    if (std::find(skip.begin(), skip.end(), name) != skip.end()) continue;
    if (set.find(name) == nullptr) {
      // The name is wrong before its value is.
      set.assign(object, name, false, key_location(key, node));
    }
    set.assign(object, name, value_of(node), location_of(node.source()));
  }
}

toml::table parse_toml(const std::string& text, const std::string& source) {
  try {
    return toml::parse(text, source);
  } catch (const toml::parse_error& error) {
    std::string message(error.description());
    if (const auto end = message.find('\n'); end != std::string::npos) message.resize(end);
    SourceLocation where = location_of(error.source());
    where.file = source;
    throw Error(ErrorKind::input, "not valid TOML: " + message, where);
  }
}

void override_value(toml::table& root, const std::string& assignment) {
  const std::string source(std::string(override_prefix) + assignment);
  const auto equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0)
    throw Error(
        ErrorKind::usage,
        fmt::format("'--set {}' must be of the form path=value, such as --set terrain.size=8000",
                    assignment));
  const std::vector<std::string> parts = split(assignment.substr(0, equals));
  toml::table value = parse_assignment(assignment.substr(equals + 1), source);

  toml::node* at = &root;
  for (std::size_t k = 0; k + 1 < parts.size(); ++k) {
    if (auto* array = at->as_array()) {
      at = element(*array, parts[k]);
    } else if (auto* table = at->as_table()) {
      if (!table->contains(parts[k])) table->insert(parts[k], toml::table{});
      at = table->get(parts[k]);
    } else {
      at = nullptr;
    }
    if (at == nullptr)
      throw Error(ErrorKind::usage,
                  fmt::format("'{}': nothing is called '{}' there", source, parts[k]));
  }
  // `camera.look_height` means the first camera.
  if (auto* array = at->as_array(); array != nullptr && !array->empty()) at = array->get(0);
  auto* table = at->as_table();
  if (table == nullptr)
    throw Error(ErrorKind::usage,
                fmt::format("'{}': '{}' cannot be set there", source, parts.back()));
  table->insert_or_assign(parts.back(), std::move(*value["value"].node()));
}

}  // namespace wold
