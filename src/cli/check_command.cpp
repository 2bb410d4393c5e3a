#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <memory>

#include "cli/commands.hpp"
#include "cli/session.hpp"
#include "scene/build.hpp"

namespace wold {

void add_check(CLI::App& app, Session& session) {
  auto file = std::make_shared<std::string>();
  CLI::App* command =
      app.add_subcommand("check", "Read a scene and everything it names, and say what is wrong");
  command->add_option("scene", *file, "The scene's TOML file")->required()->type_name("SCENE");
  session.add_scene_options(*command);
  session.add_output_options(*command);
  command->callback([&session, file] {
    const Scene scene = read_scene(*file, session.overrides());
    check_scene(scene);
    session.say(fmt::format("{}: {} terrain steps, {} species, {} scatters, {} cameras: good",
                            *file, scene.steps.size(), scene.species.size(), scene.scatter.size(),
                            scene.cameras.size()));
    session.print({{"scene", *file},
                   {"good", true},
                   {"steps", scene.steps.size()},
                   {"species", scene.species.size()},
                   {"scatters", scene.scatter.size()},
                   {"cameras", scene.cameras.size()}});
  });
}

}  // namespace wold
