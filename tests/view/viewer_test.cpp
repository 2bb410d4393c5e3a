#include "view/viewer.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "base/error.hpp"
#include "gpu/context.hpp"
#include "image/io.hpp"
#include "view/film_maker.hpp"
#include "view/viewer_screen.hpp"

namespace wold {
namespace {

constexpr const char* small_scene = R"(
[terrain]
size = 400
resolution = 65
[surroundings]
resolution = 33
[[terrain.step]]
op = "fbm"
height = 40
feature_size = 200
[[species]]
name = "fern"
plant = "plants/fern.lsys"
height = [0.4, 0.8]
[[scatter]]
species = { fern = 1 }
density = 0.01
[[camera]]
position = [10, -20]
look_direction = [0, 1, 0]
)";

class ViewerTest : public testing::Test {
 protected:
  ViewerTest() {
    const testing::TestInfo* info = testing::UnitTest::GetInstance()->current_test_info();
    file_ = std::filesystem::path(testing::TempDir()) / (std::string(info->name()) + ".toml");
    write(small_scene);
    settings_.scene = file_;
    settings_.traced_size = 48;
    settings_.traced_samples = 3;
    settings_.detail = scene_detail(DrawingQuality::low);
    settings_.detail.shadows.size = 256;
    viewer_ = make();
  }

  std::unique_ptr<Viewer> make() {
    Progress silent;
    auto viewer = std::make_unique<Viewer>(settings_, load_viewed_scene(settings_, silent), silent);
    viewer->resize(64, 36);
    return viewer;
  }

  void write(const std::string& text) {
    std::ofstream(file_) << text;
    // Editors may write twice within what a file system can tell apart.
    static int later = 0;
    std::filesystem::last_write_time(
        file_, std::filesystem::file_time_type::clock::now() + std::chrono::seconds(++later));
  }

  static Controls held(std::initializer_list<Action> actions, double seconds = 0.1) {
    Controls c;
    c.seconds = seconds;
    for (const Action action : actions) c.held.add(action);
    return c;
  }
  static Controls pressed(Action action) {
    Controls c;
    c.seconds = 0.02;
    c.pressed.add(action);
    return c;
  }

