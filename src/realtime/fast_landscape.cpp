#include "realtime/fast_landscape.hpp"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "gpu/context.hpp"
#include "gpu/objects.hpp"
#include "realtime/fast_cloud_tables.hpp"
#include "realtime/fast_eye.hpp"
#include "realtime/fast_passes.hpp"
#include "realtime/fast_rings.hpp"
#include "realtime/land_textures.hpp"

namespace wold {

namespace {

constexpr int view_texels = 7;
constexpr int first_map_unit = 15;        // those before are the passes'
constexpr float most_samples_still = 32;  // that a pixel is the mean of
constexpr float most_samples = 4;

int power_of_two_above(double x) {
  int n = 1;
  while (n < x) n *= 2;
  return n;
}

/// The finest that `octaves` of a land show, m: finest_spacing of landscape/terrain.glsl.
double finest_spacing(const Landscape& landscape, int octaves) {
  double largest = 1000;
  for (const LandscapeValue& v : landscape.values)
    if (v.name == "LARGEST_FEATURE") largest = std::stod(v.value);
  return double{landscape.settings.terrain_scale} * largest * std::exp2(-octaves - 1.0);
}

}  // namespace

struct FastLandscapeDrawing::State {
  State(const Landscape& landscape, const FastLandscapeSettings& settings);

  void draw(int width, int height, const LandscapeEye& eye);
  void make_tables();
  void make_rings(int width);
  void bake(const LandscapeEye& eye);
  void bake_heights(const std::vector<RingStrip>& strips);
  void bake_horizons(const std::vector<RingStrip>& strips);
  void sun_moved();
  bool settling() const;
  void draw_view(const LandscapeEye& eye, int width, int height);
  void draw_sky();
  void draw_quarters(int width, int height, int count);
  void draw_quarter(int width, int height, bool same_view);
  void resize(int width, int height);
  void bind_all(const GpuProgram& program) const;
  bool has_clouds() const { return knobs.cloud_steps > 0 && knobs.cloud_coverage > 0; }
  const GpuTarget& view() const { return views_[static_cast<std::size_t>(newest_view_)]; }
  const GpuTarget& last_view() const { return views_[static_cast<std::size_t>(1 - newest_view_)]; }

  LandscapeSettings knobs;
  FastLandscapeSettings settings;
  FastPasses passes;
  double finest = 1;
  double finest_shadow = 10;
  LandTextures maps;

  std::optional<RingSquares> squares;
  std::optional<RingSquares> horizon_squares;
  int horizon_first = 0;
  std::optional<FastCloudTables> clouds;
  RingTarget ring_target;
  GpuTexture heights;
  GpuTexture maxima;
  GpuTexture horizons;

  GpuTarget transmittances;
  GpuTarget multiples;
  GpuTarget sky;
  std::array<GpuTarget, 2> views_;
  int newest_view_ = 0;
  GpuTarget land;
  GpuTarget clouded;
  std::array<GpuTarget, 2> means;
  int newest_mean = 0;

