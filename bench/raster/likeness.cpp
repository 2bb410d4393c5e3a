// How like the drawn picture of a scene is to the traced one: ratios of mean colours, by what is
// seen.
//
//   raster_likeness SCENE [WIDTHxHEIGHT [low|medium|high [SAMPLES [PICTURES.exr]]]]
//
// PICTURES.exr gets both, and of each pixel what it shows, how far off, and how much of it is lit.

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <map>
#include <string>

#include "../../tests/raster/likeness.hpp"
#include "gpu/context.hpp"
#include "image/io.hpp"

namespace wold {
namespace {

void write_pictures(const std::string& file, const Likeness& l) {
  Image out(l.shown.width(), l.shown.height(),
            {"R", "G", "B", "drawn.R", "drawn.G", "drawn.B", "shown", "distance", "lit"});
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) {
      int channel = 0;
      for (const Image* image : {&l.traced, &l.drawn})
        for (const char* name : {"R", "G", "B"})
          out.at(x, y, channel++) = image->at(x, y, image->find(name));
      out.at(x, y, channel++) = static_cast<float>(l.shown(x, y));
      out.at(x, y, channel++) = l.distance(x, y);
      out.at(x, y, channel) = l.lit(x, y);
    }
  write_exr(file, out);
}

void run(const std::string& file, const std::string& size_text, const std::string& quality_text,
         const std::string& samples_text, const std::string& pictures) {
  IVec2 size(0);
  if (std::sscanf(size_text.c_str(), "%dx%d", &size.x, &size.y) != 2 || size.x < 8 || size.y < 8)
    throw Error(ErrorKind::usage, "a size is as 320x180, not " + size_text);
  const std::map<std::string, DrawingQuality> qualities{{"low", DrawingQuality::low},
                                                        {"medium", DrawingQuality::medium},
                                                        {"high", DrawingQuality::high}};
  const auto quality = qualities.find(quality_text);
  if (quality == qualities.end())
    throw Error(ErrorKind::usage, "a quality is low, medium or high, not " + quality_text);
  const int samples = std::atoi(samples_text.c_str());
  if (samples < 1)
    throw Error(ErrorKind::usage, "samples are a number from 1, not " + samples_text);
  Progress progress;
  const OffscreenContext context;
  PlantedWorld world(read_scene(file), progress);
  const Camera camera = world.camera(world.scene().camera(""), progress);
  const Likeness l =
      likeness(world, camera, size, static_cast<unsigned>(samples), quality->second, 16);
  if (!pictures.empty()) write_pictures(pictures, l);
  struct Row {
    const char* name;
    Shown kind;
    float from;
    float to;
  };
  fmt::print("| {}, drawn / traced | R | G | B | pixels |\n|---|---|---|---|---|\n", file);
  for (const Row& row :
       {Row{"sky", Shown::sky, 0, 1e9F}, Row{"sunlit ground", Shown::sunlit, 0, 1e9F},
        Row{"ground in shade", Shown::shade, 0, 1e9F},
        Row{"ground in shade within 15 m", Shown::shade, 0, 15},
        Row{"plants within 60 m", Shown::plant, 0, 60},
        Row{"plants beyond", Shown::plant, 60, 1e9F}}) {
    const MeanColors means = mean_colors(l, row.kind, row.from, row.to);
    if (means.pixels < 20) continue;
    const Vec3 ratio = means.drawn / means.traced;
    fmt::print("| {} | {:.2f} | {:.2f} | {:.2f} | {} |\n", row.name, ratio.x, ratio.y, ratio.z,
               means.pixels);
  }
}

}  // namespace
}  // namespace wold

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "usage: raster_likeness SCENE [WIDTHxHEIGHT [low|medium|high [SAMPLES "
                 "[PICTURES.exr]]]]\n";
    return 2;
  }
  try {
    wold::run(argv[1], argc > 2 ? argv[2] : "320x180", argc > 3 ? argv[3] : "medium",
              argc > 4 ? argv[4] : "32", argc > 5 ? argv[5] : "");
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << '\n';
    return 1;
  }
}
