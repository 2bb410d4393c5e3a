// Every command that is no render, and what all commands share.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "image/atomic_file.hpp"
#include "image/io.hpp"
#include "process.hpp"
#include "scene/scene.hpp"

namespace wold {
namespace {

using nlohmann::json;
using testing::Outcome;
using testing::Workplace;
using Words = std::vector<std::string>;

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Commands, VersionAndHelp) {
  const Workplace place;
  const Outcome version = place.run({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_TRUE(std::regex_match(version.out, std::regex("wold \\d+\\.\\d+\\.\\d+\n")));
  const Outcome help = place.run({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  for (const char* command : {"render", "terrain", "erode", "analyze", "check", "new", "help"}) {
    EXPECT_TRUE(contains(help.out, command));
    const Outcome of_command = place.run({command, "--help"});
    EXPECT_EQ(of_command.exit_code, 0);
    EXPECT_TRUE(contains(of_command.out, "Usage")) << of_command.out;
    EXPECT_TRUE(contains(place.run({"help", command}).out, command));
  }
}

TEST(Commands, HelpExplainsEverySectionAndOperator) {
  const Workplace place;
  const Outcome list = place.run({"help"});
  EXPECT_EQ(list.exit_code, 0);
  const auto expect_help = [&](const std::string& topic, const ParameterSet& set) {
    EXPECT_TRUE(contains(list.out, topic)) << topic;
    const Outcome help = place.run({"help", topic});
    EXPECT_EQ(help.exit_code, 0) << topic;
    for (const Parameter& p : set.parameters) {
      EXPECT_TRUE(contains(help.out, "  " + p.name + " ")) << topic << '.' << p.name;
      EXPECT_TRUE(contains(help.out, p.text)) << topic << '.' << p.name;
    }
  };
  for (const SceneSection& section : scene_sections())
    expect_help(section.path, section.defaults.parameters());
  for (const TerrainOperator& op : scene_operators())
    expect_help(op.name(), op.defaults.parameters());
}

TEST(Commands, SchemaHasEveryParameter) {
  const Workplace place;
  const json schema = json::parse(place.run({"help", "--schema"}).out);
  EXPECT_EQ(schema["type"], "object");
  for (const SceneSection& section : scene_sections()) {
    json object = schema["properties"][section.path];
    if (section.repeated) {
      // Written once, [camera], or more often, [[camera]].
      EXPECT_EQ(object["anyOf"][1]["items"], object["anyOf"][0]) << section.path;
      object = object["anyOf"][0];
    }
    for (const std::string& name : section.defaults.parameters().names())
      EXPECT_TRUE(object["properties"].contains(name)) << section.path << '.' << name;
  }
  const json steps = schema["properties"]["terrain"]["properties"]["step"]["anyOf"][0]["oneOf"];
  ASSERT_EQ(steps.size(), scene_operators().size());
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const TerrainOperator op = scene_operators()[k];
    EXPECT_EQ(steps[k]["properties"]["op"]["const"], op.name());
    for (const std::string& name : op.defaults.parameters().names())
      EXPECT_TRUE(steps[k]["properties"].contains(name)) << op.name() << '.' << name;
  }
}

TEST(Commands, ReferencePagesAreWritten) {
  const Workplace place;
  std::filesystem::create_directory(place.path("pages"));
  EXPECT_EQ(place.run({"help", "--write-reference", "pages"}).exit_code, 0);
  const std::string index = place.read("pages/README.md");
  for (const TerrainOperator& op : scene_operators()) {
    EXPECT_TRUE(contains(index, "(" + op.name() + ".md)"));
    const std::string page = place.read("pages/" + op.name() + ".md");
    for (const std::string& name : op.defaults.parameters().names())
      EXPECT_TRUE(contains(page, "`" + name + "`")) << op.name() << '.' << name;
  }
  const std::string scene = place.read("pages/scene.md");
  for (const SceneSection& section : scene_sections())
    EXPECT_TRUE(contains(scene, "# " + section.defaults.parameters().name)) << section.path;
  EXPECT_TRUE(json::accept(place.read("pages/scene.schema.json")));
}

TEST(Commands, ReferenceInDocsIsUpToDate) {
  const Workplace place;
  std::filesystem::create_directory(place.path("pages"));
  ASSERT_EQ(place.run({"help", "--write-reference", "pages"}).exit_code, 0);
  for (const auto& page : std::filesystem::directory_iterator(place.path("pages"))) {
    const std::filesystem::path name = page.path().filename();
    const std::string kept = WOLD_SOURCE_DIR "/docs/reference/" + name.string();
    ASSERT_TRUE(std::filesystem::exists(kept)) << name << ": run make docs";
    EXPECT_EQ(place.read("pages/" + name.string()), read_file(kept)) << name << ": run make docs";
  }
}

TEST(Commands, NewWritesASceneThatIsGoodAndKeepsWhatIsThere) {
  const Workplace place;
  EXPECT_EQ(place.run({"new", "hills"}).exit_code, 0);
  ASSERT_TRUE(place.has("hills.toml"));
  EXPECT_EQ(place.run({"check", "hills.toml"}).exit_code, 0);
  place.write("hills.toml", "# mine");
  EXPECT_EQ(place.run({"new", "hills"}).exit_code, 2);
  EXPECT_EQ(place.run({"new", "hills.toml"}).exit_code, 2);
  EXPECT_EQ(place.read("hills.toml"), "# mine");
}

TEST(Commands, ExampleScenesAreGood) {
  const Workplace place;
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(WOLD_SOURCE_DIR "/scenes")) {
    if (entry.path().extension() != ".toml") continue;
    ++scenes;
    const Outcome outcome = place.run({"check", entry.path().string()});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  }
  EXPECT_GE(scenes, 1);
}

TEST(Commands, JsonIsAloneOnStandardOutput) {
  const Workplace place;
  const Outcome render = place.run({"render", "scene.toml", "--json", "-o", "a.exr"});
  const json report = json::parse(render.out);
  EXPECT_TRUE(contains(render.err, "wrote a.exr"));
  EXPECT_EQ(report["command"], "render");
  EXPECT_EQ(report["complete"], true);
  EXPECT_EQ(report["size"], json({96, 54}));
  EXPECT_EQ(report["paths"], 96 * 54 * 4);
  EXPECT_EQ(report["outputs"], json({"a.exr"}));
  EXPECT_GT(report["plants"]["tree"], 100);
  EXPECT_GT(report["peak_memory_bytes"], 1e6);
  EXPECT_EQ(report["camera"]["position"].size(), 3U);
  const json check = json::parse(place.run({"check", "scene.toml", "--json"}).out);
  EXPECT_EQ(check["good"], true);
  const json made = json::parse(place.run({"new", "x", "--json", "-q"}).out);
  EXPECT_EQ(made["wrote"], "x.toml");
  const json terrain = json::parse(place.run({"terrain", "scene.toml", "--json"}).out);
  EXPECT_EQ(terrain["files"][0]["size"], json({65, 65}));
}

TEST(Commands, QuietSaysNothing) {
  const Workplace place;
  const std::vector<Words> all{{"render", "scene.toml", "-q"},
                               {"check", "scene.toml", "--quiet"},
                               {"terrain", "scene.toml", "-q"},
                               {"new", "x", "-q"}};
  for (const Words& words : all) {
    const Outcome outcome = place.run(words);
    EXPECT_EQ(outcome.exit_code, 0) << words[0];
    EXPECT_EQ(outcome.out + outcome.err, "") << words[0];
  }
  EXPECT_FALSE(place.run({"check", "nofile.toml", "-q"}).err.empty());
}

TEST(Commands, TerrainWritesEveryFormat) {
  const Workplace place;
  Words words{"terrain", "scene.toml", "-q", "--maps", "maps", "--preview", "preview.png"};
  const Words formats{"a.exr", "a.tif", "a.png", "a.r16", "a.raw", "a.obj", "a.ply", "a.glb"};
  for (const std::string& file : formats) words.insert(words.end(), {"-o", file});
  const Outcome outcome = place.run(words);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const std::string& file : formats) EXPECT_GT(place.read(file).size(), 65U * 65U) << file;
  EXPECT_EQ(place.read("a.r16").size(), 2U * 65U * 65U);
  EXPECT_EQ(read_picture(place.path("a.exr").string()).image.width, 65);
  for (const char* map : {"maps/slope.exr", "maps/curvature.exr", "preview.png"})
    EXPECT_EQ(read_picture(place.path(map).string()).image.height, 65) << map;
}

TEST(Commands, TerrainPresetsChooseSizeAndFormat) {
  const Workplace place;
  const auto files_of = [&](const char* preset) {
    const Outcome outcome = place.run({"terrain", "scene.toml", "--preset", preset, "--json"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return json::parse(outcome.out)["files"][0];
  };
  const json unreal = files_of("unreal");
  EXPECT_EQ(unreal["size"], json({127, 127}));
  EXPECT_EQ(unreal["path"], "scene.png");
  EXPECT_TRUE(unreal["settings"].contains("Scale Z"));
  EXPECT_EQ(read_picture(place.path("scene.png").string()).image.width, 127);
  EXPECT_EQ(files_of("unity")["size"], json({65, 65}));
  EXPECT_EQ(place.read("scene.raw").size(), 2U * 65U * 65U);
  EXPECT_EQ(files_of("godot")["path"], "scene.exr");
}

TEST(Commands, TerrainResolutionIsTheUsers) {
  const Workplace place;
  const Outcome outcome =
      place.run({"terrain", "scene.toml", "-o", "a.exr", "--resolution", "33", "-q"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(read_picture(place.path("a.exr").string()).image.width, 33);
}

}  // namespace
}  // namespace wold
