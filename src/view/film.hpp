#pragma once
// Films: numbered pictures, of which several machines may make their ranges, and a video of them.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace wold {

/// Names of frames, from a pattern such as "out/frame_%04d.png".
class FramePattern {
 public:
  /// Throws Error(usage), saying what would be right, unless there is exactly one %d or %04d in the
  /// file's name; "%%" stands for a percent sign.
  explicit FramePattern(std::string_view pattern);

  std::string name(int frame) const;
  const std::string& text() const { return text_; }

 private:
  std::string text_;
  std::string before_;
  std::string after_;
  int digits_ = 0;
};

/// Frames from `first` up to but without `last`.
struct FrameRange {
  int first = 0;
  int last = 0;

  int count() const { return last - first; }
  friend bool operator==(const FrameRange&, const FrameRange&) = default;
};

/// "250" is 0:250; "100:200" the frames 100 to 199, so that 0:100 and 100:200 share a film. Throws
/// Error(usage).
FrameRange parse_frame_range(std::string_view text);

/// The frames to make. With `resume` those that are on disk, and not empty, are left out.
std::vector<int> frames_to_make(const FramePattern& pattern, const FrameRange& range, bool resume);

/// A program in PATH, or nothing.
std::optional<std::string> find_program(std::string_view name);

struct VideoSettings {
  double frames_per_second = 25;
  int quality = 18;  ///< x264's constant rate factor: 0 is lossless, 18 nearly looks so, 51 worst
};

/// To be called before long work. Throws Error(usage) for a file that is no .mp4 or frames that are
/// neither PNG nor JPEG, Error(limit) where FFmpeg is missing, Error(io) where it cannot be
/// written.
void check_video_writable(const std::string& file, const FramePattern& pattern);

/// An H.264 video of frames on disk, which any player and browser plays; whole or not at all.
/// Throws as `check_video_writable`, and Error(io) for a missing frame and for what FFmpeg says.
void write_video(const std::string& file, const FramePattern& pattern, const FrameRange& range,
                 const VideoSettings& settings = {});

}  // namespace wold
