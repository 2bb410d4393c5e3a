#include "view/panel.hpp"

#include <epoxy/gl.h>
#include <gtest/gtest.h>
#include <imgui.h>

#include <array>
#include <cmath>
#include <cstdlib>

#include "gpu/context.hpp"
#include "gpu/objects.hpp"
#include "image/io.hpp"
#include "view/interface.hpp"
#include "view/overlay.hpp"
#include "view/parameter_widgets.hpp"
#include "view/slider_range.hpp"

namespace wold {
namespace {

TEST(SliderRange, IsTheParametersOwnWhereItHasOne) {
  EXPECT_EQ(slider_range({.unit = {}, .min = 0, .max = 1}, 0.2, 0.2), (SliderRange{0, 1, false}));
  EXPECT_EQ(slider_range({.unit = {}, .min = -90, .max = 90}, 0, 3), (SliderRange{-90, 90, false}));
}

TEST(SliderRange, IsFiniteByTheUsualValueWhereItHasNone) {
  EXPECT_EQ(slider_range({.unit = "m", .min = 0}, 900, 900), (SliderRange{0, 3600, false}));
  EXPECT_EQ(slider_range({}, -5, -5), (SliderRange{-20, 20, false}));
  EXPECT_EQ(slider_range({.unit = "m"}, 0, 0), (SliderRange{-100, 100, false}));
  // 20 km is allowed, but nobody slides there from 1 m.
  EXPECT_LT(slider_range({.unit = "m", .min = 0, .max = 20000}, 1, 1).high, 100);
}

TEST(SliderRange, GoesByRatioOverDecades) {
  const SliderRange visibility = slider_range({.unit = "m", .min = 10, .max = 1e6}, 40000, 40000);
  EXPECT_TRUE(visibility.logarithmic);
  EXPECT_EQ(visibility.high, 1e6);
  EXPECT_TRUE(slider_range({.unit = {}, .min = 0, .max = 1000}, 1, 1).logarithmic);
}

TEST(SliderRange, HoldsEveryValueOfEveryParameterOfAScene) {
  for (const SceneSection& section : scene_sections())
    for (const Parameter& p : section.defaults.parameters().parameters) {
      if (p.kind != ParameterKind::number) continue;
      const double usual = std::get<double>(p.get(section.defaults.data()));
      for (const double present : {usual, std::isfinite(p.limits.max) ? p.limits.max : 1e7}) {
        const SliderRange range = slider_range(p.limits, usual, present);
        EXPECT_LE(range.low, present) << p.name;
        EXPECT_GE(range.high, present) << p.name;
        EXPECT_LT(range.low, range.high) << p.name;
        EXPECT_TRUE(std::isfinite(range.low) && std::isfinite(range.high)) << p.name;
        EXPECT_TRUE(!range.logarithmic || range.low >= 0) << p.name;
      }
    }
}

TEST(ParameterWidgets, TextsOfListsAndHours) {
  EXPECT_EQ(title_of("sun_intensity"), "Sun intensity");
  EXPECT_EQ(title_of("soil_color1"), "Soil color 1");
  EXPECT_EQ(title_of("CLOUD_COVERAGE"), "Cloud coverage");
  EXPECT_EQ(parse_list(list_text({1, -2.5, 1e-7})), (std::vector<double>{1, -2.5, 1e-7}));
  EXPECT_EQ(parse_list(" [1, 2] "), (std::vector<double>{1, 2}));
  EXPECT_TRUE(parse_list("").empty());
  EXPECT_THROW(parse_list("1, two"), Error);
  DateTime time;
  time = with_hour(time, 18.5);
  EXPECT_EQ(time.hour, 18);
  EXPECT_EQ(time.minute, 30);
  EXPECT_DOUBLE_EQ(hour_of(time), 18.5);
  EXPECT_EQ(with_hour(time, 24).hour, 23);
  EXPECT_EQ(with_hour(time, 24).day, time.day);
}

TEST(History, UndoesAndRedoesAndForgetsWhatWasUndoneAfterAChange) {
  History history;
  EXPECT_FALSE(history.undo());
  history.add({"sky", "turbidity", 2.0, 3.0});
  history.add({"sky", "turbidity", 3.0, 4.0});
  EXPECT_EQ(history.undo()->after, Value(3.0));
  EXPECT_EQ(history.redo()->after, Value(4.0));
  EXPECT_FALSE(history.redo());
  history.undo();
  history.add({"sky", "haze", true, false});
  EXPECT_FALSE(history.redo());
  EXPECT_EQ(history.undo()->parameter, "haze");
  EXPECT_EQ(history.undo()->after, Value(2.0));
  EXPECT_FALSE(history.undo());
}

TEST(Panel, TellsCheapChangesFromDear) {
  EXPECT_EQ(cost_of("picture"), ChangeCost::picture);
  EXPECT_EQ(cost_of("sky"), ChangeCost::light);
  EXPECT_EQ(cost_of("ground"), ChangeCost::ground);
  EXPECT_EQ(cost_of("species.2"), ChangeCost::plants);
  EXPECT_EQ(cost_of("terrain.step.1"), ChangeCost::terrain);
  EXPECT_EQ(cost_of("terrain"), ChangeCost::terrain);
}

TEST(Overlay, TextsOfNumbers) {
  EXPECT_EQ(count_text(850), "850");
  EXPECT_EQ(count_text(12400), "12.4 k");
  EXPECT_EQ(count_text(3100000), "3.1 M");
  EXPECT_EQ(speed_text(0.5), "0.5 m/s");
  EXPECT_EQ(speed_text(1200), "1.2 km/s");
}

/// Frames of the interface over a picture, with a mouse that the test moves.
class PanelOverAPicture : public testing::Test {
 protected:
  static constexpr int width = 1280;
  static constexpr int height = 800;

