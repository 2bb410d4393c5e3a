#include "view/film_maker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "image/atomic_file.hpp"
#include "image/io.hpp"
#include "image/tonemap.hpp"
#include "render/render.hpp"
#include "view/parameter_widgets.hpp"

namespace wold {

namespace {

constexpr IVec2 metering_size{320, 180};
constexpr int metering_frames = 4;

/// The scene's light as a path's view has it.
SkySettings sky_of(const SkySettings& scene, const PathView& view) {
  SkySettings sky = scene;
  if (view.sun) sky.sun = {view.sun->x, view.sun->y};
  if (view.hour && !view.sun) {
    sky.sun.clear();
    sky.time = with_hour(sky.time, *view.hour - 24 * std::floor(*view.hour / 24));
  }
  return sky;
}

void look(Viewer& viewer, const SkySettings& scene, const PathView& view, Progress& progress) {
  const bool moves = view.sun || view.hour;
  if (moves) {
    viewer.edit().sky = sky_of(scene, view);
    viewer.edited(Viewer::Change::light);
  }
  viewer.place(view.camera);
  viewer.settle(progress);
}

void draw(Viewer& viewer, int frames, Progress& progress) {
  viewer.restart_picture();
  for (int k = 0; k < frames; ++k) {
    progress.check();
    viewer.draw();
  }
}

Image traced(Viewer& viewer, const FilmSettings& film, Progress& progress) {
  PlantedWorld& world = *viewer.world();
  const SkySettings sky = viewer.edited_scene().sky;
  const TracedWorld scene = world.traced(viewer.camera(), film.size, progress, &sky);
  Film picture(film.size.x, film.size.y);
  trace_picture(*scene.rays, CameraRays(viewer.camera(), film.size.x, film.size.y),
                world.scene().render,
                {{0, static_cast<std::uint32_t>(film.samples)}, world.scene().header.seed, false},
                picture, progress);
  return picture.image();
}

void write_frame(const std::string& name, const Image& image, const ToneMapping& tone,
                 float stops) {
  if (extension_of(name) == ".exr") return write_exr(name, image);
  write_png(name, display_image(image, at_exposure(tone, stops)),
            {.bits = 8, .srgb = true, .dither = true});
}

void make_frame(Viewer& viewer, const FilmSettings& film, const std::string& name, float stops,
                Progress& progress) {
  if (film.renderer == FilmRenderer::traced)
    return write_frame(name, traced(viewer, film, progress), viewer.tone(), stops);
  const bool shader = film.renderer == FilmRenderer::shader;
  draw(viewer, shader ? shader_frames(film.samples) : film.samples, progress);
  if (shader)
    write_png(name, viewer.displayed(), {.bits = 8, .srgb = true});
  else
    write_frame(name, viewer.picture().linear_image(), viewer.tone(), stops);
}

double time_of(const FilmSettings& film, int frame) {
  return film.path.begin() + frame / film.frames_per_second;
}

/// Nobody wants to see the land from below. Throws Error(input) for the first such frame.
void check_above_ground(const Viewer& viewer, const FilmSettings& film, const FrameRange& range) {
  const Ground& ground = viewer.world()->world().ground;
  for (int frame = range.first; frame < range.last; ++frame) {
    const double time = time_of(film, frame);
    const Vec3 eye = camera_at(film.path, time).camera.position;
    const float height = ground.base(DVec2(eye.x, eye.y)).height;
    if (eye.z < height)
      throw Error(
          ErrorKind::input,
          fmt::format("at {:.2f} s the path is below the ground: its height is {:.1f} m, the "
                      "land's there {:.1f} m (positions are [east, north, up from zero])",
                      time, eye.z, height));
  }
}

std::vector<float> stops_at_keys(Viewer& viewer, const SkySettings& sky, const CameraPath& path,
                                 Progress& progress) {
  const ToneMapping tone = viewer.tone();
  std::vector<float> stops;
  viewer.resize(metering_size.x, metering_size.y);
  for (const CameraKey& key : path.keys) {
    if (!tone.auto_exposure || viewer.shader_wanted()) {
      stops.push_back(tone.exposure);
      continue;
    }
    look(viewer, sky, camera_at(path, key.time), progress);
    draw(viewer, metering_frames, progress);
    stops.push_back(tone.exposure + viewer.picture().metered_exposure());
  }
  return stops;
}

}  // namespace

FrameRange all_frames(const CameraPath& path, double frames_per_second) {
  const double seconds = path.end() - path.begin();
  return {0, 1 + static_cast<int>(std::floor(seconds * frames_per_second + 1e-6))};
}

float exposure_at(const CameraPath& path, const std::vector<float>& stops, double time) {
  const auto after = std::find_if(path.keys.begin(), path.keys.end(),
                                  [time](const CameraKey& key) { return key.time >= time; });
  const auto k = static_cast<std::size_t>(after - path.keys.begin());
  if (k == 0) return stops.front();
  if (k == stops.size()) return stops.back();
  const double span = path.keys[k].time - path.keys[k - 1].time;
  const auto share = static_cast<float>((time - path.keys[k - 1].time) / std::max(span, 1e-9));
  return std::lerp(stops[k - 1], stops[k], share);
}

int make_film(Viewer& viewer, const FilmSettings& film, Progress& progress) {
  const FrameRange range = film.range.value_or(all_frames(film.path, film.frames_per_second));
  const std::vector<int> frames = frames_to_make(film.frames, range, film.resume);
  check_above_ground(viewer, film, range);
  viewer.want_shader(film.renderer == FilmRenderer::shader);
  const SkySettings sky = viewer.scene().sky;
  const std::vector<float> stops = stops_at_keys(viewer, sky, film.path, progress);
  viewer.resize(film.size.x, film.size.y);
  const ProgressStage stage(progress, "filming", static_cast<double>(frames.size()), "frames");
  for (const int frame : frames) {
    const double time = time_of(film, frame);
    const PathView view = camera_at(film.path, time);
    const auto extra = static_cast<float>(view.exposure.value_or(0));
    viewer.set_seconds(time - film.path.begin());
    viewer.set_extra_stops(extra);
    look(viewer, sky, view, progress);
    make_frame(viewer, film, film.frames.name(frame), exposure_at(film.path, stops, time) + extra,
               progress);
    progress.advance();
  }
  return static_cast<int>(frames.size());
}

}  // namespace wold
