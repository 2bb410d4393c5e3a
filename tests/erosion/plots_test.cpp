#include "erosion/plots.hpp"

#include <cmath>
#include <set>

#include "../terrain/testing.hpp"
#include "erosion/plot_chart.hpp"
#include "image/io.hpp"

namespace wold {
namespace {

using testing_terrain::error_text;
using testing_terrain::field_of;
using testing_terrain::TemporaryFolder;

Analysis hills(int width, int height) {
  Progress progress;
  return analyze(field_of(width, height, 20, {},
                          [](DVec2 p) {
                            return 300 + 0.1 * p.x + 80 * std::sin(p.x / 150) * std::cos(p.y / 90);
                          }),
                 {.channel_area = 10000}, progress);
}

/// Different colours in an image.
std::size_t colors(const Image& image) {
  std::set<std::uint32_t> found;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      found.insert(quantised(image.at(x, y, 0), 255) << 16U |
                   quantised(image.at(x, y, 1), 255) << 8U | quantised(image.at(x, y, 2), 255));
  return found.size();
}

TEST(Plots, AreWrittenWhole) {
  const TemporaryFolder folder;
  const auto paths = write_plots(hills(90, 60), folder.file("new/plots"));
  ASSERT_EQ(paths.size(), 5U);
  for (const std::string& path : paths) {
    const Picture picture = read_picture(path);
    EXPECT_EQ(picture.image.height, 800) << path;
    EXPECT_GE(picture.image.width, 900) << path;
    EXPECT_GT(colors(picture.image), 50U) << path;
  }
}

TEST(Plots, TheSmallestAndTheFlattestGroundHavePlots) {
  Progress progress;
  for (const auto& [w, h] : {std::pair{2, 5}, {5, 2}, {300, 3}}) {
    const Heightfield flat = field_of(w, h, 10, {}, [](DVec2) { return 7; });
    EXPECT_EQ(plots(analyze(flat, {}, progress)).size(), 5U) << w;
  }
}

TEST(Plots, AFolderThatCannotBeIsAnError) {
  const TemporaryFolder folder;
  write_plots(hills(20, 20), folder.path().string());
  error_text([&] { write_plots(hills(20, 20), folder.file("spectrum.png")); }, ErrorKind::io);
}

TEST(Chart, TicksAreRoundValues) {
  EXPECT_EQ(ticks_of({"", 0, 10, false}, 5).labelled, (std::vector<double>{0, 2, 4, 6, 8, 10}));
  EXPECT_EQ(ticks_of({"", 50, 1500, true}, 5).labelled, (std::vector<double>{100, 1000}));
  EXPECT_EQ(ticks_of({"", 20, 50, true}, 5).labelled, (std::vector<double>{20, 30, 40, 50}));
  EXPECT_EQ(tick_text(1e-3, true), "10⁻³");
  EXPECT_EQ(tick_text(0.25, false), "0.25");
  EXPECT_EQ(tick_text(1500, false), "1500");
}

}  // namespace
}  // namespace wold
