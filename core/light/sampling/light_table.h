// All lights of a compiled scene: sampling from receivers, emission of rays, and the densities of both.
//
// A light is a primitive of an area light (an emissive triangle, a sphere, a disk), a light without extent, or the
// environment; they are numbered in this order. Samples carry their density with its measure: per solid angle at the
// receiver, discrete for a delta light.
//
// Lights that move while the shutter is open are sampled at the time of the query. They are chosen by their power at
// the middle of the shutter interval, or by the tree with bounds over the whole interval.
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "light/sampling/area_light_primitives.h"
#include "light/sampling/environment_map.h"
#include "light/sampling/environment_portals.h"
#include "light/sampling/light_selector.h"
#include "light/sampling/scene_sphere.h"

namespace etendue {

struct PlacedLight;
struct TriangleBatch;

class LightTable {
 public:
  LightTable();
  // `movers` has an entry per instance if any triangle moves. AreaLightTriangle::shape is an index into `shapes`.
  LightTable(std::vector<AreaLightTriangle> triangles, std::vector<PlacedLight> placed,
             std::shared_ptr<const EnvironmentMap> environment, const Bounds& scene_bounds,
             std::vector<MovingEmitter> movers = {}, std::vector<AnalyticAreaLight> shapes = {},
             std::vector<EnvironmentPortal> portals = {});
  LightTable(std::vector<AreaLightTriangle> triangles, std::vector<PlacedLight> placed, const Environment& environment,
             const Bounds& scene_bounds);

  // Without lights, or without any power.
  bool empty() const { return selector_.empty(); }
  // Whether the normals of receivers change the choice of a light.
  bool uses_normals(LightSampling sampling) const { return selector(sampling).uses_tree(sampling.strategy); }
  // Whether there is nothing to sample.
  bool empty(LightSampling sampling) const { return selector(sampling).empty(); }
  size_t size() const { return selector_.size(); }
  const std::vector<AreaLightTriangle>& triangles() const { return primitives_.triangles(); }
  const std::vector<PlacedLight>& placed() const { return *placed_; }
  size_t placed_count() const;
  // The luminance of the flux of all lights into the scene, lm.
  float power() const { return power_; }
  const EnvironmentMap& environment() const { return *environment_; }
  // For another table of the same environment: its preparation takes long for large maps.
  const std::shared_ptr<const EnvironmentMap>& shared_environment() const { return environment_; }
  const EnvironmentPortals& portals() const { return portals_; }

  // The normal of an area light at a point, given by barycentric weights or the surface coordinates of a shape.
  Vec3 normal_at(uint32_t light, Vec2 at, float time) const { return primitives_.normal_at(light, at, time); }

  // One sample per query, by a strategy that chooses a single light. The pdf is 0 if the light cannot reach the
  // receiver (a triangle seen edge-on, a receiver outside a spot's cone) or if there are no lights.
  void sample(const LightQueries& queries, LightSample* samples, LightSampling sampling) const;
  // Sources are lights as a user counts them: the emissive triangles of an instance, a light without extent, the
  // environment. Sources without power do not count.
  size_t source_count(LightSampling sampling = LightStrategy::every) const { return selector(sampling).source_count(); }
  // As `sample`, from one source: the pdf does not include the choice of the source.
  void sample_source(size_t source, const LightQueries& queries, LightSample* samples,
                     LightSampling sampling = LightStrategy::every) const;

  // Groups of lights that learned probabilities are for. As `sample`, from one of them: the pdf does not include the
  // choice of the group.
  size_t group_count(LightSampling sampling) const { return selector(sampling).group_count(); }
  // The probability of a group without learned probabilities, averaged over receivers.
  float usual_probability_of_group(size_t group, LightSampling sampling) const {
    return selector(sampling).usual_probability_of_group(group, sampling.strategy);
  }
  void sample_group(size_t group, const LightQueries& queries, LightSample* samples, LightSampling sampling) const;

  // The densities, per solid angle, with which the strategy samples a direction that another technique found: to a
  // point of an area light, or to the environment, which portals sample by position. Of LightStrategy::every they are
  // those of the light's source.
  float pdf_triangle(uint32_t light, const LightReceiver& from, const Vec3& at, float time,
                     LightSampling sampling) const;
  float pdf_environment(const Vec3& from, const Vec3& direction, LightSampling sampling) const;
  // The same, and the radiance of the environment from this direction.
  EnvironmentMap::Value environment_value(const Vec3& from, const Vec3& direction, LightSampling sampling) const;
  // The probability of choosing a light.
  float probability(uint32_t light, const LightReceiver& from, LightSampling sampling) const {
    if (sampling.learned) return selector(sampling).probability_by_group(*sampling.learned, light, from);
    return selector(sampling).probability(light, from, sampling.strategy);
  }
  // The probability of a light as the start of an emitted ray.
  float emission_probability(uint32_t light) const { return selector_.probability_by_power(light); }
  // The number of the environment, if it is a light.
  uint32_t environment_number() const { return static_cast<uint32_t>(size() - 1); }