  PanelOverAPicture() : target_(width, height, formats, false) {
    scene_.emplace(
        parse_scene("[[terrain.step]]\nop = \"ridged\"\n[[terrain.step]]\nop = "
                    "\"droplets\"\n",
                    "scene.toml", {}));
    sections_ = panel_sections(*scene_);
  }

  template <class Draw>
  void frame(const Draw& draw) {
    target_.bind();
    // The stored picture has no sRGB curve: these are display values.
    glClearColor(0.42F, 0.53F, 0.62F, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 0, width, height * 2 / 5);
    glClearColor(0.30F, 0.36F, 0.22F, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    glDisable(GL_SCISSOR_TEST);
    interface_.begin({width, height}, 1.0 / 60);
    draw();
    interface_.end();
    gl::check("drawing the interface");
  }

  std::vector<ParameterChange> panel_frame(Vec2 mouse, bool down) {
    ImGuiIO& io = ImGui::GetIO();
    io.MousePos = {mouse.x, mouse.y};
    io.MouseDown[0] = down;
    std::vector<ParameterChange> changes;
    frame([&] { changes = panel_.draw(sections_, "hills.toml"); });
    return changes;
  }

  Image picture() const {
    const std::vector<float> pixels = target_.read();
    Image image(width, height, {"R", "G", "B"});
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        for (int c = 0; c < 3; ++c)
          image.at(x, height - 1 - y, c) =
              pixels[4 * (static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)) +
                     static_cast<std::size_t>(c)];
    return image;
  }

  /// Kept where WOLD_TEST_PICTURES names a folder, for eyes.
  void keep(const std::string& name) const {
    if (const char* folder = std::getenv("WOLD_TEST_PICTURES"))
      write_png(std::string(folder) + "/" + name, picture(), {.bits = 8, .srgb = true});
  }

