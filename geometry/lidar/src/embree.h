// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Embree 3 (Debian 12) and 4 (Debian 13): what they name differently.
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace vericone::lidar {

#if RTC_VERSION_MAJOR >= 4
using RayContext = RTCRayQueryContext;

/// Callbacks get `context`, whose content is Embree's.
inline void first_hit(RTCScene scene, RayContext& context, RTCRayHit& ray) {
  rtcInitRayQueryContext(&context);
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context;
  rtcIntersect1(scene, &ray, &arguments);
}
#else
using RayContext = RTCIntersectContext;

/// Callbacks get `context`, whose content is Embree's.
inline void first_hit(RTCScene scene, RayContext& context, RTCRayHit& ray) {
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &ray);
}
#endif

}  // namespace vericone::lidar
