#pragma once
// The viewer as a user sees it: its picture, with the panel, the help, messages, work under way,
// the path tracer's picture and a line of numbers over it.

#include <string>
#include <vector>

#include "view/interface.hpp"
#include "view/overlay.hpp"
#include "view/panel.hpp"
#include "view/traced_panel.hpp"
#include "view/viewer.hpp"

namespace wold {

class ViewerScreen {
 public:
  /// Both must outlive this.
  ViewerScreen(Viewer& viewer, Interface& interface);

  /// One frame of the viewer and all that is over it, into framebuffer `target` of that size.
  /// A size of nothing draws nothing.
  void frame(const Controls& controls, IVec2 size, unsigned target = 0);

  /// Closes what lies over the picture besides the panel; false if nothing did.
  bool close_open();
  void show_panel(bool shown) { panel_shown_ = shown; }
  void show_help(bool shown) { help_shown_ = shown; }
  Messages& messages() { return messages_; }

 private:
  void obey(const Controls& controls);
  void draw_panel();
  void apply(const std::vector<ParameterChange>& changes);
  void draw_traced();
  void draw_work(float left_edge);
  StatusLine status() const;
  void take_messages();
  void count_frame(double seconds);

  Viewer& viewer_;
  Interface& interface_;
  ParameterPanel panel_;
  std::vector<PanelSection> sections_;
  int sections_of_ = 0;  // the reading that sections_ point into
  int shader_of_ = 0;    // the landscape whose knobs are among them; 0: none
  TracedPanel traced_;
  Messages messages_;
  bool panel_shown_ = true;
  bool help_shown_ = false;
  double seconds_per_frame_ = 0;  // smoothed
};

}  // namespace wold