  // Whether there are lights at points (point lights, spot lights) that emit.
  bool has_point_lights() const { return !points_by_power_.empty(); }
  // A light at a point. It emits in directions whose cosine to the axis is at least `cone_cosine`.
  struct PointLight {
    uint32_t light;
    float probability;  // of its choice by power among all lights at points
    Vec3 position, axis;
    float cone_cosine;
  };
  // Nothing if the light is of another kind. There must be lights at points.
  std::optional<PointLight> point_light(uint32_t light, float time) const;
  // Chosen by power. There must be lights at points as well.
  std::optional<PointLight> choose_point_light(float u, float time) const {
    return point_light(points_by_power_.sample(u).index, time);
  }
  // The sample of a light without extent. Its pdf is 1, or 0 if the light does not reach the receiver.
  LightSample sample_placed(uint32_t light, const Vec3& from, float time) const;

  // A ray that leaves a light, chosen by power. `e` must be newly constructed; its weight stays 0 if there is no ray.
  void sample_emission(const EmissionRandom& random, Emission& e) const;
  Emission sample_emission(const EmissionRandom& random) const {
    Emission e;
    sample_emission(random, e);
    return e;
  }
  // The same of a light that the tree chooses for a receiver. The densities contain this choice.
  void sample_emission_by_tree(const LightReceiver& receiver, const EmissionRandom& random, Emission& e) const;
  // Another direction from the same point; of a light at infinity another point of the same direction. Reads kind,
  // light, time, position and, of a light at infinity, direction.
  void resample_emission(Vec2 u, Emission& e) const;
  // The densities of `sample_emission` for rays that another technique found: towards a receiver that sampled the
  // light, from an area light at this cosine to its normal, from the environment against this direction.
  EmissionDensity emission_density(const LightSample& sample, float time = 0) const {
    return sample.kind == LightKind::triangle
               ? emission_density(sample.light, primitives_.cosine_at(sample, time), time)
               : emission_density_of_other(sample);
  }
  EmissionDensity emission_density(uint32_t light, float cosine, float time = 0) const {
    if (empty() || light >= primitives_.size()) return {};
    return primitives_.emission_density(light, selector_.probability_by_power(light), cosine, time);
  }
  EmissionDensity environment_emission_density(const Vec3& direction) const;

  // What a light without extent emits in a direction: cd of a point light with its range window at a distance, lx
  // of a directional light.
  Rgb emitted_by_placed(uint32_t light, const Vec3& direction, float distance, float time) const;
  // The share of a light's emission that remains after a distance in metres (KHR_lights_punctual); 1 of most lights.
  float range_window(uint32_t light, float distance) const;

 private:
  void sample_emission_of(LightSelector::Choice choice, const EmissionRandom& random, Emission& e) const;
  void find_points(std::span<const SelectableLight> lights);

  // `choose(i)` is the light of query i with its probability.
  template <class Choose>
  void sample_chosen(const LightQueries& queries, LightSample* samples, LightSampling sampling, Choose&& choose) const;
  template <class Choose>
  void sample_batch(const LightQueries& queries, TriangleBatch& batch, LightSample* samples, LightSampling sampling,
                    Choose&& choose) const;
  // Sets the pdf of a chosen light that is no area light, without the choice; false if the light does not reach `from`.
  bool sample_other(const Vec3& from, Vec2 u, float time, LightSampling sampling, LightSample& sample) const;
  bool sample_environment(const Vec3& from, Vec2 u, LightSampling sampling, LightSample& sample) const;

  void sample_placed_emission(const EmissionRandom& random, float probability, Emission& e) const;
  void sample_environment_emission(const EmissionRandom& random, float probability, Emission& e) const;
  EmissionDensity emission_density_of_other(const LightSample& sample) const;

  // The light without extent of this number, or null: the light is an area light or the environment.
  const PlacedLight* placed_at(uint32_t light) const;
  // Portals guide the sampling of the environment already.
  bool is_compensated(LightSampling sampling) const {
    return sampling.is_compensated && !environment_->black() && portals_.empty();
  }
  const LightSelector& selector(LightSampling sampling) const {
    return is_compensated(sampling) ? compensated_selector_ : selector_;
  }

  AreaLightPrimitives primitives_;
  std::shared_ptr<const std::vector<PlacedLight>> placed_;
  std::shared_ptr<const EnvironmentMap> environment_;
  EnvironmentPortals portals_;
  SceneSphere scene_;
  LightSelector selector_;
  LightSelector compensated_selector_;
  AliasTable points_by_power_;  // of all lights, zero for those that are not at points; empty if there are none
  float power_ = 0;
};

}  // namespace etendue
