// Solids: closed regions of one medium, and which of them contain a point.                  [Schmidt and Budge 2002]
//
// A solid is what the primitives of one node enclose that share one inside: index of refraction, attenuation colour and
// attenuation distance. Thin walls are no solids. Solids are numbered by priority: a smaller number wins where solids
// overlap. The solid with the smaller bounding box (by its surface area) comes first, then the earlier one in the file.
// The file format has no explicit priorities; they would come before both.
//
// Light passes a boundary inside a solid of higher priority without an event: the medium is the same on both sides.
// Boundaries of different solids that lie in one surface, up to rounding, are one interface between the media before
// and behind all of them. Its scattering function is that of the solid with the highest priority.
//
// Meshes of solids must be closed for all methods to agree.
#pragma once
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "geometry/accel.h"
#include "geometry/mesh.h"
#include "material/surface_material.h"
#include "scene/medium_stack.h"

namespace etendue::scene {

struct InstanceData;
struct Scene;

struct Solid {
  float eta = 1;  // index of refraction
  Rgb attenuation_color{1};
  float attenuation_distance = kInfinity;  // metres
  bool absorbs = false;
  bool meets = false;   // its bounds meet those of another solid
  bool emits = false;   // light is sampled on its boundary: a path never passes it without an event
  bool porous = false;  // rays may pass its boundary by opacity
  bool moves = false;   // while the shutter is open
  uint32_t node = 0;
  uint32_t material = 0;  // of its first primitive
  Bounds bounds;          // in world space, over the time that the shutter is open
  float offset = 0;       // largest rounding error of points on its boundary, metres

  // What is left of light after so many metres.                                     KHR_materials_volume; Beer's law
  Rgb transmittance(float distance) const {
    if (!absorbs) return Rgb(1);
    const float x = distance / attenuation_distance;
    return {std::pow(attenuation_color.r, x), std::pow(attenuation_color.g, x), std::pow(attenuation_color.b, x)};
  }
};

// The solids of a scene by number. Empty where each solid is clear and alone: refraction against a vacuum is exact
// then.
class Solids {
 public:
  Solids() = default;
  // Writes InstanceData::solid. The acceleration structure is that of the instances.
  Solids(std::vector<InstanceData>& instances, const std::vector<SurfaceMaterial>& materials,
         std::shared_ptr<const Accel> accel);

  bool empty() const { return solids_.empty(); }
  size_t size() const { return solids_.size(); }
  // Null for kNoSolid, a vacuum.
  const Solid* find(uint32_t number) const { return number == kNoSolid ? nullptr : &solids_[number]; }
  const Solid& operator[](uint32_t number) const { return solids_[number]; }

  // Whether there may be boundaries without an event, and boundaries that lie in one surface.
  bool meet() const { return meet_; }
  // Whether rays may enter a solid without an event.
  bool porous() const { return porous_; }

  // The solids that contain a point, but for one of them. Rays in fixed directions count the boundaries that they
  // cross; where the first two disagree, as they may where a ray runs through an edge or a mesh is open, a third
  // decides.
  MediumStack at(const std::vector<InstanceData>& instances, const Vec3& point, float time,
                 uint32_t but = kNoSolid) const;

  // What a ray that has travelled through the solids of `stack` finds where it hits the boundary of a solid. False if
  // both sides are the same medium and no light is sampled there: the ray goes on. Where boundaries lie in one surface,
  // the hit becomes that on the boundary of the highest priority.
  bool find_interface(const std::vector<InstanceData>& instances, const MediumStack& stack, float time, Hit& hit,
                      MediumInterface& found) const;

 private:
  void number(std::vector<InstanceData>& instances, const std::vector<SurfaceMaterial>& materials);
  void find_meetings();
  void add_coincident(const std::vector<InstanceData>& instances, float time, Hit& hit, MediumInterface& found) const;

  std::vector<Solid> solids_;
  std::shared_ptr<const Accel> accel_;
  bool meet_ = false;
  bool porous_ = false;
  float offset_ = 0;  // the largest of solids that meet
};

}  // namespace etendue::scene
