// Solids: closed regions of one medium, and which of them contain a point.                  [Schmidt and Budge 2002]
//
// A solid is the region enclosed by those primitives of one node that have the same index of refraction and the same
// medium. Thin-walled materials enclose no solid.
//
// Solids are numbered by priority. Where solids overlap, the smallest number is the medium. A higher
// Material::medium_priority has a smaller number; among equal ones, solids with a surface precede those that only bound
// a medium, then the solid with the smaller bounding box (by surface area), then the order of the file.
//
// Light passes the boundary of a solid without a surface (Material::boundary_only) without scattering.
// Light passes a boundary inside a solid of higher priority without scattering, since the medium is the same on both
// sides. Boundaries of different solids that coincide up to rounding form one interface between the media in front of
// and behind all of them. Its scattering function is that of the solid with the highest priority.
//
// Integrators agree only if the meshes of solids are closed.
#pragma once
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "geometry/accel.h"
#include "geometry/mesh.h"
#include "material/surface_material.h"
#include "medium/medium_emitters.h"
#include "scene/atmosphere_medium.h"
#include "scene/forward.h"
#include "scene/medium_stack.h"

namespace etendue::scene {

struct Solid {
  float eta = 1;          // index of refraction
  RefractiveIndex index;  // the same by wavelength
  Rgb attenuation_color{1};
  float attenuation_distance = kInfinity;  // metres
  bool absorbs = false;
  Rgb absorption{0};                       // in addition to the attenuation colour, 1/m
  HomogeneousMedium medium;                // if it scatters or emits: with the absorption of both
  AbsorptionSpectrum absorption_spectrum;  // of both
  // The medium if its density varies, in place of the members above; else null.
  std::shared_ptr<const HeterogeneousMedium> heterogeneous = nullptr;
  bool has_surface = true;   // false: light passes the boundary without scattering
  int priority = 0;          // Material::medium_priority
  bool may_overlap = false;  // its bounds intersect or touch those of another solid
  bool is_emissive = false;  // light is sampled on its boundary, so every path that reaches it has a vertex there
  bool has_alpha = false;    // rays may pass its boundary by opacity
  bool is_moving = false;    // while the shutter is open
  uint32_t node = 0;
  uint32_t material = 0;  // of its first primitive
  Bounds bounds;          // in world space, over the shutter interval
  float offset = 0;       // bound of the rounding error of points on its boundary, metres

  // Whether light is scattered or emitted inside, or the density varies.
  bool is_volume() const { return heterogeneous || medium.scatters() || medium.emits(); }

  // Beer's law: the transmittance of a segment of this length in metres in a homogeneous medium. [KHR_materials_volume]
  Rgb transmittance(float distance) const {
    if (!absorbs) return Rgb(1);
    if (!is_black(medium.extinction) || !is_black(absorption)) return transmittance_of_medium(distance);
    return attenuation(distance);
  }
  // The same at the wavelengths of a path.
  SampledSpectrum transmittance_at(const Wavelengths& wavelengths, float distance) const {
    if (!absorbs) return SampledSpectrum(1);
    if (is_volume()) return medium.at(wavelengths).transmittance(distance);
    MediumCoefficients<SampledSpectrum> absorbing;
    absorbing.extinction = absorption_spectrum.at(wavelengths);
    return absorbing.transmittance(distance);
  }

 private:
  Rgb attenuation(float distance) const {
    const float x = distance / attenuation_distance;
    return {std::pow(attenuation_color.r, x), std::pow(attenuation_color.g, x), std::pow(attenuation_color.b, x)};
  }
  Rgb transmittance_of_medium(float distance) const;
};

// The solids of a scene by number. Solids that have no medium and touch no other one are left out in a scene without an
// atmosphere: refraction against a vacuum is exact for them.
class Solids {
 public:
  Solids() = default;
  // Sets InstanceData::solid of every instance. `accel` is the acceleration structure of the instances. `atmosphere`
  // may be null. `world` has the matrices of all nodes, for media whose density varies.
  Solids(InstanceArray& instances, const std::vector<SurfaceMaterial>& materials, std::shared_ptr<const Accel> accel,
         std::shared_ptr<const AtmosphereMedium> atmosphere = nullptr, const std::vector<Mat4>& world = {});

  bool empty() const { return solids_.empty(); }
  size_t size() const { return solids_.size(); }
  // Null for kNoSolid, a vacuum.
  const Solid* find(uint32_t number) const { return number == kNoSolid ? nullptr : &solids_[number]; }
  const Solid& operator[](uint32_t number) const { return solids_[number]; }

  // Whether solids may overlap or touch, so that a boundary may separate equal media or coincide with another one.
  bool may_overlap() const { return may_overlap_; }
  // Whether stochastic opacity may let rays into a solid.
  bool any_has_alpha() const { return any_has_alpha_; }
  // Whether a segment between two vertices may pass from one medium into another.
  bool segments_may_cross_media() const { return any_has_alpha_ || any_without_surface_; }
  // The medium around all solids, or null for a vacuum.
  const AtmosphereMedium* atmosphere() const { return atmosphere_.get(); }
  // Whether light can be scattered or emitted between surfaces, or the density of a medium varies.
  bool scatters() const { return scatters_; }
  // Whether the density of a medium varies.
  bool any_heterogeneous() const { return any_heterogeneous_; }
  // Whether a medium emits light.
  bool any_medium_emits() const { return any_medium_emits_; }
  // Directions towards media that emit light. Solids with a surface are left out, which light samples do not pass.
  const MediumEmitters& emitters() const { return emitters_; }
  // Points in all media that emit light and are bounded.
  const MediumEmitters& emission_points() const { return emission_points_; }
  // The radiance per metre that the medium in these solids, or the atmosphere, emits at a point.
  Rgb emission_at(const MediumStack& stack, const Vec3& position) const;
  // Why a medium cannot be rendered, with a remedy; empty if all can.
  const std::string& medium_error() const { return medium_error_; }

  // The solids that contain a point, except for one of them. Counts the boundaries along two rays in fixed directions.
  // They can disagree if a ray hits an edge or a mesh is open; a third ray decides then.
  MediumStack containing(const InstanceArray& instances, const Vec3& point, float time,
                         uint32_t except = kNoSolid) const;

  // Finds the media on both sides of a boundary that a ray hits after a segment in the solids of `stack`. Returns false
  // if they are equal and no light is sampled on the boundary: the ray continues. If boundaries coincide, `hit` is
  // replaced by the hit on the boundary of the highest priority.
  bool find_interface(const InstanceArray& instances, const MediumStack& stack, float time, Hit& hit,
                      MediumInterface& interface) const;

 private:
  void assign_priorities(InstanceArray& instances, const std::vector<SurfaceMaterial>& materials);
  void find_overlaps();
  // Sets `heterogeneous` of solids and the properties of all media together.
  void set_media(const InstanceArray& instances, const std::vector<SurfaceMaterial>& materials,
                 const std::vector<Mat4>& world);
  void find_emitters();
  void add_coincident(const InstanceArray& instances, float time, Hit& hit, MediumInterface& interface) const;

  std::vector<Solid> solids_;
  std::shared_ptr<const Accel> accel_;
  std::shared_ptr<const AtmosphereMedium> atmosphere_;
  bool may_overlap_ = false;
  bool any_has_alpha_ = false;
  bool any_without_surface_ = false;
  bool scatters_ = false, any_heterogeneous_ = false, any_medium_emits_ = false;
  MediumEmitters emitters_, emission_points_;
  std::string medium_error_;
  float offset_ = 0;  // the largest offset of solids that may overlap
};

}  // namespace etendue::scene
