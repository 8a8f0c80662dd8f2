// The terms of the equation of transfer along camera rays                                   [Lang, eq. 4.59-4.61]
//
// The radiance of a pixel is that at the first surface (or of the environment), changed by the media before it:
//
//   L = surface - absorption - out_scattering + emission + in_scattering
//
//   surface         radiance of the surface towards the camera, without the media before it
//   absorption      the part of it that these media absorb
//   out_scattering  the part of it that they scatter into other directions
//   emission        radiance that they emit towards the camera and that reaches it
//   in_scattering   radiance that they scatter towards the camera and that reaches it: the paths EV.*L
#pragma once
#include "integrator/integrator.h"

namespace etendue::integrator {

struct TransportTerms {
  Rgb surface{0}, absorption{0}, out_scattering{0}, emission{0}, in_scattering{0};
};

// Samples the terms for the pixels of a block, row by row, without bias. Paths have at most `max_depth` edges; 0: no
// limit. Nothing if the task was cancelled.
std::optional<uint64_t> sample_transport_terms(const RenderContext& context, const PixelBlock& block, int max_depth,
                                               const TaskContext& task_context, std::span<TransportTerms> terms);

}  // namespace etendue::integrator
