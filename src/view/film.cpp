#include "view/film.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <filesystem>

#include "base/error.hpp"
#include "image/atomic_file.hpp"

namespace wold {

namespace {

namespace fs = std::filesystem;

constexpr int most_digits = 12;
constexpr int most_frames = 10'000'000;

// yuv420p halves both sizes: odd ones lose a row or column. Colours as BT.709.
constexpr std::string_view even_size_and_colors =
    "crop=trunc(iw/2)*2:trunc(ih/2)*2,scale=out_color_matrix=bt709,format=yuv420p";

[[noreturn]] void bad_pattern(std::string_view pattern, std::string_view why) {
  throw Error(ErrorKind::usage,
              fmt::format("'{}' {}; names of frames need one place for their number, such as "
                          "frame_%04d.png",
                          pattern, why));
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

int number_of(std::string_view text, std::string_view whole) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || number < 0 ||
      number > most_frames)
    throw Error(ErrorKind::usage,
                fmt::format("'{}' is no range of frames; 250 means the first 250, 100:200 the "
                            "frames from 100 up to 199",
                            whole));
  return number;
}

/// Runs a program without a shell and returns what it wrote to its error stream. Throws Error(io)
/// with that if it fails.
void run_program(const std::string& program, std::vector<std::string> words) {
  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0)
    throw Error(ErrorKind::io, fmt::format("'{}' cannot be run: {}", program, io_reason(errno)));
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, pipe[1], STDERR_FILENO);
  words.insert(words.begin(), program);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t pid = 0;
  const int failed =
      posix_spawn(&pid, program.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(pipe[1]);
  std::string said;
  std::array<char, 4096> part{};
  for (;;) {
    const ssize_t count = failed == 0 ? ::read(pipe[0], part.data(), part.size()) : 0;
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    if (said.size() < 4096) said.append(part.data(), static_cast<std::size_t>(count));
  }
  ::close(pipe[0]);
  if (failed != 0)
    throw Error(ErrorKind::io, fmt::format("'{}' cannot be run: {}", program, io_reason(failed)));
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGINT || WTERMSIG(status) == SIGTERM))
    throw Error(ErrorKind::cancelled, fmt::format("'{}' was stopped", program));
  while (said.ends_with('\n')) said.pop_back();
  throw Error(ErrorKind::io, fmt::format("'{}' failed: {}", program, said));
}

std::string ffmpeg() {
  if (const auto found = find_program("ffmpeg")) return *found;
  throw Error(ErrorKind::limit,
              "a video needs FFmpeg, and no 'ffmpeg' is in PATH. On Debian: 'apt install ffmpeg'. "
              "The frames can be made without it.");
}

}  // namespace

FramePattern::FramePattern(std::string_view pattern) : text_(pattern) {
  const std::size_t file = pattern.rfind('/') == std::string_view::npos ? 0 : pattern.rfind('/');
  bool numbered = false;
  for (std::size_t k = 0; k < pattern.size(); ++k) {
    std::string& part = numbered ? after_ : before_;
    if (pattern[k] != '%') {
      part += pattern[k];
      continue;
    }
    if (k + 1 < pattern.size() && pattern[k + 1] == '%') {
      part += '%';
      ++k;
      continue;
    }
    std::size_t end = k + 1;
    while (end < pattern.size() && is_digit(pattern[end])) ++end;
    if (end >= pattern.size() || pattern[end] != 'd')
      bad_pattern(pattern, "has a % that is no number (%% is a percent sign)");
    if (numbered) bad_pattern(pattern, "has two places for a number");
    if (k < file) bad_pattern(pattern, "has its number in the folder's name");
    if (end > k + 1 && pattern[k + 1] != '0') bad_pattern(pattern, "would have spaces in names");
    if (end - k > 4) bad_pattern(pattern, "wants too many digits");
    for (std::size_t digit = k + 1; digit < end; ++digit)
      digits_ = 10 * digits_ + (pattern[digit] - '0');
    if (digits_ > most_digits) bad_pattern(pattern, "wants too many digits");
    numbered = true;
    k = end;
  }
  if (!numbered) bad_pattern(pattern, "has no number");
}