  static constexpr std::array formats{PixelFormat::rgba8};
  OffscreenContext context_;
  GpuTarget target_;
  Interface interface_;
  ParameterPanel panel_;
  std::optional<Scene> scene_;
  std::vector<PanelSection> sections_;
};

TEST_F(PanelOverAPicture, DrawsAllThatThereIs) {
  Messages messages;
  messages.error("scene",
                 "scene.toml:12:9: 'turbidity' in 'sky' is 40, but must be a number, "
                 "1.9 to 10");
  messages.notice("The camera is in the clipboard.");
  const std::array tasks{Task{"Path tracing", "12 of 64 samples, 40 s left", 0.19, true}};
  StatusLine status;
  status.frames_per_second = 58;
  status.milliseconds = 17.2;
  status.triangles = 3145728;
  status.position = {1200, -340, 512};
  status.height = 14.2;
  status.speed = 28;
  status.sun_elevation = 32.4;
  status.sun_azimuth = 251;
  status.time = "16:30";
  status.exposure = 0.25;
  for (int k = 0; k < 3; ++k)
    frame([&] {
      panel_.draw(sections_, "hills.toml");
      messages.draw(1.0 / 60, panel_.width());
      draw_tasks(tasks, panel_.width());
      draw_status(status);
    });
  keep("panel.png");
  const Image image = picture();
  EXPECT_LT(image.at(300, 500, 2), 0.3F);             // the panel is dark
  EXPECT_NEAR(image.at(1000, 300, 2), 0.62F, 0.01F);  // the picture is itself
  EXPECT_GT(image.at(850, 20, 0), 0.4F);              // the error is red
  EXPECT_LT(image.at(850, 20, 1), 0.3F);
  EXPECT_TRUE(messages.has_errors());
  messages.solved("scene");
  EXPECT_FALSE(messages.has_errors());
}

TEST_F(PanelOverAPicture, DrawsColoursAndTheParametersOfOperators) {
  std::vector<PanelSection> some;
  for (PanelSection& section : sections_) {
    section.open = true;
    if (section.name == "ground" || section.name == "terrain.step.0") some.push_back(section);
  }
  ASSERT_EQ(some.size(), 2U);
  for (int k = 0; k < 3; ++k) frame([&] { panel_.draw(some, "hills.toml"); });
  keep("ground.png");
}

TEST_F(PanelOverAPicture, DrawsTheHelp) {
  bool open = true;
  for (int k = 0; k < 3; ++k) frame([&] { draw_help(open); });
  keep("help.png");
  EXPECT_LT(picture().at(640, 400, 2), 0.5F);
  EXPECT_TRUE(open);
}

TEST_F(PanelOverAPicture, EveryParameterOfASceneCanBeDrawn) {
  for (PanelSection& section : sections_) section.open = true;
  std::vector<ParameterChange> changes;
  for (int k = 0; k < 3; ++k) changes = panel_frame({-1, -1}, false);
  EXPECT_TRUE(changes.empty());
  keep("all_open.png");
}

TEST_F(PanelOverAPicture, ADraggedSliderTellsAndIsUndone) {
  // Sliders are sought from the top; the first one found at this column is dragged.
  const float before = scene_->sky.turbidity;
  for (int k = 0; k < 3; ++k) panel_frame({-1, -1}, false);
  std::vector<ParameterChange> told;
  for (float y = 126; y < 760 && told.empty(); y += 9) {
    panel_frame({250, y}, false);
    panel_frame({250, y}, true);
    const auto dragged = panel_frame({330, y}, true);
    if (!dragged.empty()) {
      EXPECT_FALSE(dragged[0].finished);
    }
    told = panel_frame({330, y}, false);
    panel_frame({-1, -1}, false);
    if (!told.empty() && told[0].parameter != "turbidity") told.clear();
  }
  ASSERT_EQ(told.size(), 1U);
  EXPECT_TRUE(told[0].finished);
  EXPECT_EQ(told[0].section, "sky");
  EXPECT_EQ(told[0].before, Value(static_cast<double>(before)));
  EXPECT_NE(scene_->sky.turbidity, before);
  keep("dragged.png");
  const float after = scene_->sky.turbidity;
  const auto back = panel_.undo(sections_);
  ASSERT_TRUE(back);
  EXPECT_EQ(scene_->sky.turbidity, before);
  panel_.redo(sections_);
  EXPECT_EQ(scene_->sky.turbidity, after);
}

TEST_F(PanelOverAPicture, SurvivesATinyWindow) {
  bool open = true;
  for (const IVec2 size : {IVec2(1, 1), IVec2(0, 0), IVec2(90, 30)}) {
    target_.bind();
    interface_.begin(size, 0);
    panel_.draw(sections_, "hills.toml");
    draw_help(open);
    draw_status({});
    draw_tasks(std::array{Task{"Erosion", "", -1, true}});
    interface_.end();
  }
  gl::check("drawing a tiny interface");
}

}  // namespace
}  // namespace wold
