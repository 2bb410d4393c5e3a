#include <cmath>
#include <nlohmann/json.hpp>

#include "scene/scene.hpp"

namespace wold {

namespace {

using Json = nlohmann::ordered_json;

Json value_json(const Value& value) {
  return std::visit(
      [](const auto& v) -> Json {
        using T = std::decay_t<decltype(v)>;
        if constexpr (std::is_same_v<T, DateTime>) {
          return to_text(v);
        } else if constexpr (std::is_same_v<T, Weights>) {
          Json object = Json::object();
          for (const auto& [name, weight] : v) object[name] = weight;
          return object;
        } else {
          return v;
        }
      },
      value);
}

Json number_json(const Parameter& p, const char* type) {
  Json json{{"type", type}};
  if (std::isfinite(p.limits.min)) json["minimum"] = p.limits.min;
  if (std::isfinite(p.limits.max)) json["maximum"] = p.limits.max;
  return json;
}

Json type_json(const Parameter& p) {
  switch (p.kind) {
    case ParameterKind::boolean: return {{"type", "boolean"}};
    case ParameterKind::integer: return number_json(p, "integer");
    case ParameterKind::number: return number_json(p, "number");
    case ParameterKind::text:
    case ParameterKind::file: return {{"type", "string"}};
    case ParameterKind::choice: return {{"enum", p.choices}};
    case ParameterKind::numbers: {
      Json json{{"type", "array"}, {"items", number_json(p, "number")}};
      if (p.max_items > 0) {
        json["minItems"] = p.min_items;
        json["maxItems"] = p.max_items;
      }
      return json;
    }
    case ParameterKind::texts: return {{"type", "array"}, {"items", {{"type", "string"}}}};
    case ParameterKind::date_time: return {{"type", "string"}, {"format", "date-time"}};
    case ParameterKind::weights:
      return {{"type", "object"}, {"additionalProperties", {{"type", "number"}, {"minimum", 0}}}};
  }
  return {};
}

Json properties(const ParameterSet& set, const void* defaults) {
  Json json = Json::object();
  for (const Parameter& p : set.parameters) {
    Json entry = type_json(p);
    entry["description"] = p.limits.unit.empty() ? p.text : p.text + " (" + p.limits.unit + ")";
    entry["default"] = value_json(p.get(defaults));
    json[p.name] = std::move(entry);
  }
  return json;
}

Json object(const ParameterSet& set, const void* defaults) {
  return {{"type", "object"},
          {"description", set.text},
          {"properties", properties(set, defaults)},
          {"additionalProperties", false}};
}

/// A section that may be written once, [name], or more often, [[name]].
Json one_or_more(const Json& section) {
  return {{"anyOf", {section, {{"type", "array"}, {"items", section}}}}};
}

/// One alternative per operator, told apart by `op`.
Json step_json() {
  const StepSettings common;
  Json alternatives = Json::array();
  for (const TerrainOperator& op : scene_operators()) {
    Json step = object(op.defaults.parameters(), op.defaults.data());
    Json all{{"op", {{"const", op.name()}}}};
    all.update(properties(describe(common), &common));
    all.update(step["properties"]);
    step["properties"] = std::move(all);
    step["required"] = {"op"};
    alternatives.push_back(std::move(step));
  }
  return one_or_more({{"oneOf", std::move(alternatives)}});
}

}  // namespace

std::string scene_schema() {
  const SceneHeader header;
  Json root = object(describe(header), &header);
  for (const SceneSection& section : scene_sections()) {
    Json json = object(section.defaults.parameters(), section.defaults.data());
    if (section.path == "terrain") json["properties"]["step"] = step_json();
    root["properties"][section.path] = section.repeated ? one_or_more(json) : std::move(json);
  }
  Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "wold scene"}};
  schema.update(root);
  return schema.dump(2) + "\n";
}

}  // namespace wold
