#include "process.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace wold::testing {

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* small_plant = R"(// A stem, two forks, some leaves.
iterations 3
height 5
organ A shape leaf material leaf length 0.8 width 0.5
axiom: F(1)F(1)B
p1: B -> [+(40)F(0.8)~A][-(40)F(0.8)~A]/(90)F(0.5)B
)";

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

int exit_code_of(int status) {
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

double since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// In the child: standard output or error into a file.
void redirect(int descriptor, const std::string& file) {
  const int opened = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (opened < 0 || dup2(opened, descriptor) < 0) _exit(126);
  close(opened);
}

}  // namespace

const char* const small_scene = R"(wold = 1
seed = 3

[terrain]
size = 400
resolution = 65

[surroundings]
resolution = 33

[[terrain.step]]
op = "fbm"
height = 60
feature_size = 200

[[species]]
name = "tree"
plant = "tree.lsys"
height = [4, 6]
models = 2

[[scatter]]
species = { tree = 1 }
density = 0.004

[render]
size = [96, 54]
samples = 4
)";

Workplace::Workplace() {
  std::string name = (fs::temp_directory_path() / "wold-test-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  folder_ = name;
  fs::create_directory(temporary(""));
  write("scene.toml", small_scene);
  write("tree.lsys", small_plant);
}

Workplace::~Workplace() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
  fs::remove_all(temporary(""), ignored);
  for (const char* stream : {".out", ".err"}) fs::remove(folder_.string() + stream, ignored);
}

fs::path Workplace::temporary(const std::string& name) const {
  return fs::path(folder_.string() + ".tmp") / name;
}

void Workplace::write(const std::string& name, const std::string& text) const {
  std::ofstream(path(name), std::ios::binary) << text;
}

std::string Workplace::read(const std::string& name) const {
  return text_of(path(name));
}

std::string Workplace::files() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder_))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : " ") + name;
  return all;
}

pid_t Workplace::start(const std::vector<std::string>& arguments, const std::string& out,
                       const std::string& err) const {
  std::vector<std::string> words{WOLD_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot start a process");
  if (child > 0) return child;
  redirect(STDOUT_FILENO, out);
  redirect(STDERR_FILENO, err);
  if (chdir(folder_.c_str()) != 0) _exit(126);
  setenv("TMPDIR", temporary("").c_str(), 1);
  execv(WOLD_PROGRAM, pointers.data());
  _exit(127);
}

Outcome Workplace::run(const std::vector<std::string>& arguments, const std::string& stdout_to,
                       const std::string& stderr_to) const {
  const std::string out = stdout_to.empty() ? folder_.string() + ".out" : stdout_to;
  const std::string err = stderr_to.empty() ? folder_.string() + ".err" : stderr_to;
  const auto begun = Clock::now();
  int status = 0;
  waitpid(start(arguments, out, err), &status, 0);
  return {exit_code_of(status), stdout_to.empty() ? text_of(out) : "",
          stderr_to.empty() ? text_of(err) : "", since(begun)};
}

Outcome Workplace::run_with_files_up_to(std::size_t bytes,
                                        const std::vector<std::string>& arguments) const {
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{bytes, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);  // the program inherits it, and that the signal is ignored
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  Outcome outcome = run(arguments);
  std::signal(SIGXFSZ, handler);
  setrlimit(RLIMIT_FSIZE, &before);
  return outcome;
}

Outcome Workplace::interrupt(const std::vector<std::string>& arguments, int signal,
                             const std::string& sign, double seconds) const {
  return act(arguments, sign, seconds, [&](pid_t child) { kill(child, signal); });
}

Outcome Workplace::during(const std::vector<std::string>& arguments, const std::string& sign,
                          const std::function<void()>& action) const {
  return act(arguments, sign, 0, [&](pid_t) { action(); });
}

Outcome Workplace::act(const std::vector<std::string>& arguments, const std::string& sign,
                       double seconds, const Action& action) const {
  const std::string out = folder_.string() + ".out";
  const std::string err = folder_.string() + ".err";
  const pid_t child = start(arguments, out, err);
  const auto begun = Clock::now();
  int status = 0;
  const auto ready = [&] {
    if (since(begun) < seconds) return false;
    // A sign that never comes must not hang the tests.
    if (since(begun) > 60) return true;
    return sign.empty() || text_of(err).find(sign) != std::string::npos;
  };
  while (!ready()) {
    if (waitpid(child, &status, WNOHANG) == child)
      return {exit_code_of(status), text_of(out), text_of(err), 0};
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  const auto acted = Clock::now();
  action(child);
  waitpid(child, &status, 0);
  return {exit_code_of(status), text_of(out), text_of(err), since(acted)};
}

}  // namespace wold::testing
