// The samples of a single pixel, one by one, and the random numbers that they are computed from.
//
// Order and random numbers are those of a rendering: sample n belongs to half-buffer n % 2 and uses that half-buffer's
// own numbers. The mean of the first n samples equals the pixel of a film with n samples up to rounding, because the
// paths of the pixel are traced alone here, and in packets with those of neighbouring pixels there.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "render/prepared_document.h"
#include "sampling/counting_sampler.h"

namespace etendue::render {

class PixelSamples {
 public:
  // Whether the integrator of the document computes samples per pixel. Integrators that splat, or that first compute
  // data for all pixels, do not.
  static bool supports(const Document& document);

  // The pixel must lie within the image, and the document be supported.
  PixelSamples(const Document& document, std::shared_ptr<const scene::CompiledScene> scene, Vec2i pixel);

  // Computes the radiance of samples first, first + 1, ... in cd/m^2. Invalid samples are zero, as in a film.
  // Replication 0 is that of the rendering; the others are independent repetitions with other seeds. False if it was
  // cancelled because `keep_going` returned false.
  bool draw(
      uint32_t first, uint32_t replication, std::span<Rgb> samples,
      const std::function<bool()>& keep_going = [] { return true; });

  // Which dimensions the samples 0, ..., samples - 1 of the rendering draw. Nothing if it was cancelled.
  std::optional<DimensionCounts> drawn_dimensions(
      uint32_t samples, const std::function<bool()>& keep_going = [] { return true; });

 private:
  integrator::PixelBlock block_of(uint32_t sample) const {
    return {.x = pixel_.x, .y = pixel_.y, .width = 1, .height = 1, .sample = sample};
  }

  PreparedDocument prepared_;
  Vec2i pixel_;
};

// One random number of a path: its use, and its place among the sampler's dimensions.
struct Dimension {
  // "vertex-1.light-choice" and "Vertex 1: light choice". Vertex 1 is the first hit.
  std::string name, label;
  uint32_t block = 0;
  int index = 0;  // within the block
};

// The dimensions of the camera and of the first `vertices` path vertices.
std::vector<Dimension> path_dimensions(uint32_t vertices);

// Two dimensions of the first `count` samples of a pixel, in [0, 1). Even and odd samples belong to the two
// half-buffers.
std::vector<Vec2> sample_points(const Document& document, Vec2i pixel, const Dimension& x, const Dimension& y,
                                uint32_t count);

}  // namespace etendue::render
