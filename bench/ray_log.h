// Records the rays that the program traces with Embree and replays them without shading, as the baseline of the ray
// benchmark.
//
// The linker replaces Embree's functions by these (--wrap), so that the program needs no instrumentation.
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
  // Traces all rays with rtcIntersect1 and rtcOccluded1 in a loop without other work. Returns the number of hits.
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
