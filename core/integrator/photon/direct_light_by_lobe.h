// Direct light at the first vertices with rough lobes, and in scattering media on the segments before them.
#pragma once
#include "integrator/photon/shallow_collisions.h"
#include "transport/wavefront/equiangular_light.h"

namespace etendue::integrator {

// Shadow rays at the current vertices of camera paths, for rough and near-specular lobes, or for the lobes by which paths
// continue alone. In scattering media, point and spot lights are also sampled at points on the segments, by equiangular
// distances [Kulla and Fajardo 2012].
template <class M>
class DirectLightByLobe {
 public:
  DirectLightByLobe(transport::PathWavefront<M>& paths, const transport::LobeSplit& split,
                    const ShallowCollisions<M>& shallow)
      : paths_(paths), split_(split), shallow_(shallow), segments_(paths) {}

  // To be called before the first hits are processed.
  void add_on_misses() {
    if constexpr (M::kScattering) segments_.light.add_light_of_misses();
  }
  // At the current hits and on the segments before them.
  void add() {
    using namespace transport;
    if constexpr (M::kScattering) {
      segments_.light.add_light_before_hits();
      const auto delta_weight = [&](int hit, const LightSample& sample) {
        return segments_.light.weight_of_light_sample(hit, sample);
      };
      add_direct_light_by_lobe(paths_, split_, LitLobes::both, EveryHit(), delta_weight, shallow_);
    } else {
      add_direct_light_by_lobe(paths_, split_, LitLobes::both);
    }
  }
  // The light that rough lobes do not receive from photons.
  void add_near_specular() {
    using namespace transport;
    if constexpr (M::kScattering)
      add_direct_light_by_lobe(paths_, split_, LitLobes::near_specular, EveryHit(), OnlyTechnique(), shallow_);
    else
      add_direct_light_by_lobe(paths_, split_, LitLobes::near_specular);
  }

 private:
  struct Segments {
    explicit Segments(transport::PathWavefront<M>& paths)
        : light(paths, LightStrategy::automatic, transport::kLobeSplitHeuristic) {}
    transport::EquiangularLight<M> light;
  };
  struct NoSegments {
    explicit NoSegments(transport::PathWavefront<M>&) {}
  };

  transport::PathWavefront<M>& paths_;
  const transport::LobeSplit split_;
  const ShallowCollisions<M>& shallow_;
  [[no_unique_address]] std::conditional_t<M::kScattering, Segments, NoSegments> segments_;
};

}  // namespace etendue::integrator
