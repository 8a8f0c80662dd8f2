// Scenes and geometries of Embree.
#pragma once
#include <embree3/rtcore.h>

#include <cstddef>

#include "geometry/accel_instance.h"
#include "geometry/mesh.h"

namespace etendue {

// The device of the process.
RTCDevice embree_device();

// All scenes support an opacity test per ray, so that a material can become transparent without a rebuild.
RTCScene new_embree_scene();

// Empty if the scene has no geometry.
Bounds bounds_of(RTCScene scene);

// `motion` is null or the motion of a deforming mesh. Both must outlive the geometry.
RTCGeometry triangle_geometry(const Mesh& mesh, const Motion* motion = nullptr);

// An instance of a scene at `to_world` or, unless `motion` is null, with its matrices.
RTCGeometry instance_geometry(RTCScene scene, const Mat4& to_world, const Motion* motion = nullptr);

// Adds a geometry to a scene, which owns it then.
void attach(RTCScene scene, RTCGeometry geometry, uint32_t id);

// The memory that Embree uses for all scenes together, in bytes.
size_t embree_memory();

}  // namespace etendue