  /// Frames until something is so, or a minute is over.
  template <class Condition>
  bool wait_until(const Condition& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (!condition()) {
      if (std::chrono::steady_clock::now() > end) return false;
      Controls c;
      c.seconds = 0.6;  // longer than files are left alone
      viewer_->frame(c);
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return true;
  }

  OffscreenContext context_;
  std::filesystem::path file_;
  ViewerSettings settings_;
  std::unique_ptr<Viewer> viewer_;
};

TEST_F(ViewerTest, FliesWhereTheKeysLead) {
  const Vec3 before = viewer_->camera().position;
  for (int k = 0; k < 10; ++k) viewer_->frame(held({Action::forward}));
  const Vec3 after = viewer_->camera().position;
  EXPECT_GT(after.y, before.y + 1);
  EXPECT_NEAR(after.x, before.x, 0.05F);
}

TEST_F(ViewerTest, TheSameControlsGiveTheSameViewBitForBit) {
  const std::unique_ptr<Viewer> other = make();
  for (int k = 0; k < 12; ++k) {
    Controls c = held({Action::forward, Action::faster}, 0.013 * (k + 1));
    c.look = {0.01F * static_cast<float>(k), -0.004F};
    viewer_->frame(c);
    other->frame(c);
  }
  EXPECT_EQ(viewer_->camera().position, other->camera().position);
  EXPECT_EQ(viewer_->camera().direction, other->camera().direction);
}

TEST_F(ViewerTest, AWindowOfNoSizeIsWaitedOut) {
  viewer_->frame({});
  const int frames = viewer_->picture().frames();
  viewer_->resize(0, 0);
  viewer_->frame(held({Action::forward}));
  EXPECT_EQ(viewer_->picture().frames(), frames);
  viewer_->resize(40, 30);
  viewer_->frame({});
  EXPECT_EQ(viewer_->picture().linear_image().width, 40);
}

TEST_F(ViewerTest, ASceneThatBecomesInvalidLeavesTheOldOneAndSaysWhere) {
  write(std::string(small_scene) + "[sky]\nturbidty = 3\n");
  ASSERT_TRUE(wait_until([&] { return !viewer_->error().empty(); }));
  EXPECT_NE(viewer_->error().find(file_.string() + ":22:1"), std::string::npos) << viewer_->error();
  EXPECT_NE(viewer_->error().find("Did you mean 'turbidity'?"), std::string::npos);
  EXPECT_EQ(viewer_->generation(), 1);
  viewer_->frame({});
  EXPECT_GT(viewer_->picture().frames(), 0);

  write(std::string(small_scene) + "[sky]\nturbidity = 3\n");
  ASSERT_TRUE(wait_until([&] { return viewer_->generation() == 2; }));
  EXPECT_TRUE(viewer_->error().empty());
  EXPECT_EQ(viewer_->scene().sky.turbidity, 3);
}

TEST_F(ViewerTest, AFileThatGoesAwayLeavesTheScene) {
  std::filesystem::remove(file_);
  viewer_->frame(pressed(Action::reload));
  EXPECT_NE(viewer_->error().find(file_.filename().string()), std::string::npos);
  EXPECT_EQ(viewer_->generation(), 1);
}

TEST_F(ViewerTest, LightChangesAtOnceAndLandInTheBackground) {
  const Vec3 sun = viewer_->drawing().light().sky().sun_direction();
  viewer_->edit().sky.sun = {12, 200};
  viewer_->edited(Viewer::Change::light);
  EXPECT_NE(viewer_->drawing().light().sky().sun_direction(), sun);
  EXPECT_FALSE(viewer_->loading());

  const float before = viewer_->world()->world().ground.base({0, 0}).height;
  viewer_->edit().steps[0].parameters.assign("height", 80.0);
  viewer_->edited(Viewer::Change::everything);
  EXPECT_TRUE(viewer_->loading());
  ASSERT_TRUE(wait_until([&] { return viewer_->generation() == 2; }));
  EXPECT_NEAR(viewer_->world()->world().ground.base({0, 0}).height, 2 * before, 1e-2F);
}

TEST_F(ViewerTest, LandOfManySamplesIsSeenInFewFirstAndEditsGoOn) {
  viewer_->edit().terrain.resolution = 513;
  viewer_->edited(Viewer::Change::everything);
  ASSERT_TRUE(wait_until([&] { return viewer_->generation() == 2; }));
  EXPECT_EQ(viewer_->scene().terrain.resolution, 257);
  EXPECT_EQ(viewer_->edited_scene().terrain.resolution, 513);
  EXPECT_TRUE(viewer_->loading());
  ASSERT_TRUE(wait_until([&] { return viewer_->generation() == 3; }));
  EXPECT_EQ(viewer_->scene().terrain.resolution, 513);
  EXPECT_EQ(viewer_->readings(), 1);
}

TEST_F(ViewerTest, AnEditThatIsNotAllowedIsAnError) {
  viewer_->edit().sky.sun = {100, 0};
  viewer_->edited(Viewer::Change::light);
  EXPECT_NE(viewer_->error().find("'sun' in 'sky'"), std::string::npos) << viewer_->error();
}

TEST_F(ViewerTest, TheHourTurnsTheSunRoundMidnightToo) {
  viewer_->edit().sky.time.hour = 23;
  viewer_->edit().sky.time.minute = 50;
  for (int k = 0; k < 4; ++k) viewer_->frame(held({Action::later}, 0.1));
  EXPECT_EQ(viewer_->edited_scene().sky.time.hour, 0);
  for (int k = 0; k < 4; ++k) viewer_->frame(held({Action::earlier}, 0.1));
  EXPECT_EQ(viewer_->edited_scene().sky.time.hour, 23);
}

TEST_F(ViewerTest, TracesTheViewBesideAndCloses) {
  viewer_->frame(pressed(Action::path_trace));
  TracedView& traced = viewer_->traced();
  ASSERT_TRUE(traced.open());
  ASSERT_TRUE(wait_until([&] { return traced.status() == "3 samples"; })) << traced.status();
  const std::optional<Image> image = traced.picture();
  ASSERT_TRUE(image);
  EXPECT_EQ(image->width, 48);
  EXPECT_EQ(image->height, 27);
  EXPECT_TRUE(traced.newest());
  EXPECT_FALSE(traced.newest());
  viewer_->frame(pressed(Action::path_trace));
  EXPECT_FALSE(traced.open());
}

TEST_F(ViewerTest, ShowsTestRaysWithTheirBounces) {
  viewer_->frame(pressed(Action::test_rays));
  ASSERT_TRUE(wait_until([&] { return !viewer_->rays().paths.empty(); }));
  for (const std::vector<PathVertex>& path : viewer_->rays().paths) {
    ASSERT_GE(path.size(), 2U);
    EXPECT_EQ(path[0].position, viewer_->camera().position);
  }
  viewer_->frame(pressed(Action::test_rays));
  EXPECT_TRUE(viewer_->rays().paths.empty());
}

TEST_F(ViewerTest, CopiesTheCameraAsASceneHasIt) {
  viewer_->frame(pressed(Action::copy_camera));
  const std::optional<std::string> text = viewer_->take_clipboard();
  ASSERT_TRUE(text);
  EXPECT_EQ(text->rfind("[[camera]]", 0), 0U);
  const Scene scene = parse_scene(*text, "copied", ".");
  EXPECT_NEAR(static_cast<float>(scene.cameras[0].position.at(0)), viewer_->camera().position.x,
              0.01F);
  EXPECT_FALSE(viewer_->take_clipboard());
}

double mean_of(const Image& image) {
  double sum = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) sum += static_cast<double>(image.at(x, y, 1));
  return sum / (image.width * image.height);
}

/// The first row from the top in the middle whose green is well below the top's.
int horizon_of(const Image& image) {
  for (int y = 1; y < image.height; ++y)
    if (image.at(image.width / 2, y, 2) < 0.7F * image.at(image.width / 2, 0, 2)) return y;
  return image.height;
}

TEST_F(ViewerTest, ShowsTheLandAsItsShaderDrawsItFromTheSameCamera) {
  Camera camera = viewer_->camera();
  camera.position.z += 60;
  camera.direction = {0, 1, -0.1F};
  viewer_->place(camera);
  viewer_->frame({});
  const int horizon = horizon_of(viewer_->displayed());
  viewer_->frame(pressed(Action::shader));
  EXPECT_TRUE(viewer_->shader_wanted());
  ASSERT_TRUE(wait_until([&] { return viewer_->shader_shown(); }));
  viewer_->frame({});
  const Image shown = viewer_->displayed();
  EXPECT_EQ(shown.width, 64);
  EXPECT_GT(horizon, 4);
  EXPECT_LT(horizon, 30);
  EXPECT_NEAR(horizon_of(shown), horizon, 3);

  viewer_->edit().picture.exposure -= 1;
  viewer_->frame({});
  const double darker = mean_of(viewer_->displayed());
  EXPECT_LT(darker, 0.85 * mean_of(shown));
  viewer_->edit().sky.sun = {-8, 180};
  viewer_->edited(Viewer::Change::light);
  viewer_->restart_picture();
  viewer_->frame({});
  EXPECT_LT(mean_of(viewer_->displayed()), 0.85 * darker);
  EXPECT_FALSE(viewer_->shader().busy()) << "another sun needs no other shader";

  viewer_->frame(pressed(Action::shader));
  EXPECT_FALSE(viewer_->shader_shown());
}

TEST_F(ViewerTest, TheShaderFollowsOtherLandAndCanBeCancelled) {
  viewer_->want_shader(true);
  viewer_->frame({});
  viewer_->want_shader(false);
  viewer_->want_shader(true);
  ASSERT_TRUE(wait_until([&] { return viewer_->shader_shown(); }));
  viewer_->edit().steps[0].parameters.assign("height", 80.0);
  viewer_->edited(Viewer::Change::everything);
  bool made = false;
  ASSERT_TRUE(wait_until([&] { return made = made || viewer_->shader().busy(); }));
  ASSERT_TRUE(wait_until([&] { return !viewer_->shader().busy(); }));
  EXPECT_TRUE(viewer_->shader_shown());
  EXPECT_TRUE(viewer_->take_notices().empty());
}

TEST_F(ViewerTest, WhatASceneAddsToMeteringIsNotAddedToItsShader) {
  settings_.shader = true;
  std::vector<double> means;
  for (const char* picture : {"", "[picture]\nexposure = 2\n"}) {
    write(std::string(picture) + small_scene);
    viewer_ = make();
    ASSERT_TRUE(wait_until([&] { return viewer_->shader_shown(); }));
    viewer_->set_seconds(0);
    viewer_->restart_picture();
    viewer_->frame({});
    means.push_back(mean_of(viewer_->displayed()));
  }
  EXPECT_NEAR(means[1], means[0], 1e-4);
}

TEST_F(ViewerTest, KnobsOfTheShaderAreEditedAndStay) {
  viewer_->want_shader(true);
  ASSERT_TRUE(wait_until([&] { return viewer_->shader_shown(); }));
  viewer_->restart_picture();
  viewer_->frame({});
  const double before = mean_of(viewer_->displayed());
  const float usual = viewer_->shader().scene_knobs().terrain_height;
  viewer_->edit_knobs().terrain_height = 0;
  viewer_->edit_knobs().cloud_steps = 0;
  viewer_->edited(Viewer::Change::shader);
  EXPECT_TRUE(viewer_->shader().busy());
  EXPECT_TRUE(viewer_->shader_shown()) << "the old one, until the new one is compiled";
  EXPECT_EQ(viewer_->shader().report().stage, "compiling");
  ASSERT_TRUE(wait_until([&] { return !viewer_->shader().busy(); }));
  viewer_->restart_picture();
  viewer_->frame({});
  EXPECT_GT(std::abs(mean_of(viewer_->displayed()) - before), 0.003);
  EXPECT_EQ(viewer_->shader().scene_knobs().terrain_height, usual);

  // Other land: what was edited stays, the rest is the land's own.
  const int generation = viewer_->shader().generation();
  viewer_->edit().sky.clouds.height += 500;
  viewer_->edited(Viewer::Change::light);
  ASSERT_TRUE(wait_until([&] { return viewer_->shader().generation() > generation; }));
  EXPECT_EQ(viewer_->edit_knobs().terrain_height, 0);
  EXPECT_EQ(viewer_->edit_knobs().cloud_steps, 0);
}

TEST_F(ViewerTest, WhatTheViewSetsIsNoKnobOfThePanel) {
  const ParameterSet knobs = ShaderView::free_knobs();
  EXPECT_NE(knobs.find("CLOUD_COVERAGE"), nullptr);
  for (const char* name : {"SUN_ELEVATION", "EXPOSURE", "CAM_HEIGHT", "FIELD_OF_VIEW"})
    EXPECT_EQ(knobs.find(name), nullptr) << name;
}

TEST_F(ViewerTest, AKnobThatTheShaderDoesNotHaveIsAnError) {
  settings_.defines = {"OCTAVE=3"};
  try {
    make();
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(error.message().find("'OCTAVES'"), std::string::npos) << error.message();
  }
}

TEST_F(ViewerTest, TheScreenShowsErrorsUntilTheyAreSolved) {
  Interface interface;
  ViewerScreen screen(*viewer_, interface);
  const GpuTarget target(320, 180, std::array{PixelFormat::rgba8}, false);
  screen.frame({}, {320, 180}, target.id());
  EXPECT_FALSE(screen.messages().has_errors());
  viewer_->edit().sky.sun = {100, 0};
  viewer_->edited(Viewer::Change::light);
  screen.frame({}, {320, 180}, target.id());
  EXPECT_TRUE(screen.messages().has_errors());
  viewer_->edit().sky.sun = {};
  viewer_->edited(Viewer::Change::light);
  screen.frame({}, {320, 180}, target.id());
  EXPECT_FALSE(screen.messages().has_errors());
  screen.frame({}, {0, 0}, target.id());
}

CameraPath two_keys() {
  return parse_camera_path(R"(
[[key]]
time = 1
position = [10, -20, 60]
look_direction = [0, 1, -0.2]
[[key]]
time = 1.2
position = [10, -10, 60]
look_direction = [0, 1, -0.2]
)",
                           "path.toml");
}

