#include "view/window_loop.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/error.hpp"
#include "image/io.hpp"
#include "view/camera_path.hpp"
#include "view/recording.hpp"
#include "virtual_desktop.hpp"

namespace wold {
namespace {

std::string in_folder(const std::string& name) {
  return ::testing::TempDir() + "window_loop_" + name;
}

WindowLoopSettings small_window() {
  std::ofstream(in_folder("scene.toml")) << R"(
[terrain]
size = 400
resolution = 65
[surroundings]
resolution = 33
[[terrain.step]]
op = "fbm"
height = 40
feature_size = 200
[[camera]]
position = [10, -20]
look_direction = [0, 1, 0]
)";
  WindowLoopSettings settings;
  settings.viewer.scene = in_folder("scene.toml");
  settings.width = 200;
  settings.height = 120;
  settings.path_file = in_folder("path.toml");
  settings.shots = in_folder("shot_%d.png");
  return settings;
}

TEST(WindowLoop, FliesARecordedSessionTakesPicturesAndRecordsIt) {
  const testing::VirtualDesktop desktop;
  if (!desktop.there()) GTEST_SKIP() << "Xvfb is not installed: 'apt install xvfb'";
  WindowLoopSettings settings = small_window();
  settings.replay = in_folder("session.txt");
  settings.record = in_folder("again.txt");
  std::filesystem::remove(settings.path_file);
  std::filesystem::remove(in_folder("shot_1.png"));
  std::ofstream(settings.replay) << "wold recording 1\n"
                                    "0.02\n"
                                    "0.02 pressed=help\n"
                                    "0.1 held=forward\n"
                                    "0.1 held=forward pressed=add_path_key\n"
                                    "0.1 held=forward pressed=screenshot\n"
                                    "0.1 pressed=full_screen\n"
                                    "0.1 pressed=add_path_key\n";
  const WindowLoopResult result = run_window(settings, nullptr);
  EXPECT_EQ(result.frames, 7);
  EXPECT_EQ(read_recording(settings.record), read_recording(settings.replay));
  EXPECT_EQ(read_picture(in_folder("shot_1.png")).image.width, 200);
  EXPECT_EQ(read_camera_path(settings.path_file).keys.size(), 2U);
}

TEST(WindowLoop, ASceneThatIsWrongEndsItWithItsError) {
  const testing::VirtualDesktop desktop;
  if (!desktop.there()) GTEST_SKIP() << "Xvfb is not installed: 'apt install xvfb'";
  WindowLoopSettings settings = small_window();
  std::ofstream(in_folder("scene.toml")) << "[skyy]\n";
  try {
    run_window(settings, nullptr);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(error.message().find("Did you mean 'sky'?"), std::string::npos) << error.message();
  }
}

}  // namespace
}  // namespace wold
