// The samples of one pixel, one by one, and the random numbers that they are made of.
//
// Order and numbers are those of a rendering: sample n goes into half n % 2 of the film, with that half's own numbers.
// The mean of the first n samples is the film's pixel after n up to rounding: the pixel's paths travel alone here, and
// in packets with their neighbours there.
#pragma once
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "integrator/integrator.h"
#include "render/document.h"

namespace etendue::render {

class PixelSamples {
 public:
  // Whether the method's samples are made pixel by pixel. Where paths end on pixels that they did not choose, or wait
  // for what all pixels share, no sample is one pixel's own.
  static bool supports(const Document& document);

  // The pixel lies in the document's picture, and samples of one are possible.
  PixelSamples(const Document& document, std::shared_ptr<const scene::CompiledScene> scene, Vec2i pixel);

  // Samples first, first + 1, ... as radiance in W/(m^2 sr); what a film would reject is zero, as it is there.
  // Replicate 0 is the rendering, the others are as good and independent of it. False if it was given up, because
  // `wanted` said that nobody will look at it.
  bool draw(
      uint32_t first, uint32_t half_buffer, std::span<Rgb> samples,
      const std::function<bool()>& keep_going = [] { return true; });

 private:
  void prepare(uint32_t sample);

  std::shared_ptr<const scene::CompiledScene> scene_;
  transport::Model model_;
  std::unique_ptr<Sampler> sampler_;
  std::unique_ptr<integrator::Integrator> integrator_;
  CameraRays camera_;
  film::Filter filter_;
  uint64_t seed_;
  int width_, height_;
  Vec2i pixel_;
  uint32_t prepared_ = 0;  // one more than the window of samples that the sampler has tables for
};

// One of the random numbers of a path: what it decides, and where a sampler has it.
struct Dimension {
  std::string name, label;  // "vertex-1.light-choice", "Vertex 1: light choice"; vertex 1 is the first hit
  uint32_t block = 0;
  int index = 0;  // in the block
};

// Those of the camera and of the first `vertices` vertices.
std::vector<Dimension> path_dimensions(uint32_t vertices);

// Two numbers of each of the first `count` samples of a pixel, in [0, 1); those with an even index belong to one half
// of the film, the others to the other.
std::vector<Vec2> sample_points(const Document& document, Vec2i pixel, const Dimension& x, const Dimension& y,
                                uint32_t count);

}  // namespace etendue::render
