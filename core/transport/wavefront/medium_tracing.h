// Path segments through solids: the surface at their end, and their transmittance.
//
// A segment skips boundaries between equal media, and those of solids without a surface. It therefore lies in one
// medium, unless there are such solids or stochastic opacity lets it pass a boundary between different media.
//
// Colours are RGB, or the wavelengths of a path. The functions are instantiated for both.
#pragma once
#include "medium/free_flight.h"
#include "scene/compiled_scene.h"
#include "transport/wavefront/medium_colors.h"
#include "transport/wavefront/volume_vertex.h"

namespace etendue::transport {

// What is found out about heterogeneous media on a segment.
enum class MediumDetail : uint8_t {
  transmittance,  // an estimate of the transmittance
  survival,       // besides, an approximation of the probability that a flight passes (approximate_depth)
  exact,          // both without error, voxel by voxel
};

// A segment from the start of a ray to the next vertex.
template <class Color>
struct BasicMediumSegment {
  Hit hit;                           // its distance is measured from the start of the ray
  scene::MediumInterface interface;  // at the hit
  Color transmittance{1};
  // The part of `transmittance` that is due to scattering media: the probabilities that flights in each channel have no
  // collision. In heterogeneous media it depends on MediumDetail; 1 if it is `transmittance`.
  Color survival{1};
  uint64_t rays = 0;  // traced beyond the first hit
};
using MediumSegment = BasicMediumSegment<Rgb>;

// What passes a segment.
template <class Color>
struct BasicPassage {
  Color transmittance{1};
  // The probability that a flight has no collision on it (FreeFlight::survival).
  float survival = 1;
};
using Passage = BasicPassage<Rgb>;

// Completes a segment that starts in the solids of `stack`. `segment.hit` is the result of
// CompiledScene::intersect_solids for the same seed and time. A segment that hits nothing is attenuated over `length`
// metres.
template <class Color>
void complete_segment(const scene::CompiledScene& scene, const Ray& ray, float length, uint32_t seed, float time,
                      scene::MediumStack stack, BasicMediumSegment<Color>& segment,
                      const MediumColors<Color>& colors = {}, MediumDetail detail = MediumDetail::transmittance);

// The first part of a segment that lies in a scattering medium, up to the next boundary or surface.
template <class Color>
struct BasicScatteringInterval {
  const HomogeneousMedium* medium = nullptr;  // null: there is none
  float from = 0, to = 0;                     // metres from the start of the ray
  Color transmittance{1};                     // of the media before it
  scene::MediumStack stack;                   // the solids that contain it

