// Learning how lights are chosen (LearnedLightChoice) from the vertices of a few camera paths.
#pragma once
#include <memory>

#include "integrator/integrator.h"

namespace etendue::integrator {

// Probabilities for `sampling` at the vertices of camera paths of at most `max_depth` edges (0: no limit). Null if there
// is nothing to learn: the strategy is neither `automatic` nor `emission_auto`, the lights are a single group, or the
// choices without learning are nearly as good. The paths have random numbers of their own, so the result is independent of
// the samples of the image. It is the same for any number of threads.
std::shared_ptr<const LearnedLightChoice> learn_light_choice(const RenderContext& context, LightSampling sampling,
                                                             int max_depth);

}  // namespace etendue::integrator
