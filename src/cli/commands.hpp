#pragma once
// The program's commands, one file each. `add_…` declares a command's options; what it does runs
// when the command line has been read, and throws Error when it fails.

namespace CLI {
class App;
}

namespace wold {

struct Session;

void add_render(CLI::App& app, Session& session);
void add_view(CLI::App& app, Session& session);
void add_terrain(CLI::App& app, Session& session);
void add_erode(CLI::App& app, Session& session);
void add_analyze(CLI::App& app, Session& session);
void add_shader(CLI::App& app, Session& session);
void add_check(CLI::App& app, Session& session);
void add_new(CLI::App& app, Session& session);
void add_help(CLI::App& app, Session& session);

}  // namespace wold
