#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <filesystem>
#include <memory>

#include "base/error.hpp"
#include "cli/commands.hpp"
#include "cli/session.hpp"
#include "image/atomic_file.hpp"
#include "scene/defaults.hpp"

namespace wold {

namespace {

std::string scene_text(const std::string& name) {
  return fmt::format(
      "# {}: a scene for wold. 'wold render {}.toml' makes its picture.\n"
      "# 'wold help terrain', 'wold help ridged' and so on list what can be set.\n\n"
      "wold = 1\nseed = 42\n\n"
      "[terrain]\nsize = 3000          # m\nresolution = 1025\n\n"
      "{}\n{}\n"
      "[sky]\nplace = [49.2, 16.6]\ntime = 2026-06-21T18:30:00+02:00\n\n"
      "[camera]\nlook_height = 1.8     # m above ground; give a position to choose the place\n\n"
      "[render]\nsize = [1280, 720]\nsamples = 64\n",
      name, name, default_steps, default_forest);
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