std::string FramePattern::name(int frame) const {
  std::string number = std::to_string(frame);
  const auto wanted = static_cast<std::size_t>(digits_);
  if (number.size() < wanted) number.insert(0, wanted - number.size(), '0');
  return before_ + number + after_;
}

FrameRange parse_frame_range(std::string_view text) {
  const std::size_t colon = text.find(':');
  FrameRange range;
  if (colon == std::string_view::npos) {
    range.last = number_of(text, text);
  } else {
    range.first = number_of(text.substr(0, colon), text);
    range.last = number_of(text.substr(colon + 1), text);
  }
  if (range.count() < 1)
    throw Error(
        ErrorKind::usage,
        fmt::format("'{}' holds no frames; 100:200 are the frames from 100 up to 199", text));
  return range;
}

std::vector<int> frames_to_make(const FramePattern& pattern, const FrameRange& range, bool resume) {
  std::vector<int> frames;
  for (int frame = range.first; frame < range.last; ++frame) {
    std::error_code missing;
    const auto bytes = fs::file_size(pattern.name(frame), missing);
    if (!resume || missing || bytes == 0) frames.push_back(frame);
  }
  return frames;
}

std::optional<std::string> find_program(std::string_view name) {
  const char* path = std::getenv("PATH");
  std::string_view folders = path != nullptr ? path : "";
  while (!folders.empty()) {
    const std::size_t end = std::min(folders.find(':'), folders.size());
    const std::string file = fmt::format("{}/{}", folders.substr(0, end), name);
    std::error_code ignored;
    if (end > 0 && ::access(file.c_str(), X_OK) == 0 && fs::is_regular_file(file, ignored))
      return file;
    folders.remove_prefix(std::min(end + 1, folders.size()));
  }
  return {};
}

void check_video_writable(const std::string& file, const FramePattern& pattern) {
  const std::vector<std::string> videos{".mp4"};
  check_writable(file, videos);
  const std::string frames = extension_of(pattern.text());
  if (frames != ".png" && frames != ".jpg" && frames != ".jpeg")
    throw Error(ErrorKind::usage,
                fmt::format("a video is made of PNG or JPEG frames, not of '{}'", pattern.text()));
  ffmpeg();
}

void write_video(const std::string& file, const FramePattern& pattern, const FrameRange& range,
                 const VideoSettings& settings) {
  check_video_writable(file, pattern);
  for (const int frame : frames_to_make(pattern, range, true))
    throw Error(ErrorKind::io,
                fmt::format("the frame '{}' is missing; --resume makes it", pattern.name(frame)));
  const std::string program = ffmpeg();
  // A relative name gets "./": nothing that a user calls a file is taken for an option or a
  // protocol.
  const auto plain = [](const std::string& name) {
    return name.starts_with('/') ? name : "./" + name;
  };
  write_atomically(file, [&](const std::string& temporary) {
    run_program(program, {"-nostdin",
                          "-loglevel",
                          "error",
                          "-y",
                          "-framerate",
                          fmt::format("{}", settings.frames_per_second),
                          "-start_number",
                          std::to_string(range.first),
                          "-i",
                          plain(pattern.text()),
                          "-frames:v",
                          std::to_string(range.count()),
                          "-vf",
                          std::string(even_size_and_colors),
                          "-c:v",
                          "libx264",
                          "-crf",
                          std::to_string(settings.quality),
                          "-colorspace",
                          "bt709",
                          "-color_primaries",
                          "bt709",
                          "-color_trc",
                          "bt709",
                          "-movflags",
                          "+faststart",
                          plain(temporary)});
  });
}

}  // namespace wold