  bool contains(float distance) const { return medium && distance > from && distance < to; }
};
using ScatteringInterval = BasicScatteringInterval<Rgb>;

// A segment that ends at a collision in a scattering medium, on a surface, or nowhere.
template <class Color>
struct BasicFlightSegment : BasicMediumSegment<Color> {
  Collision collision;
  Color emitted{0};           // radiance that media emit towards the start
  float survival_to_end = 1;  // FreeFlight::survival
  Color densities{0};         // FreeFlight::densities
  BasicScatteringInterval<Color> first;
};

// The same as complete_segment in a scene with scattering media: the segment may end at a collision before the hit,
// which then becomes empty. `transmittance` is the factor of the throughput, FreeFlight::weight.
template <class Color>
void sample_segment(const scene::CompiledScene& scene, const Ray& ray, float length, uint32_t seed, float time,
                    const scene::MediumStack& stack, BasicFreeFlight<Color> flight, BasicFlightSegment<Color>& segment,
                    const MediumColors<Color>& colors = {});

// What passes a segment without boundaries, inside a solid or, if it is null, outside of all solids.
template <class Color>
BasicPassage<Color> passage_without_boundaries(const scene::CompiledScene& scene, const Ray& ray, float length,
                                               uint32_t seed, const scene::Solid* solid, MediumDetail detail,
                                               const MediumColors<Color>& colors);

// Traces a whole segment.
template <class Color>
void trace_segment(const scene::CompiledScene& scene, const Ray& ray, float length, uint32_t seed, float time,
                   const scene::MediumStack& stack, BasicMediumSegment<Color>& segment,
                   const MediumColors<Color>& colors = {}, MediumDetail detail = MediumDetail::transmittance);

// Traces a segment whose flight selects each colour channel with the same probability. `random` is uniform in [0, 1).
// Its transmittance and the probabilities that flights pass it are exact, so that the density of its end is known: the
// mean over the channels of the extinction coefficient there, 1 on surfaces, times `survival`.
// `transmittance` is not the factor of the throughput. The interface at a collision is the medium that contains it.
void trace_flight(const scene::CompiledScene& scene, const Ray& ray, uint32_t seed, float time,
                  const scene::MediumStack& stack, float random, BasicFlightSegment<Rgb>& segment);

// What passes a connection to a point at a distance of `length` metres; black if a surface blocks it. The direction of
// the ray may have any length. Adds the number of rays traced to `rays`.
template <class Color = Rgb>
BasicPassage<Color> connection_passage(const scene::CompiledScene& scene, const Ray& ray, float length, uint32_t seed,
                                       float time, const scene::MediumStack& stack, uint64_t& rays,
                                       MediumDetail detail = MediumDetail::survival,
                                       const MediumColors<Color>& colors = {});

// The media on a ray up to the next surface, or without end: the light that they emit towards its start, and the light
// that they remove from what enters the ray at its end.                                [Lang, eq. 4.59-4.61]
template <class Color>
struct BasicMediumLightOnRay {
  Color emitted{0};  // radiance that reaches the start
  // The parts of the light from the end that reach the start, that media absorb, and that they scatter into other
  // directions. Their sum is 1 in each channel.
  Color transmitted{1}, absorbed{0}, scattered{0};
  uint64_t rays = 0;  // traced
};
using MediumLightOnRay = BasicMediumLightOnRay<Rgb>;

// Where the emission of heterogeneous media is evaluated: at random points whose number depends on the optical depth,
// or at one point of every voxel, which takes longer and is nearly exact.
enum class EmissionPoints : uint8_t { few, of_voxels };

// In heterogeneous media, estimates without bias. The ray starts in the solids of `stack`.
template <class Color = Rgb>
BasicMediumLightOnRay<Color> medium_light_on_ray(const scene::CompiledScene& scene, const Ray& ray, uint32_t seed,
                                                 float time, const scene::MediumStack& stack,
                                                 EmissionPoints points = EmissionPoints::few,
                                                 const MediumColors<Color>& colors = {});

// What passes connections that CompiledScene::occluded has tested.
class TracedConnections {
 public:
  explicit TracedConnections(const scene::CompiledScene& scene) : scene_(scene) {}

  // Whether the results of `occluded` are used. With stochastic opacity on boundaries of solids, or boundaries without
  // a surface, every connection must be traced from boundary to boundary.
  bool use_packets() const { return !scene_.solids().segments_may_cross_media(); }

  // `needs_survival`: the probability that a flight passes is used; else it is only valid in homogeneous media.
  template <class Color = Rgb>
  BasicPassage<Color> passage(bool blocked, const Ray& ray, float length, uint32_t seed, float time,
                              const scene::MediumStack& stack, uint64_t& rays, bool needs_survival = false,
                              const MediumColors<Color>& colors = {}) const {
    const MediumDetail detail = needs_survival ? MediumDetail::survival : MediumDetail::transmittance;
    const scene::Solids& solids = scene_.solids();
    const scene::Solid* medium = solids.find(stack.top());
    if (use_packets()) {
      if (!blocked && solids.any_heterogeneous()) [[unlikely]]
        return passage_without_boundaries(scene_, ray, length, seed, medium, detail, colors);
      if (!blocked) return medium ? inside(*medium, length, colors) : outside_solids(ray, length, colors);
      // A segment in a vacuum, or in a solid that overlaps no other, skips no boundary.
      if (!medium || !medium->may_overlap) return {Color(0), 0};
    }
    return connection_passage<Color>(scene_, ray, length, seed, time, stack, rays, detail, colors);
  }

 private:
  template <class Color>
  static BasicPassage<Color> through(const Color& transmittance, bool scatters) {
    return {transmittance, scatters ? average(transmittance) : 1};
  }
  template <class Color>
  static BasicPassage<Color> inside(const scene::Solid& solid, float length, const MediumColors<Color>& colors) {
    return through<Color>(colors.transmittance(solid, length), solid.medium.scatters());
  }
  template <class Color>
  BasicPassage<Color> outside_solids(const Ray& ray, float length, const MediumColors<Color>& colors) const {
    const scene::AtmosphereMedium* atmosphere = scene_.solids().atmosphere();
    if (!atmosphere) return {};
    const float metres = atmosphere->length_inside(ray, {0, length / std::sqrt(length_squared(ray.direction))});
    return through<Color>(colors.of(atmosphere->medium).transmittance(metres), atmosphere->medium.scatters());
  }

  const scene::CompiledScene& scene_;
};

}  // namespace etendue::transport
