#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "cli/commands.hpp"
#include "cli/height_input.hpp"
#include "cli/outputs.hpp"
#include "cli/session.hpp"
#include "erosion/plots.hpp"
#include "erosion/realism.hpp"
#include "image/atomic_file.hpp"

namespace wold {

namespace {

struct AnalyzeOptions {
  std::string input;
  std::string against;
  std::string plots;
  AnalysisOptions analysis;
  HeightInputOptions height;
};

std::string range_text(const Figure& f) {
  return f.has_range() ? fmt::format("{:g} to {:g}", f.low, f.high) : std::string();
}

/// A table: name, value, unit, what nature has, and what it is.
std::string table(const std::vector<Figure>& figures) {
  std::size_t widest = 0;
  for (const Figure& f : figures) widest = std::max(widest, f.name.size());
  std::string text;
  for (const Figure& f : figures) {
    const std::string value = std::isfinite(f.value) ? fmt::format("{:.4g}", f.value) : "-";
    std::string line =
        fmt::format("{:<{}}  {:>10} {:<8} {}", f.name, widest, value, f.unit, f.text);
    if (f.has_range())
      line += fmt::format(" (natural: {}{})", range_text(f), f.natural() ? "" : "; this is not");
    text += line + "\n";
  }
  return text;
}

/// JSON has no NaN: what could not be measured is null.
Json json_number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json json_of(const std::vector<Figure>& figures) {
  Json list = Json::object();
  for (const Figure& f : figures) {
    Json entry{{"value", json_number(f.value)}, {"unit", f.unit}, {"text", f.text}};
    if (f.has_range()) {
      entry["natural"] = {f.low, f.high};
      entry["source"] = f.source;
    }
    list[f.name] = entry;
  }
  return list;
}

class AnalyzeRun {
 public:
  AnalyzeRun(const Session& session, AnalyzeOptions options)
      : session_(session), options_(std::move(options)) {}

  void run() const {
    if (!options_.plots.empty()) check_folder_writable(options_.plots);
    const Heightfield field = read_height_input(options_.input, options_.height, session_).field;
    Progress progress = session_.progress();
    const Analysis analysis = analyze(field, options_.analysis, progress);
    const std::vector<Figure> list = figures(analysis.realism);
    if (!session_.json) write_output(table(list));
    Json report{{"command", "analyze"},
                {"input", options_.input},
                {"size_metres", {field.size().x, field.size().y}},
                {"cell", field.cell},
                {"samples", {field.height.width(), field.height.height()}},
                {"figures", json_of(list)}};
    if (!options_.against.empty()) report["difference"] = compare(field, analysis, progress);
    Delivery delivery;
    if (!options_.plots.empty())
      delivery.write(options_.plots, [&](const std::string& folder) {
        const std::vector<std::string> plots = write_plots(analysis, folder);
        session_.say(fmt::format("wrote {}", fmt::join(plots, ", ")));
        report["plots"] = plots;
      });
    session_.print(report);
    delivery.check();
  }

 private:
  Json compare(const Heightfield& field, const Analysis& analysis, Progress& progress) const {
    const Heightfield other = read_height_input(options_.against, options_.height, session_).field;
    const double difference = relative_difference(field, other, progress);
    if (!session_.json)
      write_output(fmt::format("differs from {} by {:.3f} % of the relief (root mean square)\n",
                               options_.against, 100 * difference));
    return {{"against", options_.against},
            {"relative_rms", difference},
            {"relief", analysis.realism.relief}};
  }

  const Session& session_;
  AnalyzeOptions options_;
};

}  // namespace

void add_analyze(CLI::App& app, Session& session) {
  auto options = std::make_shared<AnalyzeOptions>();
  CLI::App* command =
      app.add_subcommand("analyze", "Measure how natural a height map is, in numbers and plots");
  command
      ->add_option("height", options->input,
                   "The height map: .exr .tif .png .r16, or elevation data (GeoTIFF, .hgt)")
      ->required()
      ->type_name("HEIGHT");
  options->height.add_to(*command);
  command
      ->add_option("--plots", options->plots,
                   "Folder for pictures: hillshade, drainage, slope and area, spectrum, hypsometry")
      ->type_name("FOLDER");
  command
      ->add_option("--against", options->against,
                   "Another height map of the same land: say how far the two differ")
      ->type_name("HEIGHT");
  command
      ->add_option("--channel-area", options->analysis.channel_area,
                   "Upstream area from which there is a channel")
      ->check(CLI::PositiveNumber)
      ->type_name("M2");
  session.add_output_options(*command);
  command->callback([&session, options] {
    std::optional<ThreadLimit> limit;
    if (session.threads > 0) limit.emplace(session.threads);
    AnalyzeRun(session, *options).run();
  });
}

}  // namespace wold
