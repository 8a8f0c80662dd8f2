// Records the rays that the program asks Embree for, to replay them bare: the yardstick of the ray benchmark.
//
// The linker puts these functions in front of Embree's (--wrap), so the program itself has no trace of it.
#pragma once
#include <embree3/rtcore.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace etendue {

class RayLog {
 public:
  void start();
  void stop();
  size_t size() const { return queries_.size(); }
  // Traces all of them by rtcIntersect1 and rtcOccluded1 with nothing in between; returns how many hit.
  uint64_t replay() const;

  void add(RTCScene scene, const RTCRay& ray, bool occlusion) { queries_.push_back({ray, scene, occlusion}); }

 private:
  struct Query {
    RTCRay ray;
    RTCScene scene;
    bool occlusion;
  };
  std::vector<Query> queries_;
};

}  // namespace etendue
