#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <filesystem>
#include <memory>
#include <string_view>

#include "base/error.hpp"
#include "cli/commands.hpp"
#include "cli/session.hpp"
#include "image/atomic_file.hpp"
#include "scene/example.hpp"

namespace wold {

namespace {

/// The example under a first line of its own.
std::string scene_text(const std::string& name) {
  const std::string_view example = example_scene;
  return fmt::format(
      "# {}: a scene for wold. 'wold render {}.toml' makes its picture;\n"
      "# 'wold help terrain', 'wold help ridged' and so on list what can be set.\n{}",
      name, name, example.substr(example.find('\n') + 1));
}

}  // namespace

void add_new(CLI::App& app, Session& session) {
  auto name = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("new", "Write a scene to start from");
  command->add_option("name", *name, "Name of the scene; NAME.toml is written")
      ->required()
      ->type_name("NAME");
  session.add_output_options(*command);
  command->callback([&session, name] {
    std::filesystem::path file(*name);
    if (file.extension() != ".toml") file += ".toml";
    if (std::filesystem::exists(file))
      throw Error(ErrorKind::usage,
                  fmt::format("{} is already there; choose another name", file.string()));
    write_file(file.string(), scene_text(file.stem().string()));
    session.say(
        fmt::format("wrote {}; 'wold render {}' makes its picture", file.string(), file.string()));
    session.print({{"wrote", file.string()}});
  });
}

}  // namespace wold
