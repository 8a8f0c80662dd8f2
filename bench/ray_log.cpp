#include "ray_log.h"

namespace {

thread_local etendue::RayLog* recording = nullptr;

}  // namespace

extern "C" {

void __real_rtcIntersect1(RTCScene scene, RTCIntersectContext* context, RTCRayHit* query);
void __real_rtcOccluded1(RTCScene scene, RTCIntersectContext* context, RTCRay* ray);
void __real_rtcIntersect16(const int* valid, RTCScene scene, RTCIntersectContext* context, RTCRayHit16* query);
void __real_rtcOccluded16(const int* valid, RTCScene scene, RTCIntersectContext* context, RTCRay16* rays);

void __wrap_rtcIntersect1(RTCScene scene, RTCIntersectContext* context, RTCRayHit* query) {
  if (recording) recording->add(scene, query->ray, false);
  __real_rtcIntersect1(scene, context, query);
}

void __wrap_rtcOccluded1(RTCScene scene, RTCIntersectContext* context, RTCRay* ray) {
  if (recording) recording->add(scene, *ray, true);
  __real_rtcOccluded1(scene, context, ray);
}

void __wrap_rtcIntersect16(const int* valid, RTCScene scene, RTCIntersectContext* context, RTCRayHit16* query) {
  for (unsigned i = 0; recording && i < 16; ++i)
    if (valid[i]) recording->add(scene, rtcGetRayFromRayN(reinterpret_cast<RTCRayN*>(&query->ray), 16, i), false);
  __real_rtcIntersect16(valid, scene, context, query);
}

void __wrap_rtcOccluded16(const int* valid, RTCScene scene, RTCIntersectContext* context, RTCRay16* rays) {
  for (unsigned i = 0; recording && i < 16; ++i)
    if (valid[i]) recording->add(scene, rtcGetRayFromRayN(reinterpret_cast<RTCRayN*>(rays), 16, i), true);
  __real_rtcOccluded16(valid, scene, context, rays);
}

}  // extern "C"

namespace etendue {

void RayLog::start() { recording = this; }
void RayLog::stop() { recording = nullptr; }

uint64_t RayLog::replay() const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  uint64_t hits = 0;
  for (const Query& q : queries_) {
    if (q.occlusion) {
      RTCRay ray = q.ray;
      __real_rtcOccluded1(q.scene, &context, &ray);
      hits += ray.tfar < 0;
    } else {
      RTCRayHit query;
      query.ray = q.ray;
      query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      __real_rtcIntersect1(q.scene, &context, &query);
      hits += query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    }
  }
  return hits;
}

}  // namespace etendue
