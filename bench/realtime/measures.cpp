// What the source of the landscape shader measured, measured again on this device, and the fast
// landscape beside the faithful one. Writes Markdown between two marks of a file.
//
//   realtime_measures FILE.md [--size WxH] [--scene FILE]

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

#include "gpu/context.hpp"
#include "gpu/objects.hpp"
#include "image/image.hpp"
#include "realtime/fast_landscape.hpp"
#include "realtime/landscape_picture.hpp"
#include "scene/build.hpp"
#include "scene/scene.hpp"
#include "terrain/heightfield.hpp"

namespace wold {
namespace {

constexpr const char* begin_mark = "<!-- measurements -->\n";
constexpr const char* end_mark = "<!-- end of measurements -->\n";
constexpr float static_tilt = 14;  // degrees, for a sky of about two thirds

using Picture = std::vector<float>;  // R, G, B, A from the bottom up

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

double psnr(const Picture& a, const Picture& b) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (k % 4 == 3) continue;
    const double d = static_cast<double>(a[k]) - static_cast<double>(b[k]);
    sum += d * d;
    ++count;
  }
  return -10 * std::log10(std::max(sum / static_cast<double>(count), 1e-12));
}

class Measures {
 public:
  Measures(const std::string& scene_file, int width, int height)
      : scene_(read_scene(scene_file)),
        width_(width),
        height_(height),
        target_(width, height, std::array{PixelFormat::rgba8}, false) {
    Progress progress;
    landscape_ = landscape_of(scene_, {}, progress);
    const LandscapeSettings& s = landscape_.settings;
    const Heightfield field = build_terrain(scene_, progress).field;
    const DVec2 place =
        domain_of(scene_.terrain).center() + DVec2(double{s.cam_east}, double{s.cam_north});
    camera_.position = Vec3(s.cam_east, s.cam_north, height_at(field, place) + s.cam_height);
    camera_.field_of_view = s.field_of_view;
  }

  std::string all() {
    double load = 0;
    getloadavg(&load, 1);
    std::string text = fmt::format(
        "Measured by `make measures` on {} (OpenGL {}), {} × {} pixels, scene `{}`; medians; the "
        "machine's load was {:.1f} when it began. Ratios carry over to other devices better than "
        "times.\n\n",
        gpu_info().renderer, gpu_info().version, width_, height_,
        std::filesystem::path(scene_.source).filename().string(), load);
    text += quality();
    text += cloud_steps();
    text += fast();
    text += shimmer();
    return text;
  }

 private:
  using Draw = std::function<void()>;

  double time_of(const Draw& draw) {
    target_.bind();
    GpuTimer timer;
    timer.begin();
    draw();
    return timer.end();
  }
  double time_of(const Draw& draw, int runs) {
    time_of(draw);
    std::vector<double> times;
    for (int k = 0; k < runs; ++k) times.push_back(time_of(draw));
    return median(times);
  }
  Picture picture_of(const Draw& draw) {
    target_.bind();
    draw();
    return target_.read();
  }

  /// Straight ahead or turned by these angles, degrees.
  Camera looking(float tilt, float turn = 0) const {
    Camera camera = camera_;
    const float azimuth = radians(landscape_.settings.cam_direction + turn);
    const float up = radians(tilt);
    camera.direction =
        Vec3(std::cos(up) * std::sin(azimuth), std::cos(up) * std::cos(azimuth), std::sin(up));
    return camera;
  }

  Landscape with(const std::function<void(LandscapeSettings&)>& change) const {
    Landscape out = landscape_;
    change(out.settings);
    return out;
  }
  Landscape reference() const {
    return with([](LandscapeSettings& s) {
      s.max_marching_steps *= 4;
      s.marching_factor /= 4;
      s.max_marching_steps_shadow *= 4;
      s.atmos_steps = 64;
      s.atmos_light_steps = 16;
      s.cloud_steps = 512;
      s.cloud_light_steps = 32;
    });
  }

