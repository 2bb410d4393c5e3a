#include "image/image.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/error.hpp"
#include "base/memory.hpp"

namespace wold {

namespace {

void check_same_size(const Image& image, int width, int height) {
  if (image.width != width || image.height != height)
    throw Error(ErrorKind::internal,
                fmt::format("a grid of {} x {} does not fit a picture of {} x {}", width, height,
                            image.width, image.height));
}

}  // namespace

void check_memory(double floats, const std::string& what) {
  const double bytes = floats * sizeof(float);
  const auto available = static_cast<double>(available_memory());
  if (available > 0 && bytes > available)
    throw Error(ErrorKind::limit,
                fmt::format("{} needs {} of memory; {} are free. Choose a smaller size.", what,
                            memory_text(bytes), memory_text(available)));
}

Image::Image(int width_, int height_, std::vector<std::string> channels_, float value)
    : width(width_), height(height_), channels(std::move(channels_)) {
  if (width < 1 || height < 1)
    throw Error(ErrorKind::input,
                fmt::format("a picture of {} x {} pixels is empty; it needs at least 1 x 1", width,
                            height));
  const double floats = static_cast<double>(width) * height * static_cast<double>(channels.size());
  check_memory(
      floats, fmt::format("A picture of {} x {} with {} channels", width, height, channels.size()));
  pixels.assign(static_cast<std::size_t>(height) * row_size(), value);
}

int Image::find(std::string_view name) const {
  const auto found = std::find(channels.begin(), channels.end(), name);
  return found == channels.end() ? -1 : static_cast<int>(found - channels.begin());
}

std::vector<std::string> layer_channels(std::string_view layer, std::string_view letters) {
  std::vector<std::string> names;
  for (const char letter : letters)
    names.push_back(layer.empty() ? std::string(1, letter) : fmt::format("{}.{}", layer, letter));
  return names;
}

void set_channel(Image& image, int channel, GridView<const float> grid) {
  check_same_size(image, grid.width(), grid.height());
  for (int j = 0; j < grid.height(); ++j)
    for (int i = 0; i < grid.width(); ++i) image.at(i, image.height - 1 - j, channel) = grid(i, j);
}

void set_channels(Image& image, int first, GridView<const Vec3> grid) {
  check_same_size(image, grid.width(), grid.height());
  for (int j = 0; j < grid.height(); ++j)
    for (int i = 0; i < grid.width(); ++i)
      for (int c = 0; c < 3; ++c) image.at(i, image.height - 1 - j, first + c) = grid(i, j)[c];
}

Image image_of(GridView<const float> grid, std::string name) {
  Image image(grid.width(), grid.height(), {std::move(name)});
  set_channel(image, 0, grid);
  return image;
}

Image image_of(GridView<const Vec3> grid, std::vector<std::string> names) {
  Image image(grid.width(), grid.height(), std::move(names));
  set_channels(image, 0, grid);
  return image;
}

Grid<float> channel_grid(const Image& image, int channel) {
  if (channel < 0 || channel >= image.channel_count())
    throw Error(ErrorKind::input,
                fmt::format("the picture has no channel number {}; it has {}: {}", channel,
                            image.channel_count(), fmt::join(image.channels, ", ")));
  Grid<float> grid(image.width, image.height);
  for (int j = 0; j < grid.height(); ++j)
    for (int i = 0; i < grid.width(); ++i) grid(i, j) = image.at(i, image.height - 1 - j, channel);
  return grid;
}

Grid<float> channel_grid(const Image& image, std::string_view name) {
  const int channel = image.find(name);
  if (channel < 0)
    throw Error(ErrorKind::input, fmt::format("the picture has no channel '{}'; it has: {}", name,
                                              fmt::join(image.channels, ", ")));
  return channel_grid(image, channel);
}

ColorChannels color_channels(const Image& image) {
  const ColorChannels named{image.find("R"), image.find("G"), image.find("B")};
  if (named.r >= 0 && named.g >= 0 && named.b >= 0) return named;
  if (image.channel_count() >= 3) return {0, 1, 2};
  return {0, 0, 0};
}

Grid<Vec3> color_grid(const Image& image) {
  const ColorChannels c = color_channels(image);
  Grid<Vec3> grid(image.width, image.height);
  for (int j = 0; j < grid.height(); ++j)
    for (int i = 0; i < grid.width(); ++i) {
      const int y = image.height - 1 - j;
      grid(i, j) = Vec3(image.at(i, y, c.r), image.at(i, y, c.g), image.at(i, y, c.b));
    }
  return grid;
}

}  // namespace wold