  std::optional<LandscapeEye> last;
  Vec3 sun{0, 0, 1};
  int frames = 0;  // since the last cut
  int number = 0;  // of quarters drawn
  bool still = false;
  float scale = 1;
  int next_horizon = 0;
  int old_horizons = 0;  // levels baked for another sun
};

FastLandscapeDrawing::State::State(const Landscape& landscape, const FastLandscapeSettings& s)
    : knobs(landscape.settings), settings(s), passes(landscape) {
  finest = finest_spacing(landscape, knobs.octaves);
  finest_shadow = finest_spacing(landscape, knobs.octaves_shadow);
  if (landscape.map) maps = LandTextures(*landscape.map);
  for (GpuTarget& v : views_)
    v = GpuTarget(view_texels, 1, std::array{PixelFormat::rgba32f}, false, TextureFilter::nearest);
  sky = GpuTarget(
      24, 128, std::array{PixelFormat::rgba16f, PixelFormat::rgba16f, PixelFormat::rgba16f}, false);
}

void FastLandscapeDrawing::State::make_tables() {
  if (multiples) return;
  transmittances = GpuTarget(256, 64, std::array{PixelFormat::rgba32f}, false);
  transmittances.bind();
  passes[FastPass::transmittances].use();
  draw_full_screen();
  multiples = GpuTarget(128, 32, std::array{PixelFormat::rgba32f}, false);
  multiples.bind();
  passes[FastPass::multiples].use();
  draw_full_screen();
}

void FastLandscapeDrawing::State::make_rings(int width) {
  int size = settings.ring_size;
  if (size <= 0) size = std::clamp(power_of_two_above(2.0 * width), 256, 1024);
  if (squares && squares->size() == size) return;
  const double cell = 0.5 * finest;
  const auto levels_to = [&](int texels, double first) {
    return RingSquares::levels_over(texels, first,
                                    static_cast<double>(knobs.max_rendering_distance));
  };
  squares.emplace(size, levels_to(size, cell), cell);
  horizon_first = 0;
  while (std::ldexp(cell, horizon_first) < 0.5 * finest_shadow) ++horizon_first;
  const int horizon_size = size / 2;
  const double horizon_cell = std::ldexp(cell, horizon_first);
  horizon_squares.emplace(horizon_size, levels_to(horizon_size, horizon_cell), horizon_cell);
  if (has_clouds()) clouds.emplace(std::clamp(size / 4, 128, 256));
  const int halvings = static_cast<int>(std::lround(std::log2(size))) - 2;
  heights = GpuTexture(
      size, size, {.format = PixelFormat::rgba32f, .repeat = true, .layers = squares->levels()});
  maxima = GpuTexture(size, size,
                      {.format = PixelFormat::r32f,
                       .filter = TextureFilter::nearest,
                       .repeat = true,
                       .layers = squares->levels(),
                       .levels = halvings});
  horizons = GpuTexture(
      horizon_size, horizon_size,
      {.format = PixelFormat::rgba32f, .repeat = true, .layers = horizon_squares->levels()});
}

void FastLandscapeDrawing::State::bind_all(const GpuProgram& program) const {
  int unit = 0;
  const auto bind = [&](const char* name, const GpuTexture& texture) {
    if (texture) {
      texture.bind(unit);
      program.set(name, unit);
    }
    ++unit;
  };
  program.use();
  bind("ring_heights", heights);
  bind("ring_maxima", maxima);
  bind("ring_horizons", horizons);
  if (clouds) clouds->bind(program, unit);
  unit += 2;
  bind("frame_view", view().color());
  bind("last_view", last_view().color());
  bind("air_transmittances", transmittances.color());
  bind("air_multiples", multiples.color());
  bind("sky_by_air", sky.color(0));
  bind("sky_by_aerosol", sky.color(1));
  bind("sky_passed", sky.color(2));
  maps.bind(program, first_map_unit);
  if (squares) {
    program.set("ring_size", squares->size());
    program.set("ring_levels", squares->levels());
    program.set("ring_cell", static_cast<float>(squares->cell(0)));
    program.set("horizon_size", horizon_squares->size());
    program.set("horizon_levels", horizon_squares->levels());
    program.set("horizon_first", horizon_first);
  }
  if (last) {
    program.set("ring_eye", Vec2(last->place));
    program.set("iTime", last->time);
  }
  program.set("sun_now", sun);
  program.set("sun_elevation", knobs.sun_elevation);
  program.set("sun_azimuth", knobs.sun_azimuth);
  program.set("exposure", knobs.exposure);
  const bool free = last && last->camera;
  program.set("field_of_view", free ? last->camera->field_of_view : knobs.field_of_view);
}

void FastLandscapeDrawing::State::bake_heights(const std::vector<RingStrip>& strips) {
  bake_land(passes, ring_target, *squares, strips, heights, maxima,
            [&](const GpuProgram& program) { bind_all(program); });
}

void FastLandscapeDrawing::State::bake_horizons(const std::vector<RingStrip>& strips) {
  if (strips.empty()) return;
  const GpuProgram& program = passes[FastPass::horizons];
  bind_all(program);
  draw_strips(program, ring_target, *horizon_squares, strips, horizons);
}

void FastLandscapeDrawing::State::bake(const LandscapeEye& eye) {
  const bool at_once = frames == 0;
  bake_heights(squares->move_to(eye.place));
  std::vector<RingStrip> changed = horizon_squares->move_to(eye.place);
  for (int k = at_once ? old_horizons : std::min(old_horizons, 1); k > 0; --k, --old_horizons) {
    next_horizon = (next_horizon + 1) % horizon_squares->levels();
    changed.push_back(horizon_squares->whole(next_horizon));
  }
  bake_horizons(changed);
  if (!clouds) return;
  const double rise = static_cast<double>(std::max(sun.z, 0.05F));
  const DVec2 wind(static_cast<double>(knobs.wind_speed) * static_cast<double>(eye.time), 0);
  const DVec2 to_layer = DVec2(sun.x, sun.y) / rise * static_cast<double>(knobs.clouds_height);
  clouds->bake(passes, ring_target, eye.place - wind, to_layer, at_once,
               [&](const GpuProgram& program) { bind_all(program); });
}

void FastLandscapeDrawing::State::sun_moved() {
  if (horizon_squares) old_horizons = horizon_squares->levels();
  if (clouds) clouds->sun_moved();
}

bool FastLandscapeDrawing::State::settling() const {
  return old_horizons > 0 || (clouds && clouds->settling());
}

void FastLandscapeDrawing::State::draw_view(const LandscapeEye& eye, int width, int height) {
  newest_view_ = 1 - newest_view_;
  const GpuProgram& program = passes[eye.camera ? FastPass::free_view : FastPass::flight_view];
  bind_all(program);
  program.set("iResolution", Vec3(width, height, 1));
  if (eye.camera) {
    const Vec3 forward = glm::normalize(eye.camera->direction);
    program.set("camera_place", Vec4(eye.camera->position, 0));
    program.set("camera_forward", forward);
    program.set("camera_right", glm::normalize(glm::cross(forward, eye.camera->up)));
  }
  view().bind();
  draw_full_screen();
}

void FastLandscapeDrawing::State::draw_sky() {
  const GpuProgram& program = passes[FastPass::sky];
  bind_all(program);
  sky.bind();
  draw_full_screen();
}

void FastLandscapeDrawing::State::resize(int width, int height) {
  if (means[0] && means[0].width() == width && means[0].height() == height) return;
  frames = 0;
  for (GpuTarget* target : {&land, &clouded})
    *target = GpuTarget((width + 1) / 2, (height + 1) / 2, std::array{PixelFormat::rgba32f}, false,
                        TextureFilter::nearest);
  for (GpuTarget& mean : means)
    mean = GpuTarget(width, height, std::array{PixelFormat::rgba16f}, false);
}

void FastLandscapeDrawing::State::draw_quarter(int width, int height, bool same_view) {
  constexpr std::array turns = {IVec2(0, 0), IVec2(1, 1), IVec2(1, 0), IVec2(0, 1)};
  const int round = number / 4;
  // Evenly spread (M. Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018).
  const auto part = [&](double step) { return static_cast<float>(std::fmod(step * round, 1.0)); };
  const Vec2 shift = Vec2(part(0.7548776662466927), part(0.5698402909980532));
  const auto begin = [&](FastPass pass) -> const GpuProgram& {
    const GpuProgram& program = passes[pass];
    bind_all(program);
    program.set("iResolution", Vec3(width, height, 1));
    program.set("turn", turns[static_cast<std::size_t>(number % 4)]);
    program.set("shift", round == 0 ? Vec2(0) : shift - 0.5F);
    program.set("start_turn", part(0.618033988749895));
    return program;
  };
  const auto read = [](const GpuProgram& program, const char* name, const GpuTarget& target,
                       int unit) {
    program.set(name, unit);
    target.color().bind(unit);
  };
  begin(FastPass::land);
  land.bind();
  draw_full_screen();
  const GpuProgram& march = begin(FastPass::clouds);
  read(march, "land_picture", land, 13);
  clouded.bind();
  draw_full_screen();
  const GpuProgram& resolve = begin(FastPass::resolve);
  resolve.set("has_history", frames > 0 || same_view);
  resolve.set("same_view", same_view);
  resolve.set("still", still);
  resolve.set("most_samples", still ? most_samples_still : most_samples);
  read(resolve, "new_picture", clouded, 13);
  read(resolve, "history", means[static_cast<std::size_t>(newest_mean)], 14);
  newest_mean = 1 - newest_mean;
  means[static_cast<std::size_t>(newest_mean)].bind();
  draw_full_screen();
  ++number;
}

void FastLandscapeDrawing::State::draw_quarters(int width, int height, int count) {
  for (int k = 0; k < count; ++k) draw_quarter(width, height, k > 0);
  ++frames;
}

void FastLandscapeDrawing::State::draw(int width, int height, const LandscapeEye& eye) {
  GLint shown = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &shown);
  glDisable(GL_BLEND);
  glDisable(GL_DEPTH_TEST);
  GpuTimer timer;
  if (settings.frame_time > 0) timer.begin();
  const int w = std::max(1, static_cast<int>(std::lround(scale * static_cast<float>(width))));
  const int h = std::max(1, static_cast<int>(std::lround(scale * static_cast<float>(height))));
  make_tables();
  make_rings(width);
  if (last && is_cut(*last, eye)) frames = 0;
  const Vec3 sun_before = std::exchange(sun, sun_at(knobs, eye.time));
  if (last && sun != sun_before) sun_moved();
  still = last && frames > 0 && stands(*last, eye) && !settling();
  resize(w, h);
  last = eye;
  bake(eye);
  // The eye moves on even where it stands: time has gone on.
  draw_view(eye, w, h);
  draw_sky();
  if (frames == 0) number = 0;
  draw_quarters(w, h, frames == 0 ? 4 : 1);
  const GpuProgram& show = passes[FastPass::show];
  bind_all(show);
  show.set("iResolution", Vec3(width, height, 1));
  show.set("history", 14);
  means[static_cast<std::size_t>(newest_mean)].color().bind(14);
  glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(shown));
  glViewport(0, 0, width, height);
  draw_full_screen();
  if (settings.frame_time > 0) {
    const auto took = static_cast<float>(timer.end());
    // In eighths, and slowly, so that a picture does not pump.
    const float wanted = scale * std::sqrt(settings.frame_time / std::max(took, 1e-3F));
    if (wanted < scale - 0.03F)
      scale -= 0.125F;
    else if (wanted > scale + 0.16F)
      scale += 0.125F;
    scale = std::clamp(scale, settings.least_scale, 1.0F);
  }
}

