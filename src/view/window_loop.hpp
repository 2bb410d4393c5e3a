#pragma once
// `wold view` on a desktop: a window, the scene loaded behind a bar of progress, and then frames
// until it is closed.

#include <atomic>
#include <optional>
#include <string>

#include "base/progress.hpp"
#include "view/viewer.hpp"

namespace wold {

struct WindowLoopSettings {
  ViewerSettings viewer;
  std::optional<DrawingQuality> quality;  ///< nothing: by the driver
  int width = 1280;
  int height = 800;
  std::string record;                   ///< file that takes the controls; empty: none
  std::string replay;                   ///< file that gives them; empty: the user
  std::string path_file;                ///< where K adds keys of a camera path
  std::string shots = "wold-%03d.png";  ///< names of pictures taken in the window
  int frames = 0;                       ///< ends after so many; 0: when it is closed
};

struct WindowLoopResult {
  int frames = 0;
  double seconds = 0;
};

/// Throws Error(limit) where there is no desktop or driver, and what loading the scene throws.
WindowLoopResult run_window(const WindowLoopSettings& settings,
                            const std::atomic<bool>* interrupted);

}  // namespace wold
