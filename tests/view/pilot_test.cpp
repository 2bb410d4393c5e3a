#include "view/pilot.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "scene/scene.hpp"
#include "view/recording.hpp"

namespace wold {
namespace {

Controls frame(double seconds, std::initializer_list<Action> held) {
  Controls controls;
  controls.seconds = seconds;
  for (const Action action : held) controls.held.add(action);
  return controls;
}

Controls press(Action action) {
  Controls controls;
  controls.pressed.add(action);
  return controls;
}

Pilot many(Pilot pilot, const Controls& controls, int count, const PilotWorld& world = {}) {
  for (int k = 0; k < count; ++k) pilot = flown(pilot, controls, world);
  return pilot;
}

TEST(Pilot, TenShortFramesAreOneLongOne) {
  Pilot start;
  start.position = {100, -50, 300};
  start.velocity = {-3, 8, 1};
  start.yaw = 0.7;
  start.pitch = -0.4;
  const auto keys = {Action::forward, Action::right, Action::up, Action::faster};
  const Pilot once = flown(start, frame(0.1, keys), {});
  const Pilot often = many(start, frame(0.01, keys), 10);
  EXPECT_LT(glm::length(once.position - often.position), 1e-9);
  EXPECT_LT(glm::length(once.velocity - often.velocity), 1e-9);
}

TEST(Pilot, ReachesItsSpeedAndStops) {
  Pilot pilot;
  pilot.speed = 12;
  pilot = many(pilot, frame(0.02, {Action::forward}), 200);
  EXPECT_NEAR(glm::length(pilot.velocity), 12, 1e-6);
  EXPECT_NEAR(pilot.velocity.y, 12, 1e-6);  // yaw 0 is north
  const double before = pilot.position.y;
  pilot = many(pilot, frame(0.02, {}), 400);
  EXPECT_EQ(pilot.velocity, DVec3(0));
  EXPECT_NEAR(pilot.position.y - before, 12 * 0.18, 1e-4);  // ∫ v e^(-t/τ) dt = v τ
}

TEST(Pilot, KeysGoWhereTheySayAndShiftIsSixTimesAsFast) {
  const auto speed = [](std::initializer_list<Action> keys) {
    Pilot pilot;
    pilot.yaw = pi_d / 2;  // east
    return many(pilot, frame(0.05, keys), 100).velocity;
  };
  const auto near = [](const DVec3& a, const DVec3& b) { return glm::length(a - b) < 1e-6; };
  EXPECT_TRUE(near(speed({Action::forward}), {10, 0, 0}));
  EXPECT_TRUE(near(speed({Action::backward}), {-10, 0, 0}));
  EXPECT_TRUE(near(speed({Action::left}), {0, 10, 0}));
  EXPECT_TRUE(near(speed({Action::right}), {0, -10, 0}));
  EXPECT_TRUE(near(speed({Action::up}), {0, 0, 10}));
  EXPECT_TRUE(near(speed({Action::down}), {0, 0, -10}));
  EXPECT_TRUE(near(speed({Action::forward, Action::faster}), {60, 0, 0}));
  EXPECT_TRUE(near(speed({Action::forward, Action::slower}), {10.0 / 6, 0, 0}));
  EXPECT_TRUE(near(speed({Action::forward, Action::backward}), {0, 0, 0}));
  EXPECT_NEAR(glm::length(speed({Action::forward, Action::left})), 10, 1e-6);
}

TEST(Pilot, TheMiddleOfThePictureFollowsTheMouse) {
  Pilot pilot;
  pilot.field_of_view = 60;
  Controls controls;
  controls.look = {1e-3F, 0};  // of the picture's width
  const double turned = flown(pilot, controls, {}).yaw;
  const CameraRays rays(camera_of(pilot), 1000, 500);
  EXPECT_NEAR(turned, rays.pixel_angle(), 1e-3 * turned);
  controls.look = {0, 100};
  EXPECT_NEAR(flown(pilot, controls, {}).pitch, -radians(89.0), 1e-12);
  controls.look = {0, -100};
  const Camera up = camera_of(flown(pilot, controls, {}));
  EXPECT_LT(up.direction.z, 1);
  EXPECT_EQ(up.up, Vec3(0, 0, 1));
}

TEST(Pilot, WheelChangesSpeedAndWithZTheView) {
  Pilot pilot;
  Controls controls;
  controls.wheel = 1;
  EXPECT_DOUBLE_EQ(flown(pilot, controls, {}).speed, 12.5);
  controls.wheel = 100;
  EXPECT_DOUBLE_EQ(flown(pilot, controls, {}).speed, 2000);
  controls.wheel = -100;
  EXPECT_DOUBLE_EQ(flown(pilot, controls, {}).speed, 0.5);
  controls.held.add(Action::zoom);
  controls.wheel = 2;
  const Pilot zoomed = flown(pilot, controls, {});
  EXPECT_DOUBLE_EQ(zoomed.speed, pilot.speed);
  EXPECT_LT(zoomed.field_of_view, pilot.field_of_view);
  controls.wheel = 1000;
  EXPECT_DOUBLE_EQ(flown(pilot, controls, {}).field_of_view, 5);
}

float hill(DVec2 place) {
  return static_cast<float>(40 * std::sin(place.x / 30) + 20 * std::cos(place.y / 20));
}

TEST(Pilot, NeverDivesIntoTheGround) {
  const PilotWorld world{.ground = hill, .cameras = {}};
  Pilot pilot;
  pilot.position = {0, 0, 80};
  pilot.pitch = -0.5;
  pilot.speed = 150;
  for (int k = 0; k < 300; ++k) {
    pilot = flown(pilot, frame(0.02, {Action::forward}), world);
    ASSERT_GE(pilot.position.z, hill(DVec2(pilot.position)) + least_height - 1e-6);
  }
}

TEST(Pilot, WalksAtEyeHeightAndFliesAgain) {
  const PilotWorld world{.ground = hill, .cameras = {}};
  Pilot pilot;
  pilot.position = {10, 10, 200};
  pilot = flown(pilot, press(Action::walk), world);
  ASSERT_TRUE(pilot.walking);
  pilot = many(pilot, frame(0.02, {}), 200, world);
  EXPECT_NEAR(pilot.position.z, hill({10, 10}) + eye_height, 1e-3);
  pilot.pitch = 0.9;  // looking up does not lift a walker
  pilot = many(pilot, frame(0.02, {Action::forward, Action::up}), 200, world);
  EXPECT_NEAR(pilot.position.z, hill(DVec2(pilot.position)) + eye_height, 0.5);
  EXPECT_GT(pilot.position.y, 15);
  EXPECT_FALSE(flown(pilot, press(Action::walk), world).walking);
}

TEST(Pilot, GoesToTheCamerasOfTheScene) {
  std::array<Camera, 2> cameras;
  cameras[1].position = {500, 600, 70};
  cameras[1].direction = glm::normalize(Vec3(1, -1, -0.3F));
  cameras[1].field_of_view = 35;
  cameras[1].aperture = 0.02F;
  const PilotWorld world{.ground = nullptr, .cameras = cameras};
  Pilot pilot = flown({}, press(Action::camera_2), world);
  const Camera seen = camera_of(pilot);
  EXPECT_EQ(seen.position, cameras[1].position);
  EXPECT_LT(glm::length(seen.direction - cameras[1].direction), 1e-6F);
  EXPECT_EQ(seen.field_of_view, 35);
  EXPECT_EQ(seen.aperture, 0.02F);
  EXPECT_EQ(pilot.camera, 1);
  pilot = many(pilot, frame(0.1, {Action::forward}), 10, world);
  EXPECT_EQ(camera_of(flown(pilot, press(Action::home), world)).position, cameras[1].position);
  EXPECT_EQ(flown(pilot, press(Action::camera_9), world), pilot);  // there is none
}

TEST(Pilot, StartsAtASpeedForItsHeight) {
  const PilotWorld flat{.ground = [](DVec2) { return 0.0F; }, .cameras = {}};
  Camera camera;
  camera.position = {0, 0, 2};
  const double low = pilot_at(camera, flat).speed;
  camera.position = {0, 0, 200};
  EXPECT_GT(pilot_at(camera, flat).speed, 10 * low);
}

TEST(Pilot, ItsCameraReadsBackFromToml) {
  Camera camera;
  camera.position = {1234.5F, -20.25F, 88};
  camera.direction = glm::normalize(Vec3(0.3F, 0.9F, -0.2F));
  camera.field_of_view = 42.5F;
  camera.aperture = 0.05F;
  camera.focus = 12;
  const Scene scene = parse_scene(camera_toml(camera, "from here"), "copied", {});
  const Ground ground({.height = Grid<float>(2, 2), .origin = {0, 0}, .cell = 1000}, {}, {}, 1);
  const Camera back = placed_camera(ground, scene.camera("from here"));
  EXPECT_LT(glm::length(back.position - camera.position), 0.01F);
  EXPECT_LT(glm::length(back.direction - camera.direction), 1e-4F);
  EXPECT_FLOAT_EQ(back.field_of_view, camera.field_of_view);
  EXPECT_FLOAT_EQ(back.focus, camera.focus);
}

TEST(Recording, RoundTripIsBitForBit) {
  std::vector<Controls> frames;
  for (int k = 0; k < 200; ++k) {
    Controls controls = frame(0.016 + 1e-5 * std::sin(k), {});
    if (k % 3 == 0) controls.held.add(Action::forward);
    if (k % 7 == 0) controls.held.add(Action::faster);
    if (k == 50) controls.pressed.add(Action::walk);
    if (k % 5 == 0) controls.look = {std::sin(static_cast<float>(k)) / 77, 1.0F / 3};
    if (k % 11 == 0) controls.wheel = 0.1F;
    frames.push_back(controls);
  }
  const std::string file = testing::TempDir() + "flight.txt";
  {
    Recorder recorder(file);
    for (const Controls& controls : frames) recorder.add(controls);
  }
  const std::vector<Controls> back = read_recording(file);
  ASSERT_EQ(back, frames);
  const PilotWorld world{.ground = hill, .cameras = {}};
  Pilot a;
  Pilot b;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    a = flown(a, frames[k], world);
    b = flown(b, back[k], world);
    ASSERT_EQ(a, b);
  }
  EXPECT_GT(glm::length(a.position), 1);
}

TEST(Recording, MistakesAreNamedWithFileAndLine) {
  const auto message = [](const std::string& text) {
    try {
      parse_recording(text, "flight.txt");
    } catch (const Error& error) {
      return error.location().text() + ": " + error.message();
    }
    return std::string("none");
  };
  const std::string head = "wold recording 1\n0.01\n";
  EXPECT_EQ(message(head), "none");
  EXPECT_EQ(message(""),
            "flight.txt:1: this is no recording: the first line must be "
            "'wold recording 1'");
  EXPECT_EQ(message(head + "x\n"), "flight.txt:3: 'x' is not a number");
  EXPECT_EQ(message(head + "-1\n"), "flight.txt:3: a frame begins with its seconds, 0 or more");
  EXPECT_EQ(message(head + "0.1 look=1,nan\n"), "flight.txt:3: 'nan' is not a number");
  EXPECT_EQ(message(head + "0.1 whel=1\n"), "flight.txt:3: unknown 'whel'. Did you mean 'wheel'?");
  EXPECT_NE(message(head + "0.1 held=forwad\n").find("'forward'"), std::string::npos);
}

TEST(Recording, AFolderIsNoFile) {
  EXPECT_THROW(Recorder recorder(testing::TempDir()), Error);
  EXPECT_THROW(read_recording(testing::TempDir() + "no such recording"), Error);
}

}  // namespace
}  // namespace wold
