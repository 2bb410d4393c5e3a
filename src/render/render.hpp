#pragma once
// Tracing a picture: every pixel, a range of samples, into a film.

#include <cstdint>

#include "base/parameters.hpp"
#include "base/progress.hpp"
#include "render/film.hpp"
#include "render/path_tracer.hpp"

namespace wold {

struct RenderSettings {
  IVec2 size{1280, 720};
  int samples = 64;
  int max_bounces = 6;
  float dicing = 2;           ///< pixels between samples of the ground
  float filter_width = 1.6F;  ///< pixels
};

Description<RenderSettings> describe(const RenderSettings&);

/// Samples [first, last) of every pixel, by absolute index.
struct SampleRange {
  std::uint32_t first = 0;
  std::uint32_t last = 0;
};

struct RenderCounts {
  std::uint64_t paths = 0;
  std::uint64_t rays = 0;
  std::uint64_t embree_ticks =
      0;  ///< of the time stamp counter, summed over threads; 0 when not timed
  std::uint64_t all_ticks = 0;
  double first_pass_seconds = 0;  ///< until every pixel had its first sample
};

struct RenderJob {
  SampleRange range;
  std::uint64_t seed = 0;
  bool timed = false;  ///< fills the ticks of RenderCounts
};

/// Traces the samples in passes over the whole picture, so that the film is a picture at any time.
/// On cancellation throws Error(cancelled), and the film keeps what was traced. The same bits for
/// any number of threads.
RenderCounts trace_picture(const RayScene& scene, const CameraRays& camera,
                           const RenderSettings& settings, const RenderJob& job, Film& film,
                           Progress& progress);

}  // namespace wold
