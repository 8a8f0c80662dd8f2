// Cylinders in Embree scenes, as a user-defined geometry.
#pragma once
#include <embree3/rtcore.h>

#include "geometry/accel_instance.h"

namespace etendue {

// A geometry with the lateral surface of the instance's cylinder as its only primitive. The instance must outlive it.
// The surface coordinates of hits are those of AnalyticShape::uv_of, which the caller computes.
RTCGeometry cylinder_geometry(RTCDevice device, const AccelInstance& instance);

// Commits a scene that may contain cylinders. Embree computes their bounds on other threads; ThreadSanitizer sees that this
// happens after the call starts and before it returns.
void commit_scene(RTCScene scene);

}  // namespace etendue
