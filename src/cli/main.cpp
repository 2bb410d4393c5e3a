#include <fmt/format.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "cli/commands.hpp"
#include "cli/session.hpp"

namespace {

constexpr int exit_failed = 1;
constexpr int exit_usage = 2;
constexpr int exit_interrupted = 130;

// A signal handler can reach nothing but a global.
std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free);

extern "C" void on_interrupt(int) {
  // The second time somebody is in earnest.
  if (interrupted.exchange(true)) _exit(exit_interrupted);
}

void complain(const std::string& message) {
  wold::write_error(message + "\n");
}

int exit_code(const wold::Error& error) {
  switch (error.kind()) {
    case wold::ErrorKind::usage: return exit_usage;
    case wold::ErrorKind::cancelled: return exit_interrupted;
    default: return exit_failed;
  }
}

int report(const wold::Error& error) {
  if (error.kind() == wold::ErrorKind::cancelled)
    complain(error.message() == "cancelled" ? "interrupted; nothing was written" : error.message());
  else if (error.location().known())
    complain(fmt::format("{}: error: {}", error.location().text(), error.message()));
  else
    complain(fmt::format("wold: error: {}", error.message()));
  return exit_code(error);
}

/// CLI11 speaks of subcommands and options without naming what was meant.
std::string complaint(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  if (argc > 1 && app.get_subcommands().empty() && argv[1][0] != '-') {
    std::vector<std::string> known;
    for (const CLI::App* command : app.get_subcommands({})) known.push_back(command->get_name());
    return fmt::format("unknown command '{}'.{}", argv[1], wold::suggestion(argv[1], known));
  }
  if (argc <= 1) return "a command is missing, such as 'wold render scenes/forest.toml'.";
  std::string message = error.what();
  std::replace(message.begin(), message.end(), '\n', ' ');
  return message.ends_with('.') ? message : message + ".";
}

int run(int argc, char** argv) {
  CLI::App app("wold grows a landscape from a text file and shows it.", "wold");
  app.set_version_flag("--version", "wold " WOLD_VERSION);
  app.require_subcommand(1);
  app.footer("'wold help COMMAND' and 'wold help OPERATOR' tell more.");
  wold::Session session;
  session.interrupted = &interrupted;
  wold::add_render(app, session);
  wold::add_view(app, session);
  wold::add_terrain(app, session);
  wold::add_erode(app, session);
  wold::add_analyze(app, session);
  wold::add_shader(app, session);
  wold::add_check(app, session);
  wold::add_new(app, session);
  wold::add_help(app, session);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    complain(fmt::format("wold: error: {} See 'wold --help'.", complaint(app, error, argc, argv)));
    return exit_usage;
  }
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    complain("wold: error: cannot write to standard output");
    return exit_failed;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  std::signal(SIGPIPE, SIG_IGN);
  try {
    return run(argc, argv);
  } catch (const wold::Error& error) {
    return report(error);
  } catch (const std::bad_alloc&) {
    complain("wold: error: out of memory; a lower resolution or a smaller picture needs less");
  } catch (const std::exception& error) {
    complain(fmt::format("wold: error: {}", error.what()));
  }
  return exit_failed;
}
