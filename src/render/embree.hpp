#pragma once
// Embree 3 or 4 under one set of names, with handles that release themselves.

#include <memory>

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#define WOLD_EMBREE 4
#else
#include <embree3/rtcore.h>
#define WOLD_EMBREE 3
#endif

namespace wold::embree {

struct Release {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<RTCDeviceTy, Release>;
using Scene = std::unique_ptr<RTCSceneTy, Release>;

inline void intersect(RTCScene scene, RTCRayHit& ray, bool coherent) {
#if WOLD_EMBREE == 4
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
  rtcIntersect1(scene, &ray, &arguments);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags =
      coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  rtcIntersect1(scene, &context, &ray);
#endif
}

inline bool occluded(RTCScene scene, RTCRay& ray) {
#if WOLD_EMBREE == 4
  rtcOccluded1(scene, &ray, nullptr);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene, &context, &ray);
#endif
  return ray.tfar < 0;
}

}  // namespace wold::embree
