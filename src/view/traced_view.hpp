#pragma once
// The path tracer at work on a view in the background, while one flies on.
//
// The picture grows by whole passes, and the newest whole pass can be looked at at any time.

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "base/background_job.hpp"
#include "image/image.hpp"
#include "render/path_tracer.hpp"
#include "scene/planted_world.hpp"

namespace wold {

class TracedView {
 public:
  /// Begins to trace a view under a sky; ends what went on before. `samples` per pixel.
  void begin(std::shared_ptr<PlantedWorld> world, const SkySettings& sky, const Camera& camera,
             IVec2 size, int samples);
  void cancel();
  /// Begun, and not ended by `close`.
  bool open() const { return open_; }
  void close();

  /// Whether passes are still traced.
  bool busy() const { return job_.busy(); }
  /// What it does: "rendering, 12 of 64 samples". To be called every frame: it notes the end.
  std::string status();
  /// Part that is done, in [0, 1].
  double done() const;
  /// The newest picture (channels as those of Film::image), once each.
  std::optional<Image> newest();
  /// The picture as it is now, or nothing.
  std::optional<Image> picture() const;
  const std::string& error() const { return error_; }

 private:
  struct Shared {
    std::mutex mutex;  // guards the rest
    Image image;
    int samples = 0;
    bool fresh = false;
  };

  BackgroundJob<int> job_;
  std::shared_ptr<Shared> shared_;
  int wanted_ = 0;
  bool open_ = false;
  std::string error_;
};

/// A few paths of light through the middle of a view.
struct TestRays {
  std::vector<std::vector<PathVertex>> paths;
};

/// Traces `count` paths through the middle tenth of the view, with all their bounces. The same for
/// the same seed.
TestRays trace_test_rays(PlantedWorld& world, const SkySettings& sky, const Camera& camera,
                         IVec2 size, int count, Progress& progress);

}  // namespace wold
