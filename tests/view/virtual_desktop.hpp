#pragma once
// A desktop that nobody sees (Xvfb).

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <string>

namespace wold::testing {

/// A display of its own for the test.
class VirtualDesktop {
 public:
  VirtualDesktop() {
    std::array<int, 2> pipe{};
    if (::pipe(pipe.data()) != 0) return;
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addclose(&actions, pipe[0]);
    posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
    std::string fd = std::to_string(pipe[1]);
    std::array<std::string, 8> words{"Xvfb", "-displayfd", fd,          "-screen",
                                     "0",    "800x600x24", "-nolisten", "tcp"};
    std::array<char*, 9> arguments{};
    for (std::size_t k = 0; k < words.size(); ++k) arguments[k] = words[k].data();
    if (posix_spawnp(&pid_, "Xvfb", &actions, nullptr, arguments.data(), environ) != 0) pid_ = 0;
    posix_spawn_file_actions_destroy(&actions);
    ::close(pipe[1]);
    std::string number;
    char letter = 0;
    while (pid_ != 0 && ::read(pipe[0], &letter, 1) == 1 && letter != '\n') number += letter;
    ::close(pipe[0]);
    if (!number.empty()) ::setenv("DISPLAY", (":" + number).c_str(), 1);
    there_ = !number.empty();
  }
  ~VirtualDesktop() {
    if (pid_ == 0) return;
    ::kill(pid_, SIGTERM);
    ::waitpid(pid_, nullptr, 0);
    ::unsetenv("DISPLAY");
  }
  VirtualDesktop(const VirtualDesktop&) = delete;
  VirtualDesktop& operator=(const VirtualDesktop&) = delete;
  bool there() const { return there_; }

 private:
  pid_t pid_ = 0;
  bool there_ = false;
};

}  // namespace wold::testing