  std::string quality() {
    std::cerr << "Normal and low quality\n";
    const LandscapeDrawing normal(landscape_);
    const LandscapeDrawing low(with([](LandscapeSettings& s) { s.low_quality = true; }));
    std::string text =
        "### Normal and low quality\n\n"
        "Frames per second over the first 60 s of the flight (the source's figure 6.1).\n\n"
        "| time, s | Normal | LOW_QUALITY | ratio |\n|---|---|---|---|\n";
    std::vector<double> ratios;
    for (int t = 0; t <= 60; t += 10) {
      const auto time = static_cast<float>(t);
      const double a = time_of([&] { normal.draw(width_, height_, time); }, 3);
      const double b = time_of([&] { low.draw(width_, height_, time); }, 3);
      ratios.push_back(a / b);
      text += fmt::format("| {} | {:.2f} | {:.2f} | {:.1f} |\n", t, 1e3 / a, 1e3 / b, a / b);
    }
    return text + fmt::format(
                      "\nThe source found twice as many frames with LOW_QUALITY, for the "
                      "clouds that it leaves out; here {:.1f} times as many.\n\n",
                      median(ratios));
  }

  std::string cloud_steps() {
    std::cerr << "Steps through clouds\n";
    const Camera camera = looking(static_tilt);
    const auto drawing = [&](int along, int to_sun) {
      return LandscapeDrawing(with([&](LandscapeSettings& s) {
        s.cloud_steps = along;
        s.cloud_light_steps = to_sun;
        s.cloud_even_steps = true;
      }));
    };
    const auto draw = [&](const LandscapeDrawing& d) {
      return [&] { d.draw(width_, height_, 0, camera); };
    };
    const LandscapeDrawing best = drawing(512, 32);
    const LandscapeDrawing none = drawing(0, 12);
    const Picture truth = picture_of(draw(best));
    struct Row {
      int along;
      int to_sun;
      LandscapeDrawing drawing;
      double decibels;
      std::vector<double> ratios = {};
      std::vector<double> own_ratios = {};  // of what clouds add to the picture without them
      std::vector<double> times = {};
    };
    std::vector<Row> rows;
    for (const int to_sun : {6, 12, 24})
      for (const int along : {32, 64, 128, 256}) {
        rows.push_back({along, to_sun, drawing(along, to_sun), 0});
        rows.back().decibels = psnr(picture_of(draw(rows.back().drawing)), truth);
      }
    // In turn, so that other work on the machine meets all alike.
    std::vector<double> longest_times;
    for (int k = 0; k < 5; ++k) {
      longest_times.push_back(time_of(draw(best)));
      const double without = time_of(draw(none));
      for (Row& row : rows) {
        row.times.push_back(time_of(draw(row.drawing)));
        row.ratios.push_back(longest_times.back() / row.times.back());
        row.own_ratios.push_back((longest_times.back() - without) /
                                 std::max(row.times.back() - without, 1e-3));
      }
    }
    std::string text = fmt::format(
        "### Steps through clouds\n\n"
        "A camera that stands, its sky about two thirds of the picture, CLOUD_EVEN_STEPS as the "
        "source has it; the reference takes 512 steps and 32 to the sun, {:.0f} ms (the source's "
        "chapters 6.2 and 6.3: 869.6 ms, and 65.9 "
        "ms for 64 × 12).\n\n"
        "| steps × to the sun | ms | of the reference's time | of its time in clouds | PSNR, dB |\n"
        "|---|---|---|---|---|\n",
        median(longest_times));
    double usual_ratio = 1;
    double usual_own_ratio = 1;
    double usual_psnr = 0;
    double most = 0;
    for (const Row& row : rows) {
      most = std::max(most, row.decibels);
      const double ratio = median(row.ratios);
      if (row.along == 64 && row.to_sun == 12) {
        usual_ratio = ratio;
        usual_own_ratio = median(row.own_ratios);
        usual_psnr = row.decibels;
      }
      text +=
          fmt::format("| {} × {} | {:.0f} | 1/{:.1f} | 1/{:.1f} | {:.1f} |\n", row.along,
                      row.to_sun, median(row.times), ratio, median(row.own_ratios), row.decibels);
    }
    const bool holds = usual_psnr > 35 && usual_own_ratio > 8;
    return text +
           fmt::format(
               "\nThe source found 64 × 12 hardly to be told from the reference at 1/13.2 "
               "of its time. Here: {:.1f} dB (the best of the table: {:.1f}) at 1/{:.1f} of "
               "its time, and 1/{:.1f} of what it spends in clouds. The finding {}.\n\n",
               usual_psnr, most, usual_ratio, usual_own_ratio,
               holds ? "holds: above 35 dB a difference is hard to see" : "does not hold here");
  }

  /// What a pixel shows on the mean over itself.
  Picture converged(const LandscapeDrawing& best, float time, const Camera* camera) const {
    constexpr int rays_across = 4;
    const Image image = landscape_picture(best, width_, height_, time, camera, rays_across);
    Picture out;
    for (int y = height_ - 1; y >= 0; --y)
      for (int x = 0; x < width_; ++x) {
        for (int c = 0; c < 3; ++c) out.push_back(image.at(x, y, c));
        out.push_back(1);
      }
    return out;
  }

