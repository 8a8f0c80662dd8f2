// One sample of a pixel as the integrator computed it: the vertices of its paths, with densities, weights and
// contributions.
//
// The block of pixels that contains the pixel is sampled again as in a rendering, so the sample is bit-identical to
// that of the film.
#pragma once
#include <memory>
#include <string>

#include "base/result.h"
#include "render/document.h"
#include "transport/wavefront/path_recorder.h"

namespace etendue::render {

struct PixelTrace {
  Vec2i pixel{0};
  uint32_t sample = 0;     // counted from 0
  std::string integrator;  // name
  // The rest points into the scene.
  std::shared_ptr<const scene::CompiledScene> scene;
  transport::PathRecord record;
  Rgb radiance{0};  // of the sample as the film receives it; equal to record.radiance
};

// Why the samples of a document cannot be traced; empty if they can.
std::string why_untraceable(const Document& document);
// The same without names, for a message that names the integrator by its label: "its paths contribute to any pixel".
std::string untraceable_reason(const Document& document);

// The error says what is wrong: the integrator, or a pixel outside the image.
Result<PixelTrace> trace_pixel(const Document& document, std::shared_ptr<const scene::CompiledScene> scene, Vec2i pixel,
                               uint32_t sample);

}  // namespace etendue::render
