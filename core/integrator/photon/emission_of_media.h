// The emission of media on the segments of camera paths that look up photons. Photons that start in media find all
// other light of these media.
#pragma once
#include "transport/wavefront/medium_light.h"

namespace etendue::integrator {

// Segments find emission alone: there are no light samples.
struct OnlySegments {
  static transport::TechniqueWeight emission(int) { return {1, false}; }
  static transport::TechniqueWeight light_sample(int) { return {0, false}; }
};

template <class M>
class EmissionOfMedia : public transport::MediumLight<M, OnlySegments> {
 public:
  explicit EmissionOfMedia(transport::PathWavefront<M>& paths)
      : transport::MediumLight<M, OnlySegments>(paths, transport::kLobeSplitHeuristic) {}
};

}  // namespace etendue::integrator