  std::string fast() {
    std::cerr << "Fast and faithful\n";
    const LandscapeDrawing faithful(landscape_);
    const LandscapeDrawing best(reference());
    std::string text =
        "### Fast and faithful\n\n"
        "Medians of 12 frames drawn in turn, after 60 of the fast one (it shares work between "
        "frames). PSNR against the converged picture: the mean over each pixel of 16 rays of the "
        "faithful shader with four times the marching steps, each a quarter as long, 64 × 16 "
        "steps through air and 512 × 32 through clouds.\n\n"
        "| camera | faithful, ms | fast, ms | ratio | faithful, dB | fast, dB |\n"
        "|---|---|---|---|---|---|\n";
    double least_ratio = 1e9;
    double least_gain = 1e9;
    const auto compare = [&](const char* name, FastLandscapeDrawing& quick, const Camera* camera,
                             float step) {
      const auto draw = [&](auto& drawing, float time) {
        if (camera != nullptr)
          drawing.draw(width_, height_, time, *camera);
        else
          drawing.draw(width_, height_, time);
      };
      std::vector<double> slow_times;
      std::vector<double> quick_times;
      std::vector<double> ratios;
      constexpr int warm = 60;
      constexpr int measured = 12;
      float time = 20;
      for (int k = 0; k < warm + measured; ++k, time += step) {
        const double quick_time = time_of([&] { draw(quick, time); });
        if (k < warm) continue;
        quick_times.push_back(quick_time);
        slow_times.push_back(time_of([&] { draw(faithful, time); }));
        ratios.push_back(slow_times.back() / quick_time);
      }
      const double seen =
          psnr(picture_of([&] { draw(quick, time); }), converged(best, time, camera));
      const double plain =
          psnr(picture_of([&] { draw(faithful, time); }), converged(best, time, camera));
      least_ratio = std::min(least_ratio, median(ratios));
      least_gain = std::min(least_gain, seen - plain);
      text += fmt::format("| {} | {:.0f} | {:.0f} | {:.1f} | {:.1f} | {:.1f} |\n", name,
                          median(slow_times), median(quick_times), median(ratios), plain, seen);
    };
    for (const float tilt : {static_tilt, -6.0F}) {
      FastLandscapeDrawing quick(landscape_);
      const Camera camera = looking(tilt);
      compare(tilt > 0 ? "stands, much sky" : "stands, much land", quick, &camera, 0);
    }
    FastLandscapeDrawing quick(landscape_);
    compare("flies, 30 frames per second", quick, nullptr, 1.0F / 30);
    return text +
           fmt::format("\nAt least {:.1f} times as fast, and in PSNR {:.1f} dB {} or more.\n\n",
                       least_ratio, std::abs(least_gain), least_gain < 0 ? "below" : "above");
  }

  /// Mean over pixels of the variance over frames of a pan, of luminance carried to the middle one;
  /// `before` frames of the pan come first.
  double variance_of_pan(const std::function<void(const Camera&)>& draw, int before = 0) {
    constexpr int frames = 13;
    constexpr int middle_frame = frames / 2;
    const float pixel = 2 * std::tan(radians(0.5F * camera_.field_of_view)) /
                        static_cast<float>(std::max(width_, height_));
    std::vector<std::vector<double>> carried;
    const CameraRays middle(looking(-6), width_, height_);
    for (int k = -before; k < frames; ++k) {
      const Camera camera =
          looking(-6, degrees(0.25F * pixel) * static_cast<float>(k - middle_frame));
      const Picture seen = picture_of([&] { draw(camera); });
      if (k < 0) continue;
      const CameraRays rays(camera, width_, height_);
      const auto luminance = [&](int x, int y) {
        const std::size_t at =
            4 * (static_cast<std::size_t>(height_ - 1 - y) * static_cast<std::size_t>(width_) +
                 static_cast<std::size_t>(x));
        return 0.2126 * static_cast<double>(seen[at]) + 0.7152 * static_cast<double>(seen[at + 1]) +
               0.0722 * static_cast<double>(seen[at + 2]);
      };
      std::vector<double> row;
      for (int y = 4; y < height_ - 4; ++y)
        for (int x = 4; x < width_ - 4; ++x) {
          const Ray ray = middle.ray({static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F},
                                     {0.5F, 0.5F});
          const Vec3 at = rays.project(camera.position + 1000.0F * ray.direction);
          const float u = at.x - 0.5F;
          const float v = at.y - 0.5F;
          const int i = static_cast<int>(std::floor(u));
          const int j = static_cast<int>(std::floor(v));
          const auto fu = static_cast<double>(u - static_cast<float>(i));
          const auto fv = static_cast<double>(v - static_cast<float>(j));
          row.push_back((1 - fv) * ((1 - fu) * luminance(i, j) + fu * luminance(i + 1, j)) +
                        fv * ((1 - fu) * luminance(i, j + 1) + fu * luminance(i + 1, j + 1)));
        }
      carried.push_back(std::move(row));
    }
    double sum = 0;
    for (std::size_t p = 0; p < carried[0].size(); ++p) {
      double mean = 0;
      double squares = 0;
      for (const std::vector<double>& row : carried) {
        mean += row[p] / frames;
        squares += row[p] * row[p] / frames;
      }
      sum += squares - mean * mean;
    }
    return sum / static_cast<double>(carried[0].size());
  }

