/// @file  Embree 3 or 4, whichever is installed: one name for each call that differs between them.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace flytri::simulated {

/// Rays that start or end close to each other are coherent: Embree then answers faster.
enum class RayOrder { kAny, kCoherent };

#if RTC_VERSION_MAJOR >= 4

template <typename Arguments>
Arguments embree_arguments(void (*initialize)(Arguments*), RayOrder order) {
  Arguments arguments;
  initialize(&arguments);
  if (order == RayOrder::kCoherent) arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  return arguments;
}

inline void find_hit(RTCScene scene, RTCRayHit& query) { rtcIntersect1(scene, &query, nullptr); }

inline void find_hits(const int* valid, RTCScene scene, RTCRayHit8& query, RayOrder order) {
  auto arguments = embree_arguments(rtcInitIntersectArguments, order);
  rtcIntersect8(valid, scene, &query, &arguments);
}

inline void find_blocker(RTCScene scene, RTCRay& query) { rtcOccluded1(scene, &query, nullptr); }

inline void find_blockers(const int* valid, RTCScene scene, RTCRay8& query, RayOrder order) {
  auto arguments = embree_arguments(rtcInitOccludedArguments, order);
  rtcOccluded8(valid, scene, &query, &arguments);
}

#else

inline RTCIntersectContext embree_context(RayOrder order) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  if (order == RayOrder::kCoherent) context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return context;
}

/// Sets `query.hit`, and `tfar` to its distance; geomID stays invalid where the ray meets nothing.
inline void find_hit(RTCScene scene, RTCRayHit& query) {
  auto context = embree_context(RayOrder::kAny);
  rtcIntersect1(scene, &context, &query);
}

inline void find_hits(const int* valid, RTCScene scene, RTCRayHit8& query, RayOrder order) {
  auto context = embree_context(order);
  rtcIntersect8(valid, scene, &context, &query);
}

/// Sets `query.tfar` below zero where something lies on the ray.
inline void find_blocker(RTCScene scene, RTCRay& query) {
  auto context = embree_context(RayOrder::kAny);
  rtcOccluded1(scene, &context, &query);
}

inline void find_blockers(const int* valid, RTCScene scene, RTCRay8& query, RayOrder order) {
  auto context = embree_context(order);
  rtcOccluded8(valid, scene, &context, &query);
}

#endif

}  // namespace flytri::simulated
