#pragma once
// A film of a scene along a camera's path: each frame drawn in real time or traced.
//
// Frame k shows the time begin + k / frames_per_second. The exposure is measured at each key of the
// path and runs evenly between them, so that it neither flickers nor depends on which frames a
// machine makes. The landscape shader sets its own by the light.

#include <optional>
#include <string>
#include <vector>

#include "base/progress.hpp"
#include "view/camera_path.hpp"
#include "view/film.hpp"
#include "view/viewer.hpp"

namespace wold {

enum class FilmRenderer { drawn, shader, traced };

struct FilmSettings {
  CameraPath path;
  FramePattern frames{"frame_%04d.png"};
  std::optional<FrameRange> range;  ///< nothing: the whole path
  double frames_per_second = 25;
  int samples = 16;  ///< frames of a mean, or light paths for each pixel
  FilmRenderer renderer = FilmRenderer::drawn;
  bool resume = false;  ///< leaves out frames that are on disk
  IVec2 size{1280, 720};
};

/// The frames of the whole path.
FrameRange all_frames(const CameraPath& path, double frames_per_second);

/// Stops at a time, by the stops measured at the keys.
float exposure_at(const CameraPath& path, const std::vector<float>& stops, double time);

/// Draws the frames and writes each as soon as it is there. Returns how many were made. Throws
/// Error(input) for a path that leads below the ground, before any work; Error(io),
/// Error(cancelled): what is written stays.
int make_film(Viewer& viewer, const FilmSettings& settings, Progress& progress);

}  // namespace wold