  std::string shimmer() {
    std::cerr << "Shimmer\n";
    const auto clear = [&](bool filtering) {
      return with([&](LandscapeSettings& s) {
        s.texture_filtering = filtering;
        s.cloud_steps = 0;
      });
    };
    const auto variance = [&](bool filtering) {
      const LandscapeDrawing d(clear(filtering));
      return variance_of_pan([&](const Camera& camera) { d.draw(width_, height_, 0, camera); });
    };
    const double with_filtering = variance(true);
    const double without = variance(false);
    FastLandscapeDrawing quick(clear(true));
    const double fast =
        variance_of_pan([&](const Camera& camera) { quick.draw(width_, height_, 0, camera); }, 16);
    return fmt::format(
        "### Shimmer\n\n"
        "A camera that stands turns by a quarter of a pixel from frame to frame, 13 frames, no "
        "clouds. Each frame is carried to the middle one by the turn (bilinear); shimmer is the "
        "variance over the frames of a pixel's luminance as displayed, and of that the mean over "
        "all pixels but the outer four. The edges of the land, which no filtering of textures "
        "smooths, count with it.\n\n"
        "| | mean variance |\n|---|---|\n| TEXTURE_FILTERING | {:.3e} |\n| without | {:.3e} |\n"
        "| the fast landscape, with it | {:.3e} |\n\n"
        "With filtering it is {:.2f} of what it is without; of the fast landscape, {:.2f} of the "
        "faithful one's.\n",
        with_filtering, without, fast, with_filtering / without, fast / with_filtering);
  }

  Scene scene_;
  int width_;
  int height_;
  GpuTarget target_;
  Landscape landscape_;
  Camera camera_;
};

void write_between_marks(const std::string& file, const std::string& text) {
  std::ifstream in(file);
  std::string whole((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  const std::size_t begin = whole.find(begin_mark);
  const std::size_t end = whole.find(end_mark);
  const std::string section = begin_mark + text + end_mark;
  if (begin == std::string::npos || end == std::string::npos)
    whole += "\n## Measurements\n\n" + section;
  else
    whole.replace(begin, end + std::string(end_mark).size() - begin, section);
  std::ofstream(file) << whole;
}

int run(const std::vector<std::string>& arguments) {
  std::string file;
  std::string scene = std::string(WOLD_SOURCE_DIR) + "/scenes/mountains.toml";
  int width = 200;
  int height = 112;
  for (std::size_t k = 0; k < arguments.size(); ++k) {
    if (arguments[k] == "--size" && k + 1 < arguments.size()) {
      const std::string& size = arguments[++k];
      width = std::max(16, std::atoi(size.c_str()));
      height = std::max(16, std::atoi(size.substr(size.find('x') + 1).c_str()));
    } else if (arguments[k] == "--scene" && k + 1 < arguments.size()) {
      scene = arguments[++k];
    } else {
      file = arguments[k];
    }
  }
  if (file.empty()) {
    std::cerr << "usage: realtime_measures FILE.md [--size WxH] [--scene FILE]\n";
    return 2;
  }
  const OffscreenContext context;
  const std::string text = Measures(scene, width, height).all();
  write_between_marks(file, text);
  std::cout << text;
  return 0;
}

}  // namespace
}  // namespace wold

int main(int argc, char** argv) {
  try {
    return wold::run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << '\n';
    return 1;
  }
}
