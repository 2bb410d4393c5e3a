#include <fmt/format.h>

#include <algorithm>

#include "erosion/operators.hpp"
#include "image/atomic_file.hpp"
#include "scene/example.hpp"
#include "scene/scene.hpp"
#include "scene/toml_values.hpp"
#include "terrain/operators.hpp"

namespace wold {

namespace {

constexpr int format_version = 1;
const std::vector<std::string> step_key{"step"};

[[noreturn]] void unknown_section(std::string_view name, const SourceLocation& where) {
  std::vector<std::string> known{"wold", "seed"};
  for (const SceneSection& section : scene_sections()) known.push_back(section.path);
  throw Error(ErrorKind::input,
              fmt::format("unknown section or key '{}'.{}", name, suggestion(name, known)), where);
}

const toml::table& table_of(const toml::node& node, std::string_view name) {
  if (const auto* table = node.as_table()) return *table;
  throw Error(ErrorKind::input, fmt::format("'{}' must be a section, [{}]", name, name),
              location_of(node.source()));
}

template <class Visit>
void for_each_table(const toml::table& parent, const std::string& name, const Visit& visit) {
  const toml::node* node = parent.get(name);
  if (node == nullptr) return;
  if (const auto* single = node->as_table()) {
    visit(*single);
    return;
  }
  const auto* array = node->as_array();
  const bool good =
      array != nullptr && (array->empty() || array->is_homogeneous(toml::node_type::table));
  if (!good)
    throw Error(ErrorKind::input,
                fmt::format("'{}' must be a list of sections, [[{}]]", name, name),
                location_of(node->source()));
  for (const toml::node& item : *array) visit(*item.as_table());
}

using Locations = std::map<std::string, SourceLocation>;

void locate(Locations& locations, const std::string& path, const toml::table& table) {
  locations[path] = location_of(table.source());
  for (const auto& [key, node] : table)
    locations[path + "." + std::string(key.str())] = location_of(node.source());
}

template <class T>
void read_section(const toml::table& root, const char* name, T& object, Locations& locations,
                  std::span<const std::string> skip = {}) {
  const toml::node* node = root.get(name);
  if (node == nullptr) return;
  const toml::table& table = table_of(*node, name);
  assign_all(describe(object), &object, table, skip);
  locate(locations, name, table);
}

template <class T>
void read_sections(const toml::table& root, const char* name, std::vector<T>& list,
                   Locations& locations) {
  for_each_table(root, name, [&](const toml::table& table) {
    T object;
    assign_all(describe(object), &object, table);
    locate(locations, fmt::format("{}.{}", name, list.size()), table);
    list.push_back(std::move(object));
  });
}

TerrainStep read_step(const toml::table& table) {
  const toml::node* op = table.get("op");
  const SourceLocation where = location_of(table.source());
  if (op == nullptr || !op->is_string())
    throw Error(ErrorKind::input, "a [[terrain.step]] needs an operator, such as op = \"ridged\"",
                where);
  TerrainStep step =
      make_step(scene_operators(), op->as_string()->get(), location_of(op->source()));
  step.location = where;
  for (const auto& [key, node] : table)
    if (key != "op") {
      const bool known = step.parameters.parameters().find(key.str()) != nullptr ||
                         describe(step.settings).parameters().find(key.str()) != nullptr;
      assign(step, key.str(), known ? value_of(node) : Value(false),
             known ? location_of(node.source()) : key_location(key, node));
    }
  return step;
}

/// Puts the example's steps into a document that has none, and its plants into one that has neither
/// steps nor plants, so that overrides find them.
void add_defaults(toml::table& root) {
  toml::node* terrain = root.get("terrain");
  if (terrain == nullptr) terrain = &root.insert("terrain", toml::table{}).first->second;
  auto* table = terrain->as_table();
  if (table == nullptr || table->contains("step")) return;
  const toml::table example = parse_toml(example_scene, "example scene");
  table->insert("step", *example["terrain"]["step"].as_array());
  if (root.contains("species") || root.contains("scatter") || root.contains("grid")) return;
  for (const char* key : {"species", "scatter"})
    root.insert_or_assign(key, *example[key].as_array());
}

/// Every name is there, and once.
template <class T>
void check_names(const Scene& scene, const char* section, const std::vector<T>& list) {
  for (std::size_t k = 0; k < list.size(); ++k) {
    const std::string path = fmt::format("{}.{}", section, k);
    if (list[k].name.empty())
      throw Error(ErrorKind::input, fmt::format("a [[{}]] needs a name", section),
                  scene.location(path));
    for (std::size_t other = 0; other < k; ++other)
      if (list[other].name == list[k].name)
        throw Error(ErrorKind::input,
                    fmt::format("another [[{}]] is called '{}' too", section, list[k].name),
                    scene.location(path + ".name"));
  }
}

void check_species(const Scene& scene) {
  std::vector<std::string> names;
  for (const SpeciesSettings& s : scene.species) {
    if (s.plant.empty())
      throw Error(ErrorKind::input,
                  "a [[species]] needs a plant file, such as plant = \"plants/birch.lsys\"",
                  scene.location(fmt::format("species.{}", names.size())));
    names.push_back(s.name);
  }
  const auto check = [&](const Weights& species, const std::string& path) {
    for (const auto& [name, weight] : species)
      if (std::find(names.begin(), names.end(), name) == names.end())
        throw Error(ErrorKind::input,
                    fmt::format("no [[species]] is called '{}'.{}", name, suggestion(name, names)),
                    scene.location(path));
  };
  for (std::size_t k = 0; k < scene.scatter.size(); ++k)
    check(scene.scatter[k].species, fmt::format("scatter.{}.species", k));
  for (std::size_t k = 0; k < scene.grids.size(); ++k)
    check(scene.grids[k].species, fmt::format("grid.{}.species", k));
}

Scene scene_of(const toml::table& root, const std::string& source,
               const std::filesystem::path& folder) {
  Scene scene;
  scene.source = source;
  scene.folder = folder;
  const ParameterSet header = describe(scene.header);
  const std::vector<SceneSection> sections = scene_sections();
  for (const auto& [key, node] : root) {
    const std::string name(key.str());
    if (header.find(name) != nullptr) {
      header.assign(&scene.header, name, value_of(node), location_of(node.source()));
    } else if (std::none_of(sections.begin(), sections.end(),
                            [&](const SceneSection& s) { return s.path == name; })) {
      unknown_section(name, key_location(key, node));
    }
  }
  if (scene.header.wold > format_version)
    throw Error(ErrorKind::input,
                fmt::format("this scene is of format {}, but this wold reads up to {}",
                            scene.header.wold, format_version),
                {source, 0, 0});
  Locations& places = scene.locations;
  read_section(root, "terrain", scene.terrain, places, step_key);
  if (const auto* terrain = root["terrain"].as_table())
    for_each_table(*terrain, "step",
                   [&](const toml::table& table) { scene.steps.push_back(read_step(table)); });
  read_section(root, "surroundings", scene.surroundings, places);
  read_section(root, "ground", scene.ground, places);
  read_section(root, "water", scene.water, places);
  read_section(root, "sky", scene.sky, places);
  read_section(root, "render", scene.render, places);
  read_section(root, "picture", scene.picture, places);
  read_sections(root, "cover", scene.covers, places);
  read_sections(root, "material", scene.materials, places);
  read_sections(root, "species", scene.species, places);
  read_sections(root, "scatter", scene.scatter, places);
  read_sections(root, "grid", scene.grids, places);
  read_sections(root, "camera", scene.cameras, places);
  if (scene.cameras.empty()) scene.cameras.emplace_back();
  check_names(scene, "material", scene.materials);
  check_names(scene, "species", scene.species);
  check_names(scene, "camera", scene.cameras);
  check_species(scene);
  return scene;
}

}  // namespace

Description<SceneHeader> describe(const SceneHeader&) {
  return Description<SceneHeader>("scene", "What stands at the top of a scene file.")
      .add("wold", &SceneHeader::wold, {.min = 1}, "Version of the format.")
      .add("seed", &SceneHeader::seed, {.min = 0, .max = 9007199254740992.0},
           "Another number gives another landscape.");
}

Description<Surroundings> describe(const Surroundings&) {
  return Description<Surroundings>("surroundings",
                                   "The land around the terrain, seen in the distance.")
      .add("factor", &Surroundings::factor, {.min = 1, .max = 100},
           "Its size, in sizes of the terrain; 1 for none.")
      .add("resolution", &Surroundings::resolution, {.min = 3, .max = 16385}, "Samples on a side.");
}

SourceLocation Scene::location(const std::string& path) const {
  for (std::string at = path; !at.empty();) {
    if (const auto found = locations.find(at); found != locations.end() && found->second.known())
      return found->second;
    const auto dot = at.rfind('.');
    at.resize(dot == std::string::npos ? 0 : dot);
  }
  return {source, 0, 0};
}

const CameraSettings& Scene::camera(const std::string& name) const {
  if (name.empty()) return cameras.front();
  std::vector<std::string> names;
  for (const CameraSettings& c : cameras) {
    if (c.name == name) return c;
    names.push_back(c.name);
  }
  throw Error(ErrorKind::usage,
              fmt::format("{} has no camera '{}'.{}", source, name, suggestion(name, names)));
}

std::vector<SceneSection> scene_sections() {
  return {
      {"terrain", false, Described::of(TerrainSettings{})},
      {"surroundings", false, Described::of(Surroundings{})},
      {"ground", false, Described::of(GroundMaterial{})},
      {"cover", true, Described::of(GroundCover{})},
      {"water", false, Described::of(WaterSettings{})},
      {"material", true, Described::of(Material{})},
      {"species", true, Described::of(SpeciesSettings{})},
      {"scatter", true, Described::of(ScatterSettings{})},
      {"grid", true, Described::of(GridSpawner{})},
      {"sky", false, Described::of(SkySettings{})},
      {"camera", true, Described::of(CameraSettings{})},
      {"render", false, Described::of(RenderSettings{})},
      {"picture", false, Described::of(ToneMapping{})},
  };
}

OperatorList scene_operators() {
  OperatorList all = terrain_operators();
  for (TerrainOperator& op : erosion_operators()) all.push_back(std::move(op));
  return all;
}

Scene parse_scene(const std::string& text, const std::string& source,
                  const std::filesystem::path& folder, std::span<const std::string> overrides) {
  toml::table root = parse_toml(text, source);
  add_defaults(root);
  for (const std::string& assignment : overrides) override_value(root, assignment);
  return scene_of(root, source, folder);
}

Scene read_scene(const std::filesystem::path& file, std::span<const std::string> overrides) {
  return parse_scene(read_file(file.string()), file.string(), file.parent_path(), overrides);
}

}  // namespace wold
