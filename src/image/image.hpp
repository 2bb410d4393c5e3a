#pragma once
// A picture in memory, as picture files have it: row 0 at the TOP, channels interleaved, any number
// of named channels. Grids of the world have row 0 in the south (at the bottom): the functions here
// turn the rows over, and nothing else in wold does.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/grid.hpp"
#include "base/vec.hpp"

namespace wold {

struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::string> channels;  ///< "R", "G", "B", "A", "albedo.R", "N.X", "Z", "Y", …
  std::vector<float> pixels;          ///< row by row from the top; the channels of a pixel together

  Image() = default;
  /// Throws Error(input) for a size below 1 x 1, Error(limit) if it would not fit in memory.
  Image(int width, int height, std::vector<std::string> channels, float value = 0);

  int channel_count() const { return static_cast<int>(channels.size()); }
  bool empty() const { return pixels.empty(); }
  /// The index of the channel of this name, or -1.
  int find(std::string_view name) const;

  /// Column x, row y from the top, channel c.
  float& at(int x, int y, int c) { return pixels[index(x, y, c)]; }
  float at(int x, int y, int c) const { return pixels[index(x, y, c)]; }
  std::span<float> row(int y) { return {&pixels[index(0, y, 0)], row_size()}; }
  std::span<const float> row(int y) const { return {&pixels[index(0, y, 0)], row_size()}; }

 private:
  std::size_t row_size() const { return static_cast<std::size_t>(width) * channels.size(); }
  std::size_t index(int x, int y, int c) const {
    return static_cast<std::size_t>(y) * row_size() +
           static_cast<std::size_t>(x) * channels.size() + static_cast<std::size_t>(c);
  }
};

/// The names of the channels of a layer: layer_channels("N", "XYZ") is N.X, N.Y, N.Z; without a
/// layer name just the letters.
std::vector<std::string> layer_channels(std::string_view layer, std::string_view letters);

/// Copies a grid of the world (row 0 in the south) into a channel of a picture of the same size.
void set_channel(Image& image, int channel, GridView<const float> grid);
/// Copies into the channels `first`, `first` + 1, `first` + 2.
void set_channels(Image& image, int first, GridView<const Vec3> grid);

/// A picture with one channel from a grid of the world.
Image image_of(GridView<const float> grid, std::string name = "Y");
/// A picture with three channels from a grid of the world.
Image image_of(GridView<const Vec3> grid, std::vector<std::string> names = {"R", "G", "B"});

/// A channel as a grid of the world. Throws Error(input) if there is no such channel.
Grid<float> channel_grid(const Image& image, int channel = 0);
/// The channel of that name; the error lists the names there are.
Grid<float> channel_grid(const Image& image, std::string_view name);
/// The channels R, G, B (of a picture without them: the first three, or the first one three times)
/// as a grid of the world.
Grid<Vec3> color_grid(const Image& image);

/// The indices of R, G and B in a picture, chosen as `color_grid` does.
struct ColorChannels {
  int r = 0;
  int g = 0;
  int b = 0;
};
ColorChannels color_channels(const Image& image);

/// Throws Error(limit) if so many floats exceed the free memory. `what` begins the
/// message: "A picture of 100000 x 100000 with 4 channels".
void check_memory(double floats, const std::string& what);

}  // namespace wold