FastLandscapeDrawing::FastLandscapeDrawing(const Landscape& landscape,
                                           const FastLandscapeSettings& settings)
    : state_(std::make_unique<State>(landscape, settings)) {}
FastLandscapeDrawing::~FastLandscapeDrawing() = default;
FastLandscapeDrawing::FastLandscapeDrawing(FastLandscapeDrawing&&) noexcept = default;
FastLandscapeDrawing& FastLandscapeDrawing::operator=(FastLandscapeDrawing&&) noexcept = default;

int FastLandscapeDrawing::compile_next(bool camera) {
  return state_->passes.compile_next(camera);
}

void FastLandscapeDrawing::draw(int width, int height, float time) {
  state_->draw(width, height, eye_of_flight(state_->knobs, time));
}

void FastLandscapeDrawing::draw(int width, int height, float time, const Camera& camera) {
  state_->draw(width, height, {DVec2(camera.position.x, camera.position.y), camera, time});
}

void FastLandscapeDrawing::set_sun(float elevation, float azimuth) {
  state_->knobs.sun_elevation = elevation;
  state_->knobs.sun_azimuth = azimuth;
}
void FastLandscapeDrawing::set_exposure(float stops) {
  state_->knobs.exposure = stops;
}

void FastLandscapeDrawing::cut() {
  state_->frames = 0;
}
int FastLandscapeDrawing::frames() const {
  return state_->frames;
}
bool FastLandscapeDrawing::settling() const {
  return state_->settling();
}
float FastLandscapeDrawing::scale() const {
  return state_->scale;
}

}  // namespace wold
