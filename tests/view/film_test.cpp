#include "view/film.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "base/error.hpp"
#include "image/atomic_file.hpp"
#include "image/io.hpp"

namespace wold {
namespace {

template <class Act>
std::string message_of(const Act& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.message();
  }
  return "none";
}

std::string fresh_folder(const std::string& name) {
  const std::string folder = testing::TempDir() + name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directory(folder);
  return folder + "/";
}

TEST(FramePattern, NamesFrames) {
  EXPECT_EQ(FramePattern("frame_%04d.png").name(7), "frame_0007.png");
  EXPECT_EQ(FramePattern("frame_%04d.png").name(123456), "frame_123456.png");
  EXPECT_EQ(FramePattern("%d.png").name(0), "0.png");
  EXPECT_EQ(FramePattern("50%%_%02d.png").name(5), "50%_05.png");
}

TEST(FramePattern, SaysWhatIsRight) {
  for (const char* wrong :
       {"frame.png", "%d_%d.png", "%s.png", "%", "frame_%", "%x%d.png", "%04d/frame.png",
        "%0999d.png", "%99d.png", "%4d.png", "%0099d.png", "%n%d.png", ""}) {
    const std::string message = message_of([&] { FramePattern pattern(wrong); });
    EXPECT_NE(message.find("frame_%04d.png"), std::string::npos) << wrong << ": " << message;
  }
}

TEST(FrameRange, IsACountOrFromTo) {
  EXPECT_EQ(parse_frame_range("250"), (FrameRange{0, 250}));
  EXPECT_EQ(parse_frame_range("100:200"), (FrameRange{100, 200}));
  EXPECT_EQ(parse_frame_range("100:200").count(), 100);
  for (const char* wrong : {"", "0", "a", "5:5", "9:3", "-4", "1:2:3", ":", "99999999999", "1.5"})
    EXPECT_NE(message_of([&] { parse_frame_range(wrong); }).find("100:200"), std::string::npos)
        << wrong;
}

TEST(Film, ResumesWithWhatIsMissing) {
  const std::string folder = fresh_folder("resumed");
  const FramePattern pattern(folder + "f%02d.png");
  write_file(pattern.name(1), "picture");
  write_file(pattern.name(2), "");
  EXPECT_EQ(frames_to_make(pattern, {0, 4}, true), (std::vector<int>{0, 2, 3}));
  EXPECT_EQ(frames_to_make(pattern, {0, 4}, false), (std::vector<int>{0, 1, 2, 3}));
}

TEST(Film, SaysWhereFfmpegComesFrom) {
  const char* path = std::getenv("PATH");
  const std::string before = path != nullptr ? path : "";
  ::setenv("PATH", fresh_folder("no programs").c_str(), 1);
  const std::string message = message_of([] {
    check_video_writable(testing::TempDir() + "film.mp4", FramePattern("frame_%04d.png"));
  });
  ::setenv("PATH", before.c_str(), 1);
  EXPECT_NE(message.find("apt install ffmpeg"), std::string::npos) << message;
  EXPECT_EQ(find_program("no such program"), std::nullopt);
}

TEST(Film, IsAVideoOfItsFrames) {
  if (!find_program("ffmpeg")) GTEST_SKIP() << "FFmpeg is not installed: 'apt install ffmpeg'";
  const std::string folder = fresh_folder("a film, 100%; $(odd)");
  const FramePattern pattern(folder.substr(0, folder.find('%')) + "%" +
                             folder.substr(folder.find('%')) + "-f %03d.png");
  const FrameRange range{3, 7};
  Image picture(33, 17, {"R", "G", "B"}, 0.5F);  // odd sizes
  for (int frame = range.first; frame < range.last; ++frame) {
    picture.at(frame, 4, 0) = 1;
    write_png(pattern.name(frame), picture, {.bits = 8, .srgb = true});
  }
  const std::string file = folder + "film.mp4";
  write_video(file, pattern, range);
  const std::string bytes = read_file(file);
  EXPECT_EQ(bytes.substr(4, 4), "ftyp");
  EXPECT_NE(bytes.find("avc1"), std::string::npos);
  EXPECT_LT(bytes.find("moov"), bytes.find("mdat"));  // plays while it is being loaded
}

TEST(Film, WhatCannotBeLeavesNothing) {
  if (!find_program("ffmpeg")) GTEST_SKIP() << "FFmpeg is not installed: 'apt install ffmpeg'";
  const std::string folder = fresh_folder("broken film");
  const FramePattern pattern(folder + "f%d.png");
  const std::string file = folder + "film.mp4";
  EXPECT_NE(message_of([&] {
              write_video(file, pattern, {0, 2});
            }).find("f0.png' is missing"),
            std::string::npos);
  write_file(pattern.name(0), "no picture");
  EXPECT_NE(message_of([&] {
              write_video(file, pattern, {0, 1});
            }).find("ffmpeg' failed"),
            std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(file));
  EXPECT_NE(message_of([&] {
              write_video(folder + "film.avi", pattern, {0, 1});
            }).find(".mp4"),
            std::string::npos);
  EXPECT_NE(message_of([&] {
              write_video(file, FramePattern("f%d.exr"), {0, 1});
            }).find("PNG"),
            std::string::npos);
}

}  // namespace
}  // namespace wold
