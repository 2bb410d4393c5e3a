#include "view/viewer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "scene/build.hpp"
#include "scene/same_scene.hpp"
#include "view/parameter_widgets.hpp"

namespace wold {

namespace {

constexpr double watch_interval = 0.5;     // s
constexpr int metering_interval = 12;      // frames
constexpr double exposure_rate = 2.5;      // 1/s, with which the eye gets used to light
constexpr float exposure_step = 0.25F;     // stops
constexpr double hours_per_second = 0.75;  // of a held key
constexpr double animated_hours = 0.1;     // per second
constexpr int test_ray_count = 12;
// Other land than before is seen in few samples first, if it has more than this.
constexpr int most_preview_samples = 400;
constexpr int preview_samples = 257;

/// Pixels of a picture with a longer side of `longest`, with the proportions of a window.
IVec2 scaled_size(int width, int height, int longest) {
  const int larger = std::max({width, height, 1});
  const auto part = [&](int side) {
    return std::max(1, side * std::min(longest, larger) / larger);
  };
  return {part(width), part(height)};
}

std::vector<Line> lines_of(const TestRays& rays, float radiance) {
  const Vec3 sunlit = radiance * Vec3(1, 0.75F, 0.15F);
  const Vec3 shaded = radiance * Vec3(0.2F, 0.45F, 1);
  const Vec3 sky = radiance * Vec3(0.55F, 0.9F, 1);
  std::vector<Line> lines;
  for (const std::vector<PathVertex>& path : rays.paths)
    for (std::size_t k = 2; k < path.size(); ++k) {
      const PathVertex& end = path[k];
      lines.push_back({path[k - 1].position, end.position,
                       !end.surface   ? sky
                       : end.sees_sun ? sunlit
                                      : shaded});
    }
  return lines;
}

}  // namespace

ViewedScene load_viewed_scene(const ViewerSettings& settings, Progress& progress) {
  Scene scene = read_scene(settings.scene, settings.overrides);
  const CameraSettings begin = scene.camera(settings.camera);
  check_scene(scene);
  ViewedScene viewed;
  viewed.world = std::make_shared<PlantedWorld>(std::move(scene), progress);
  viewed.camera = viewed.world->camera(begin, progress);
  return viewed;
}

Viewer::Viewer(ViewerSettings settings, ViewedScene scene, Progress& progress)
    : settings_(std::move(settings)),
      world_(std::move(scene.world)),
      shader_(settings_.defines, {.frame_time = settings_.shader_frame_time}),
      shader_wanted_(settings_.shader) {
  note_file_times();
  drawing_ = std::make_unique<SceneDrawing>(*world_, settings_.detail, progress);
  edited_ = world_->scene();
  usual_exposure_ = edited_.picture.exposure;
  readings_ = 1;
  take_over();
  place(scene.camera);
}

void Viewer::use(std::shared_ptr<PlantedWorld> world) {
  Progress silent;
  drawing_->replace(*world, silent);
  world_ = std::move(world);
  take_over();
}

void Viewer::take_over() {
  cameras_.clear();
  for (const CameraSettings& camera : world_->scene().cameras)
    if (is_placed(camera)) cameras_.push_back(placed_camera(world_->world().ground, camera));
  rays_ = {};
  lines_.set({});
  frames_to_metering_ = 0;
  ++generation_;
}

void Viewer::note_file_times() {
  file_times_.clear();
  std::error_code error;
  const auto time = std::filesystem::last_write_time(settings_.scene, error);
  if (!error) file_times_.emplace_back(settings_.scene, time);
}

void Viewer::place(const Camera& camera) {
  if (cameras_.empty()) cameras_.push_back(camera);
  pilot_ = pilot_at(
      camera,
      {[this](DVec2 at) { return world_->world().ground.detailed(at, 1).height; }, cameras_});
}

void Viewer::resize(int width, int height) {
  width_ = width;
  height_ = height;
  if (width > 0 && height > 0) drawing_->resize(width, height);
}

void Viewer::load(Scene scene, bool from_file) {
  error_.clear();
  loading_from_file_ = from_file;
  to_refine_.reset();
  const bool slow =
      scene.terrain.resolution > most_preview_samples && !same_land(world_->scene(), scene);
  if (slow) {
    to_refine_ = scene;
    scene.terrain.resolution = preview_samples;
    scene.surroundings.resolution = std::min(scene.surroundings.resolution, preview_samples / 2);
  }
  begin_building(std::move(scene));
}

void Viewer::begin_building(Scene scene) {
  loading_.begin([scene = std::move(scene), before = world_](Progress& progress) mutable {
    return std::make_shared<PlantedWorld>(std::move(scene), progress, before.get());
  });
}

void Viewer::reload() {
  note_file_times();
  is_edited_ = false;
  try {
    Scene scene = read_scene(settings_.scene, settings_.overrides);
    check_scene(scene);
    load(std::move(scene), true);
  } catch (const Error& error) {
    error_ = error.location().known() ? error.location().text() + ": " + error.message()
                                      : error.message();
  }
}

void Viewer::edited(Change change) {
  if (change == Change::shader) return shader_.knobs_changed();
  is_edited_ = true;
  if (change == Change::picture) return;
  if (change == Change::light) {
    try {
      check_sky(edited_.sky);
      drawing_->set_sky(edited_.sky);
      error_.clear();
    } catch (const Error& error) {
      error_ = error.message();
    }
    return;
  }
  try {
    check_scene(edited_);
    load(edited_, false);
  } catch (const Error& error) {
    error_ = error.message();
  }
}

void Viewer::take_loaded() {
  std::optional<BackgroundJob<std::shared_ptr<PlantedWorld>>::Outcome> outcome = loading_.take();
  if (!outcome) return;
  if (const auto* error = std::get_if<Error>(&*outcome)) {
    to_refine_.reset();
    if (error->kind() != ErrorKind::cancelled) error_ = error->message();
    return;
  }
  try {
    use(std::get<0>(std::move(*outcome)));
    if (loading_from_file_) {
      edited_ = to_refine_ ? *to_refine_ : world_->scene();
      usual_exposure_ = edited_.picture.exposure;
      loading_from_file_ = false;
      ++readings_;
    }
    if (to_refine_) begin_building(*std::exchange(to_refine_, std::nullopt));
  } catch (const Error& error) {
    error_ = error.message();
  }
}

void Viewer::watch_files() {
  for (const auto& [file, seen] : file_times_) {
    std::error_code error;
    const auto now = std::filesystem::last_write_time(file, error);
    if (!error && now != seen) return reload();
  }
}

void Viewer::set_hour(double hours) {
  edited_.sky.sun.clear();
  edited_.sky.time = with_hour(edited_.sky.time, hours - 24 * std::floor(hours / 24));
  edited(Change::light);
}

void Viewer::take_rays() {
  std::optional<BackgroundJob<TestRays>::Outcome> outcome = tracing_rays_.take();
  if (!outcome) return;
  if (const auto* error = std::get_if<Error>(&*outcome)) {
    if (error->kind() != ErrorKind::cancelled) notices_.push_back({error->message(), true});
    return;
  }
  rays_ = std::get<TestRays>(std::move(*outcome));
  // As bright as a white surface would be shown.
  lines_.set(lines_of(rays_, white_luminance * std::exp2(-exposure_)));
  drawing_->picture().restart();
}

void Viewer::obey(const Controls& c) {
  const auto pressed = [&c](Action action) { return c.pressed.has(action); };
  if (pressed(Action::brighter)) edited_.picture.exposure += exposure_step;
  if (pressed(Action::darker)) edited_.picture.exposure -= exposure_step;
  if (pressed(Action::reload)) reload();
  if (pressed(Action::copy_camera)) {
    clipboard_ = camera_toml(camera(), "view");
    notices_.push_back({"camera copied"});
  }
  if (pressed(Action::path_trace)) {
    if (traced_.open())
      traced_.close();
    else
      traced_.begin(world_, edited_.sky, camera(),
                    scaled_size(width_, height_, settings_.traced_size), settings_.traced_samples);
  }
  if (pressed(Action::test_rays)) {
    const bool shown = !rays_.paths.empty();
    if (!shown && shader_shown())
      notices_.push_back({"paths of light are shown in the scene's picture: press M"});
    rays_ = {};
    lines_.set({});
    drawing_->picture().restart();
    if (!shown)
      tracing_rays_.begin(
          [world = world_, sky = edited_.sky, camera = camera(),
           size = IVec2(std::max(width_, 1), std::max(height_, 1))](Progress& progress) {
            return trace_test_rays(*world, sky, camera, size, test_ray_count, progress);
          });
  }
  if (pressed(Action::shader)) want_shader(!shader_wanted_);
  if (pressed(Action::animate_sun)) animate_sun_ = !animate_sun_;
  double hours = 0;
  if (c.held.has(Action::later)) hours += hours_per_second * c.seconds;
  if (c.held.has(Action::earlier)) hours -= hours_per_second * c.seconds;
  if (animate_sun_) hours += animated_hours * c.seconds;
  if (hours != 0) set_hour(hour_of(edited_.sky.time) + hours);
}

void Viewer::adapt_exposure(double seconds) {
  if (--frames_to_metering_ <= 0 || !exposure_lags_) {
    frames_to_metering_ = metering_interval;
    metered_ = drawing_->picture().metered_exposure();
  }
  const float wanted = edited_.picture.exposure + (edited_.picture.auto_exposure ? metered_ : 0.0F);
  const bool slowly = exposure_lags_ && metered_once_;
  const double share = slowly ? -std::expm1(-exposure_rate * seconds) : 1;
  metered_once_ = true;
  exposure_ += static_cast<float>(share) * (wanted - exposure_);
}

float Viewer::height_above_ground() const {
  const Vec3 eye = camera().position;
  return eye.z - world_->world().ground.base(DVec2(eye.x, eye.y)).height;
}

void Viewer::frame(const Controls& controls) {
  take_loaded();
  take_rays();
  seconds_to_watch_ -= controls.seconds;
  if (settings_.watch && seconds_to_watch_ <= 0) {
    seconds_to_watch_ = watch_interval;
    watch_files();
  }
  obey(controls);
  const Ground& ground = world_->world().ground;
  pilot_ = flown(pilot_, controls,
                 {[&ground](DVec2 at) { return ground.detailed(at, 1).height; }, cameras_});
  seconds_ += controls.seconds;
  if (width_ <= 0 || height_ <= 0) return;
  try {
    draw();
  } catch (const Error& error) {
    if (!shader_wanted_) throw;
    shader_wanted_ = false;
    shader_.forget();
    notices_.push_back({error.message(), true});
    draw();
  }
  if (!shader_shown()) adapt_exposure(controls.seconds);
}

void Viewer::want_shader(bool wanted) {
  shader_wanted_ = wanted;
  if (!wanted && shader_.busy()) shader_.cancel();
  restart_picture();
}

float Viewer::shader_stops() const {
  // The scene's is for its own light, or makes up for what metering takes from bright land; the
  // shader goes by the light.
  return extra_stops_ + edited_.picture.exposure - usual_exposure_;
}

void Viewer::settle(Progress& progress) {
  if (shader_wanted_)
    shader_.make(world_, edited_.sky, drawing_->light().sky().sun_direction(), progress);
  else
    drawing_->settle(camera());
}

void Viewer::restart_picture() {
  drawing_->picture().restart();
  shader_.cut();
}

void Viewer::draw() {
  if (shader_wanted_) {
    shader_.want(world_, edited_.sky, drawing_->light().sky().sun_direction());
    shader_.draw(camera(), {width_, height_}, static_cast<float>(seconds_), shader_stops());
    if (shader_shown()) return;
  }
  drawing_->draw(camera(), [this](const DrawView& view) { lines_.draw(view); });
}

Image Viewer::displayed(float stops) const {
  if (shader_shown()) return shader_.picture();
  return display_image(drawing_->picture().linear_image(), at_exposure(edited_.picture, stops));
}

void Viewer::show(int width, int height) const {
  if (shader_shown()) return shader_.show(width, height);
  drawing_->picture().show(width, height, edited_.picture, exposure_);
}

std::vector<ViewerNotice> Viewer::take_notices() {
  return std::exchange(notices_, {});
}

std::optional<std::string> Viewer::take_clipboard() {
  return std::exchange(clipboard_, std::nullopt);
}

}  // namespace wold
