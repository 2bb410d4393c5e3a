#include "view/window.hpp"

#include <epoxy/gl.h>
#include <gtest/gtest.h>
#include <imgui.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <string>

#include "base/error.hpp"
#include "gpu/objects.hpp"
#include "view/window_events.hpp"
#include "virtual_desktop.hpp"

namespace wold {
namespace {

using testing::VirtualDesktop;

using Change = WindowEvents::Change;

TEST(WindowEvents, KeysAreHeldUntilTheyAreLetGo) {
  WindowEvents events;
  events.key("W", false, Change::down);
  Controls controls = events.take(0.02);
  EXPECT_EQ(controls.seconds, 0.02);
  EXPECT_TRUE(controls.held.has(Action::forward));
  EXPECT_TRUE(controls.pressed.has(Action::forward));
  controls = events.take(0.02);
  EXPECT_TRUE(controls.held.has(Action::forward));
  EXPECT_TRUE(controls.pressed.empty());
  events.key("Up", false, Change::down);
  events.key("W", false, Change::up);
  EXPECT_TRUE(events.take(0.02).held.has(Action::forward));  // the other key still holds it
  events.key("Up", false, Change::up);
  EXPECT_TRUE(events.take(0.02).held.empty());
}

TEST(WindowEvents, ATapWithinAFrameCounts) {
  WindowEvents events;
  events.key("P", false, Change::down);
  events.key("P", false, Change::up);
  const Controls controls = events.take(0.02);
  EXPECT_TRUE(controls.pressed.has(Action::path_trace));
  EXPECT_TRUE(controls.held.empty());
}

TEST(WindowEvents, OnlySomeKeysRepeatAndNoneWhileTyping) {
  WindowEvents events;
  events.key("H", false, Change::repeat);
  events.key("W", false, Change::down, true);
  EXPECT_EQ(events.take(0), Controls{});
  events.key("+", false, Change::repeat);
  EXPECT_TRUE(events.take(0).pressed.has(Action::brighter));
  events.key("Z", true, Change::down);
  const Controls undo = events.take(0);
  EXPECT_TRUE(undo.pressed.has(Action::undo));
  EXPECT_FALSE(undo.pressed.has(Action::zoom));
}

TEST(WindowEvents, TheMouseLooksOnlyWhileAButtonHoldsTheView) {
  WindowEvents events;
  events.mouse_moved({0.1F, 0});
  EXPECT_EQ(events.take(0).look, Vec2(0));
  events.button(0, true, true);  // on the panel
  EXPECT_FALSE(events.looking());
  events.button(1, true, false);
  events.mouse_moved({0.1F, 0});
  events.mouse_moved({0.1F, 0.2F});
  EXPECT_EQ(events.take(0).look, Vec2(0.2F, 0.2F));
  events.wheel(1, true);
  EXPECT_EQ(events.take(0).wheel, 0);
  events.wheel(1, false);
  EXPECT_EQ(events.take(0).wheel, 1);
}

TEST(WindowEvents, LosingTheFocusLetsGoOfEverything) {
  WindowEvents events;
  events.key("W", false, Change::down);
  events.button(0, true, false);
  events.focus_lost();
  EXPECT_FALSE(events.looking());
  EXPECT_TRUE(events.take(0).held.empty());
}

TEST(WindowEvents, FlyingGoesByPlaceAndCommandsByWhatIsPrinted) {
  EXPECT_EQ(key_for("W", "W"), "W");
  EXPECT_EQ(key_for("W", "Z"), "W");  // French: W A S D lie where Z Q S D are printed
  EXPECT_EQ(key_for("Z", "W"), "Z");
  EXPECT_EQ(key_for("Y", "Z"), "Z");  // German and Czech
  EXPECT_EQ(key_for("Z", "Y"), "Y");
  EXPECT_EQ(key_for("1", "+"), "1");  // Czech
  EXPECT_EQ(key_for("[", "Ú"), "[");
  EXPECT_EQ(key_for("]", "+"), "+");  // German
  EXPECT_EQ(key_for("F5", ""), "F5");
}

TEST(Window, WithoutADesktopSaysWhatHelps) {
  ::unsetenv("DISPLAY");
  ::unsetenv("WAYLAND_DISPLAY");
  try {
    const Window window;
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::limit);
    EXPECT_NE(error.message().find("DISPLAY"), std::string::npos);
    EXPECT_NE(error.message().find("--screenshot"), std::string::npos);
  }
}

Vec3 pixel_shown(IVec2 at) {
  std::array<float, 4> rgba{};
  glReadPixels(at.x, at.y, 1, 1, GL_RGBA, GL_FLOAT, rgba.data());
  return {rgba[0], rgba[1], rgba[2]};
}

/// Polls until the window has this size: a desktop takes its time.
bool becomes(Window& window, IVec2 size) {
  for (int k = 0; k < 200; ++k) {
    window.poll();
    if (window.size() == size) return true;
    ::usleep(5000);
  }
  return false;
}

TEST(Window, OpensDrawsResizesAndCloses) {
  const VirtualDesktop desktop;
  if (!desktop.there()) GTEST_SKIP() << "Xvfb is not installed: 'apt install xvfb'";
  Window window({.title = "test", .width = 320, .height = 200, .vsync = false});
  EXPECT_GE(window.gpu().major * 10 + window.gpu().minor, 33);
  ASSERT_TRUE(becomes(window, {320, 200}));
  for (const IVec2 size : {IVec2(320, 200), IVec2(1, 1), IVec2(640, 400)}) {
    window.resize(size);
    ASSERT_TRUE(becomes(window, size));
    const Controls controls = window.poll();
    EXPECT_GE(controls.seconds, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, size.x, size.y);
    glClearColor(0, 0.5F, 1, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    window.interface().begin(window.size(), controls.seconds);
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize({100, 100});
    ImGui::Begin("panel");
    ImGui::End();
    window.interface().end();
    gl::check("drawing into a window");
    if (size.x == 640) {
      EXPECT_NEAR(pixel_shown({600, 50}).y, 0.5F, 0.01F);
      EXPECT_LT(pixel_shown({50, 350}).z, 0.5F);  // the interface is dark
    }
    window.show();
  }
  window.set_clipboard("[[camera]]");
  EXPECT_EQ(window.clipboard(), "[[camera]]");
  window.set_title("another");
  EXPECT_FALSE(window.closing());
  window.close();
  EXPECT_TRUE(window.closing());
}

TEST(Window, FillsTheScreenAndIsAWindowAgain) {
  const VirtualDesktop desktop;
  if (!desktop.there()) GTEST_SKIP() << "Xvfb is not installed: 'apt install xvfb'";
  Window window({.title = "test", .width = 320, .height = 200, .vsync = false});
  ASSERT_TRUE(becomes(window, {320, 200}));
  window.toggle_full_screen();
  EXPECT_TRUE(becomes(window, {800, 600}));
  window.toggle_full_screen();
  EXPECT_TRUE(becomes(window, {320, 200}));
}

}  // namespace
}  // namespace wold