TEST(FilmMaker, FramesAndExposureFollowTheKeys) {
  const CameraPath path = two_keys();
  EXPECT_EQ(all_frames(path, 10), (FrameRange{0, 3}));
  EXPECT_EQ(all_frames(path, 25), (FrameRange{0, 6}));
  const std::vector<float> stops{2, 4};
  EXPECT_EQ(exposure_at(path, stops, 0), 2);
  EXPECT_NEAR(exposure_at(path, stops, 1.1), 3, 1e-5F);
  EXPECT_EQ(exposure_at(path, stops, 9), 4);
}

TEST_F(ViewerTest, MakesFilmsOfEachRendererAndGoesOnWithThem) {
  FilmSettings film;
  film.path = two_keys();
  film.size = {48, 27};
  film.samples = 2;
  film.frames_per_second = 10;
  const std::string base = testing::TempDir() + "film_";
  for (const FilmRenderer renderer :
       {FilmRenderer::drawn, FilmRenderer::traced, FilmRenderer::shader}) {
    film.renderer = renderer;
    film.resume = false;
    film.frames = FramePattern(base + std::to_string(static_cast<int>(renderer)) + "_%02d.png");
    for (int k = 0; k < 3; ++k) std::filesystem::remove(film.frames.name(k));
    Progress progress;
    EXPECT_EQ(make_film(*viewer_, film, progress), 3);
    std::filesystem::remove(film.frames.name(1));
    film.resume = true;
    EXPECT_EQ(make_film(*viewer_, film, progress), 1);
    EXPECT_EQ(read_picture(film.frames.name(2)).image.width, 48);
  }
}

TEST_F(ViewerTest, APathBelowTheGroundIsToldBeforeAnyWork) {
  FilmSettings film;
  film.path = two_keys();
  film.path.keys[1].position.z = -500;
  film.size = {48, 27};
  film.frames_per_second = 10;
  film.frames = FramePattern(testing::TempDir() + "below_%02d.png");
  std::filesystem::remove(film.frames.name(0));
  Progress progress;
  try {
    make_film(*viewer_, film, progress);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(error.message().find("below the ground"), std::string::npos) << error.message();
  }
  EXPECT_FALSE(std::filesystem::exists(film.frames.name(0)));
}

}  // namespace
}  // namespace wold
