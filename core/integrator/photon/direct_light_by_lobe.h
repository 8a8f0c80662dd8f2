// Direct light at the first vertices with rough lobes, and in scattering media on the segments before them.
#pragma once
#include "transport/wavefront/equiangular_light.h"
#include "transport/wavefront/lobe_split.h"

namespace etendue::integrator {

// Shadow rays at the current vertices of camera paths, for rough and near-specular lobes. In scattering media, point and
// spot lights are also sampled at points on the segments, by equiangular distances [Kulla and Fajardo 2012].
template <class M>
class DirectLightByLobe {
 public:
  DirectLightByLobe(transport::PathWavefront<M>& paths, const transport::LobeSplit& split)
      : paths_(paths), split_(split), segments_(paths) {}

  // To be called before the first hits are processed.
  void add_on_misses() {
    if constexpr (M::kScattering) segments_.light.add_light_of_misses();
  }
  // At the current hits and on the segments before them.
  void add() {
    using namespace transport;
    if constexpr (M::kScattering) {
      segments_.light.add_light_before_hits();
      add_direct_light_by_lobe(paths_, split_, LitLobes::both, EveryHit(), [&](int hit, const LightSample& sample) {
        return segments_.light.weight_of_light_sample(hit, sample);
      });
    } else {
      add_direct_light_by_lobe(paths_, split_, LitLobes::both);
    }
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
  [[no_unique_address]] std::conditional_t<M::kScattering, Segments, NoSegments> segments_;
};

}  // namespace etendue::integrator
