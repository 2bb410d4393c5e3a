#include "view/viewer_screen.hpp"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace wold {

namespace {

Viewer::Change change_of(ChangeCost cost) {
  switch (cost) {
    case ChangeCost::picture:
    case ChangeCost::render: return Viewer::Change::picture;
    case ChangeCost::light: return Viewer::Change::light;
    case ChangeCost::shader: return Viewer::Change::shader;
    case ChangeCost::ground:
    case ChangeCost::plants:
    case ChangeCost::terrain: return Viewer::Change::everything;
  }
  return Viewer::Change::everything;
}

PanelSection shader_section(Viewer& viewer) {
  const auto usual = std::make_shared<LandscapeSettings>(viewer.shader().scene_knobs());
  return {"shader",
          "Landscape shader",
          std::make_shared<const ParameterSet>(ShaderView::free_knobs()),
          &viewer.edit_knobs(),
          usual,
          false};
}

Task task_of(const char* title, const ProgressReport& report) {
  Task task{title, report.stage, -1, true};
  if (report.total > 0) task.part = std::clamp(report.done / report.total, 0.0, 1.0);
  return task;
}

}  // namespace

ViewerScreen::ViewerScreen(Viewer& viewer, Interface& interface)
    : viewer_(viewer), interface_(interface) {}

void ViewerScreen::obey(const Controls& controls) {
  const auto pressed = [&](Action action) { return controls.pressed.has(action); };
  if (pressed(Action::panel)) panel_shown_ = !panel_shown_;
  if (pressed(Action::help)) help_shown_ = !help_shown_;
  for (const Action action : {Action::undo, Action::redo}) {
    if (!pressed(action)) continue;
    const std::optional<ParameterChange> change =
        action == Action::undo ? panel_.undo(sections_) : panel_.redo(sections_);
    if (change) apply({*change});
  }
}

bool ViewerScreen::close_open() {
  const bool any = help_shown_ || viewer_.traced().open();
  help_shown_ = false;
  viewer_.traced().close();
  return any;
}

void ViewerScreen::apply(const std::vector<ParameterChange>& changes) {
  for (const ParameterChange& change : changes) {
    const Viewer::Change what = change_of(cost_of(change.section));
    // Land and shader are made anew when a slider is let go, light while it moves.
    const bool slow = what == Viewer::Change::everything || what == Viewer::Change::shader;
    if (!slow || change.finished) viewer_.edited(what);
  }
}

void ViewerScreen::draw_panel() {
  if (sections_of_ != viewer_.readings()) {
    sections_ = panel_sections(viewer_.edit());
    panel_.forget();
    sections_of_ = viewer_.readings();
    shader_of_ = 0;
  }
  // The knobs of the shader come with its first picture, and stay.
  if (shader_of_ != viewer_.shader().generation()) {
    std::erase_if(sections_, [](const PanelSection& s) { return s.name == "shader"; });
    sections_.push_back(shader_section(viewer_));
    shader_of_ = viewer_.shader().generation();
  }
  if (panel_shown_) apply(panel_.draw(sections_, viewer_.title()));
}

void ViewerScreen::draw_traced() {
  TracedView& traced = viewer_.traced();
  if (!traced.open()) return;
  const std::string status = traced.status();
  if (const std::optional<Image> image = traced.newest())
    traced_.set(*image, viewer_.tone(), viewer_.exposure());
  if (!traced_.draw(status, traced.done())) traced.close();
}

void ViewerScreen::draw_work(float left_edge) {
  std::vector<Task> tasks;
  if (viewer_.loading()) tasks.push_back(task_of("Building the scene", viewer_.loading_report()));
  const bool making_shader = viewer_.shader_wanted() && viewer_.shader().busy();
  if (making_shader) tasks.push_back(task_of("Making the shader", viewer_.shader().report()));
  const std::optional<std::size_t> cancelled = draw_tasks(tasks, left_edge);
  if (!cancelled) return;
  if (making_shader && *cancelled + 1 == tasks.size())
    viewer_.want_shader(false);
  else
    viewer_.cancel_loading();
}

void ViewerScreen::take_messages() {
  if (viewer_.error().empty())
    messages_.solved("scene");
  else
    messages_.error("scene", viewer_.error());
  for (const ViewerNotice& notice : viewer_.take_notices()) {
    if (notice.error)
      messages_.error("notice", notice.text);
    else
      messages_.notice(notice.text);
  }
}

StatusLine ViewerScreen::status() const {
  const Pilot& pilot = viewer_.pilot();
  const Vec3 sun = viewer_.drawing().light().sky().sun_direction();
  const DateTime& time = viewer_.edited_scene().sky.time;
  StatusLine line;
  line.milliseconds = 1000 * seconds_per_frame_;
  line.frames_per_second = seconds_per_frame_ > 0 ? 1 / seconds_per_frame_ : 0;
  const bool shader = viewer_.shader_shown();
  if (shader)
    line.shader_scale = static_cast<double>(viewer_.shader().scale());
  else
    line.triangles = static_cast<std::int64_t>(viewer_.drawing().drawn_triangles());
  line.position = pilot.position;
  line.height = viewer_.height_above_ground();
  line.speed = pilot.walking ? pilot.walking_speed : pilot.speed;
  line.walking = pilot.walking;
  line.sun_elevation = degrees(std::asin(static_cast<double>(sun.z)));
  line.sun_azimuth = degrees(std::atan2(static_cast<double>(sun.x), static_cast<double>(sun.y)));
  if (line.sun_azimuth < 0) line.sun_azimuth += 360;
  if (viewer_.edited_scene().sky.sun.empty())
    line.time = fmt::format("{:02}:{:02}", time.hour, time.minute);
  line.exposure = static_cast<double>(shader ? viewer_.shader().stops() : viewer_.exposure());
  return line;
}

void ViewerScreen::count_frame(double seconds) {
  seconds_per_frame_ =
      seconds_per_frame_ == 0 ? seconds : seconds_per_frame_ + 0.1 * (seconds - seconds_per_frame_);
}

void ViewerScreen::frame(const Controls& controls, IVec2 size, unsigned target) {
  obey(controls);
  viewer_.resize(size.x, size.y);
  viewer_.frame(controls);
  take_messages();
  count_frame(controls.seconds);
  if (size.x <= 0 || size.y <= 0) return;
  glBindFramebuffer(GL_FRAMEBUFFER, target);
  viewer_.show(size.x, size.y);
  interface_.begin(size, controls.seconds);
  draw_panel();
  const float left_edge = panel_shown_ ? panel_.width() : 0;
  draw_traced();
  draw_work(left_edge);
  messages_.draw(controls.seconds, left_edge);
  draw_status(status());
  if (help_shown_) draw_help(help_shown_);
  interface_.end();
}

}  // namespace wold
