#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <memory>
#include <set>

#include "base/error.hpp"
#include "cli/commands.hpp"
#include "cli/session.hpp"
#include "erosion/operators.hpp"
#include "image/atomic_file.hpp"
#include "realtime/landscape_settings.hpp"
#include "scene/scene.hpp"
#include "view/camera_path.hpp"
#include "view/controls.hpp"

namespace wold {

namespace {

void list_all(const CLI::App& app) {
  std::string text = fmt::format("{}\n\nCommands ('wold help COMMAND'):\n", app.get_description());
  const auto add = [&text](const std::string& name, const std::string& what) {
    text += fmt::format("  {:<14} {}\n", name, what);
  };
  for (const CLI::App* command : app.get_subcommands({}))
    add(command->get_name(), command->get_description());
  text += "\nSections of a scene file ('wold help SECTION'):\n";
  for (const SceneSection& s : scene_sections())
    add(s.repeated ? "[[" + s.path + "]]" : "[" + s.path + "]", s.defaults.parameters().text);
  text += "\nOperators of [[terrain.step]] ('wold help OPERATOR'):\n";
  for (const TerrainOperator& op : scene_operators()) add(op.name(), op.text());
  write_output(text);
}

void print_set(const ParameterSet& set, const void* defaults) {
  write_output(help_text(set, defaults));
}

/// "Makes the maps a, b." or nothing.
std::string maps_text(const TerrainOperator& op, const char* quote) {
  if (op.maps.empty()) return {};
  std::vector<std::string> names;
  for (const std::string& map : op.maps) names.push_back(quote + map + quote);
  return fmt::format("\nMakes the maps {}.\n", fmt::join(names, ", "));
}

/// Prints the help of a command, a section or an operator. Throws Error(usage) for anything else.
void explain(const CLI::App& app, const std::string& topic) {
  std::vector<std::string> known;
  bool found = false;
  for (const CLI::App* command : app.get_subcommands({})) {
    known.push_back(command->get_name());
    if (command->get_name() != topic) continue;
    write_output(command->help());
    if (topic == "view") write_output("\n" + controls_help());
    if (topic == "shader") {
      const LandscapeSettings knobs;
      write_output("\n");
      print_set(describe(knobs), &knobs);
    }
    found = true;
  }
  for (const SceneSection& section : scene_sections()) {
    if (std::find(known.begin(), known.end(), section.path) == known.end())
      known.push_back(section.path);
    if (section.path != topic) continue;
    if (found) write_output("\n");
    print_set(section.defaults.parameters(), section.defaults.data());
    found = true;
  }
  for (const TerrainOperator& op : scene_operators()) {
    known.push_back(op.name());
    if (op.name() != topic) continue;
    print_set(op.defaults.parameters(), op.defaults.data());
    write_output(maps_text(op, ""));
    const StepSettings common;
    write_output("\nBesides, as for every step: ");
    print_set(describe(common), &common);
    found = true;
  }
  if (!found)
    throw Error(ErrorKind::usage,
                fmt::format("there is no help on '{}'.{}", topic, suggestion(topic, known)));
}

std::string operator_page(const TerrainOperator& op, bool has_picture) {
  std::string page = reference_markdown(op.defaults.parameters(), op.defaults.data());
  page += maps_text(op, "`");
  if (!has_picture) return page;
  return page +
         fmt::format(
             "\n![Before and after]({0}.webp)\n\n"
             "Before and after: [scenes/reference/{0}.toml](../../scenes/reference/{0}.toml).\n",
             op.name());
}

/// Controls of the window, and what a camera path may say.
std::string view_page() {
  return "# wold view\n\nWritten by `wold help --write-reference`.\n\n## Controls\n" +
         controls_markdown() + "\n## Keys of a camera path, `[[key]]`\n\n#" +
         camera_key_reference();
}

/// Markdown pages, one per operator and one of all sections, and the JSON Schema, into a folder.
void write_reference(const std::string& folder) {
  std::string sections =
      "# Sections of a scene file\n\nWritten by `wold help --write-reference`.\n";
  for (const SceneSection& s : scene_sections())
    sections += "\n#" + reference_markdown(s.defaults.parameters(), s.defaults.data());
  const StepSettings common;
  sections += "\n#" + reference_markdown(describe(common), &common);
  std::string index =
      "# Reference\n\nWritten by `wold help --write-reference`.\n\n- [Sections of a scene "
      "file](scene.md)\n- [JSON Schema](scene.schema.json)\n- [Knobs of `wold "
      "shader`](shader.md)\n- [Controls and camera paths of `wold view`](view.md)\n\nOperators of "
      "`[[terrain.step]]`:\n\n";
  std::set<std::string> eroding;
  for (const TerrainOperator& op : erosion_operators()) eroding.insert(op.name());
  for (const TerrainOperator& op : scene_operators()) {
    index += fmt::format("- [{}]({}.md): {}\n", op.name(), op.name(), op.text());
    write_file(fmt::format("{}/{}.md", folder, op.name()),
               operator_page(op, eroding.contains(op.name())));
  }
  write_file(folder + "/scene.md", sections);
  const LandscapeSettings knobs;
  write_file(folder + "/shader.md", reference_markdown(describe(knobs), &knobs));
  write_file(folder + "/view.md", view_page());
  write_file(folder + "/README.md", index);
  write_file(folder + "/scene.schema.json", scene_schema());
}

}  // namespace

void add_help(CLI::App& app, Session&) {
  auto topic = std::make_shared<std::string>();
  auto folder = std::make_shared<std::string>();
  auto schema = std::make_shared<bool>(false);
  CLI::App* command =
      app.add_subcommand("help", "Explain a command, a section of a scene or an operator");
  command->add_option("topic", *topic, "Command, section or operator")->type_name("TOPIC");
  command->add_flag("--schema", *schema, "Print the JSON Schema of scene files");
  command
      ->add_option("--write-reference", *folder,
                   "Write the reference pages and the schema into a folder")
      ->type_name("FOLDER");
  command->callback([&app, topic, folder, schema] {
    if (!folder->empty()) {
      write_reference(*folder);
    } else if (*schema) {
      write_output(scene_schema());
    } else if (topic->empty()) {
      list_all(app);
    } else {
      explain(app, *topic);
    }
  });
}

}  // namespace wold
