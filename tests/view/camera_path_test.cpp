#include "view/camera_path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "base/error.hpp"
#include "image/atomic_file.hpp"
#include "view/path_curves.hpp"

namespace wold {
namespace {

CameraKey key(double time, const DVec3& position, const DVec3& direction) {
  CameraKey k;
  k.time = time;
  k.position = position;
  k.direction = glm::normalize(direction);
  return k;
}

float distance(const Vec3& a, const DVec3& b) {
  return glm::length(a - Vec3(b));
}

const CameraPath winding{{key(0, {0, 0, 10}, {0, 1, 0}), key(2, {100, 20, 30}, {1, 0.2, -0.3}),
                          key(3, {110, 90, 30}, {0, -1, 0}),
                          key(9, {-300, 50, 200}, {-1, 0, 0.5})}};

TEST(CameraPath, PassesThroughItsKeys) {
  for (const CameraKey& k : winding.keys) {
    const Camera camera = camera_at(winding, k.time).camera;
    EXPECT_LT(distance(camera.position, k.position), 1e-4F);
    EXPECT_LT(distance(camera.direction, *k.direction), 1e-5F);
    EXPECT_EQ(camera.up, Vec3(0, 0, 1));  // no roll
  }
  EXPECT_LT(distance(camera_at(winding, -5).camera.position, winding.keys[0].position), 1e-4F);
  EXPECT_LT(distance(camera_at(winding, 99).camera.position, winding.keys[3].position), 1e-3F);
}

TEST(CameraPath, HasConstantSpeedOnAStraightLineOfEqualKeys) {
  CameraPath path;
  for (int k = 0; k < 4; ++k) path.keys.push_back(key(2 * k, {30 * k, 0, 5}, {1, 0, 0}));
  for (double t = 0; t <= 6; t += 0.1)
    EXPECT_LT(distance(camera_at(path, t).camera.position, {15 * t, 0, 5}), 1e-4F);
}

TEST(CameraPath, IsSmooth) {
  // The velocity from the left of each key is that from the right.
  for (const double t : {2.0, 3.0}) {
    const double h = 1e-3;
    const auto at = [&](double s) { return camera_at(winding, s).camera; };
    const Vec3 left = (at(t).position - at(t - h).position) / static_cast<float>(h);
    const Vec3 right = (at(t + h).position - at(t).position) / static_cast<float>(h);
    EXPECT_LT(glm::length(left - right), 0.03F * glm::length(left) + 0.3F);
    const Vec3 turn_left = (at(t).direction - at(t - h).direction) / static_cast<float>(h);
    const Vec3 turn_right = (at(t + h).direction - at(t).direction) / static_cast<float>(h);
    EXPECT_LT(glm::length(turn_left - turn_right), 0.03F);
  }
}

TEST(CameraPath, IsTheSameBackward) {
  CameraPath back;
  for (std::size_t k = winding.keys.size(); k-- > 0;) {
    back.keys.push_back(winding.keys[k]);
    back.keys.back().time = winding.end() - winding.keys[k].time;
  }
  for (double t = 0.05; t < 9; t += 0.1) {
    const Camera there = camera_at(winding, t).camera;
    const Camera again = camera_at(back, winding.end() - t).camera;
    EXPECT_LT(glm::length(there.position - again.position), 1e-3F) << t;
    EXPECT_LT(glm::length(there.direction - again.direction), 1e-5F) << t;
  }
}

TEST(CameraPath, StandsStillBetweenEqualKeys) {
  const CameraPath path{{key(0, {0, 0, 0}, {1, 0, 0}), key(1, {10, 0, 0}, {1, 0, 0}),
                         key(2, {10, 0, 0}, {0, 1, 0}), key(3, {10, 20, 0}, {0, 1, 0})}};
  for (double t = 1; t <= 2; t += 0.125)
    EXPECT_LT(distance(camera_at(path, t).camera.position, {10, 0, 0}), 1e-5F);
}

TEST(CameraPath, TurnsEvenlyRoundAtEqualAngles) {
  CameraPath path;
  for (int k = 0; k < 5; ++k)
    path.keys.push_back(key(k, {0, 0, 0}, {std::sin(0.5 * k), std::cos(0.5 * k), 0}));
  for (double t = 0; t <= 4; t += 0.1)
    EXPECT_LT(
        distance(camera_at(path, t).camera.direction, {std::sin(0.5 * t), std::cos(0.5 * t), 0}),
        1e-5F);
}

TEST(CameraPath, KeepsItsEyeOnACommonTarget) {
  CameraPath path;
  for (int k = 0; k < 4; ++k) {
    CameraKey one;
    one.time = k;
    one.position = {100 * std::cos(k), 100 * std::sin(k), 20 + 9 * k};
    one.target = DVec3(3, 4, 5);
    path.keys.push_back(one);
  }
  for (double t = 0; t <= 3; t += 0.1) {
    const Camera camera = camera_at(path, t).camera;
    EXPECT_LT(glm::length(camera.direction - glm::normalize(Vec3(3, 4, 5) - camera.position)),
              1e-5F);
  }
}

TEST(CameraPath, WhatFewKeysGiveRunsMonotonicallyBetweenThem) {
  CameraPath path = winding;
  path.keys[0].hour = 6;
  path.keys[3].hour = 20;
  path.keys[1].exposure = 1;
  EXPECT_EQ(camera_at(path, 0).hour, 6);
  EXPECT_EQ(camera_at(path, 4.5).hour, 13);
  EXPECT_EQ(camera_at(path, 9).hour, 20);
  EXPECT_EQ(camera_at(path, 7).exposure, 1);
  EXPECT_FALSE(camera_at(path, 7).sun);
  const std::vector<double> times{0, 1, 2, 5, 6};
  const std::vector<double> values{0, 10, 10, 11, 40};
  double last = 0;
  for (double t = 0; t <= 6; t += 0.01) {
    const double value = monotone_at(times, values, t);
    EXPECT_GE(value, last - 1e-9);
    last = value;
  }
}

TEST(CameraPath, OppositeDirectionsTurnByTheHorizon) {
  const DVec3 half = arc({0, 1, 0}, {0, -1, 0}, 0.5);
  EXPECT_NEAR(half.z, 0, 1e-12);
  EXPECT_NEAR(std::abs(half.x), 1, 1e-12);
  EXPECT_NEAR(glm::length(arc({0, 0, 1}, {0, 0, -1}, 0.5)), 1, 1e-12);
}

TEST(CameraPath, IsReadFromToml) {
  const CameraPath path = parse_camera_path(
      "[[key]]\ntime = 0\nposition = [1, 2, 3]\ntarget = [1, 9, 3]\n"
      "[[key]]\ntime = 4\nposition = [5, 2, 3]\nlook_direction = [0, 2, 0]\nsun = [30, 200]\n",
      "path.toml");
  ASSERT_EQ(path.keys.size(), 2U);
  EXPECT_EQ(path.keys[0].target, DVec3(1, 9, 3));
  EXPECT_EQ(path.keys[1].direction, DVec3(0, 1, 0));
  EXPECT_EQ(path.keys[1].sun, DVec2(30, 200));
  EXPECT_EQ(path.end(), 4);
}

TEST(CameraPath, MistakesAreNamedWithTheirPlace) {
  const auto message = [](const std::string& text) {
    try {
      parse_camera_path(text, "path.toml");
    } catch (const Error& error) {
      return error.location().text() + ": " + error.message();
    }
    return std::string("none");
  };
  const auto has = [&](const std::string& text, const std::string& part) {
    EXPECT_NE(message(text).find(part), std::string::npos) << message(text);
  };
  const std::string good = "[[key]]\ntime = 1\nposition = [0, 0, 0]\nlook_direction = [1, 0, 0]\n";
  EXPECT_EQ(message(good), "none");
  has("", "at least one [[key]]");
  has(good + good, "path.toml:5:1: the times of keys must rise, but 1 s follows 1 s");
  has("[[keys]]\ntime = 1\n", "Did you mean 'key'?");
  has("[[key]]\ntme = 1\n", "path.toml:2:1: unknown parameter 'tme' in 'key'. Did you mean 'time'");
  has("[[key]]\ntime = 1\n", "path.toml:1:1: a [[key]] needs 'position'");
  has("[[key]]\ntime = 1\nposition = [0, 0, 0]\n", "either 'target' or 'look_direction'");
  has(good + "target = [1, 1, 1]\n", "either 'target' or 'look_direction'");
  has("[[key]]\ntime = 1\nposition = [0, 0]\ntarget = [1, 1, 1]\n",
      "path.toml:3:12: 'position' has 2 numbers, but must have 3");
  has("[[key]]\ntime = 1\nposition = [1, 1, 1]\ntarget = [1, 1, 1]\n", "looks nowhere");
  has("key = 3\n", "[[key]]");
}

TEST(CameraPath, KeysAreAppendedAndReadBack) {
  const std::string file = testing::TempDir() + "appended.toml";
  std::filesystem::remove(file);
  EXPECT_EQ(next_key_time(file, {0, 0, 0}), 0);
  CameraKey first = key(0, {1.5, 2, 3}, {0, 1, 0});
  append_key(file, first);
  write_file(file, "# my flight\n" + read_file(file));
  CameraKey second = key(next_key_time(file, {301.5, 2, 3}), {301.5, 2, 3}, {1, 0, 0});
  second.field_of_view = 40;
  second.hour = 18.25;
  second.sun = DVec2(10, 270);
  second.exposure = -0.5;
  append_key(file, second);
  EXPECT_EQ(second.time, 10);
  const CameraPath path = read_camera_path(file);
  ASSERT_EQ(path.keys.size(), 2U);
  EXPECT_EQ(path.keys[0], first);
  EXPECT_EQ(path.keys[1], second);
  EXPECT_TRUE(read_file(file).starts_with("# my flight\n"));
  EXPECT_THROW(append_key(file, second), Error);  // not after the last one
  EXPECT_EQ(read_camera_path(file).keys.size(), 2U);
}

}  // namespace
}  // namespace wold
