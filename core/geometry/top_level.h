// The structure over all instances of a scene; part of Accel.
#pragma once
#include <embree3/rtcore.h>

#include <deque>
#include <memory>
#include <span>
#include <vector>

#include "geometry/accel_instance.h"
#include "geometry/mesh.h"

namespace etendue {

class TopLevel {
 public:
  // Geometry ids are the indices of the instances.
  explicit TopLevel(std::span<const AccelInstance> instances);
  ~TopLevel();
  TopLevel(const TopLevel&) = delete;
  TopLevel& operator=(const TopLevel&) = delete;

  RTCScene scene() const { return scene_; }
  const Bounds& bounds() const { return bounds_; }
  size_t size() const { return size_; }  // in instances

  bool has_shapes() const { return !shapes_.empty(); }
  // Whether a hit is on an analytic shape. The arguments are Embree's instance and geometry ids.
  bool is_shape(uint32_t instance, uint32_t geometry) const {
    return instance == RTC_INVALID_GEOMETRY_ID && geometry < shape_numbers_.size() && shape_numbers_[geometry] != kNone;
  }
  // The coordinates (u, v) of a hit on an analytic shape, which Embree does not compute.
  Vec2 shape_coordinates(uint32_t geometry, const Vec3& point, float time) const;

 private:
  static constexpr uint32_t kNone = 0xffffffffU;
  void add(uint32_t number, const AccelInstance& instance);
  void keep(const AccelInstance& instance);

  RTCScene scene_;
  size_t size_;
  Bounds bounds_;
  std::vector<std::shared_ptr<const void>> kept_;  // what owns the buffers that Embree reads
  std::deque<AccelInstance> shapes_;               // does not move its elements, to which Embree has pointers
  std::vector<uint32_t> shape_numbers_;            // by instance: index into `shapes_`, or kNone; empty without shapes
};

}  // namespace etendue
