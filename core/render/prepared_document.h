// A document prepared for rendering: everything that an integrator needs to begin an image.
//
// A PreparedDocument holds the compiled scene, the transport model that scene and document call for, the sampler and
// the integrator with their parameters, the generator of camera rays, and the pixel filter. The renderer, the samples
// of a single pixel and the benchmarks all start from it.
#pragma once
#include <memory>

#include "integrator/integrator.h"
#include "integrator/path/path_layers.h"
#include "render/document.h"

namespace etendue::render {

// Samples per half-buffer for which a sampler computes its tables at a time.
inline constexpr uint32_t kTableSamples = 64;

// The sampler of a document, with its parameters.
std::unique_ptr<Sampler> sampler_of(const Document& document);

class PreparedDocument {
 public:
  PreparedDocument(const Document& document, std::shared_ptr<const scene::CompiledScene> scene);
  // At another resolution than the document's, for previews. `layers` receives layers of the paths (path_layers.h); it
  // must outlive the object, and its integrator must be able to record them. Null: none.
  PreparedDocument(const Document& document, std::shared_ptr<const scene::CompiledScene> scene, int width, int height,
                   integrator::PathLayerRecording* layers = nullptr);
  // Contexts point into the object, so it stays where it is.
  PreparedDocument(const PreparedDocument&) = delete;
  PreparedDocument& operator=(const PreparedDocument&) = delete;

  int width() const { return width_; }
  int height() const { return height_; }
  uint64_t seed() const { return seed_; }
  const transport::Model& model() const { return model_; }
  const integrator::Integrator& integrator() const { return *integrator_; }
  integrator::Accumulation accumulation() const { return accumulation_; }
  bool has_negative_samples() const { return has_negative_samples_; }

  // Begins a rendering in this context. If the integrator does not support the scene, the image is black.
  std::unique_ptr<integrator::RenderState> begin(const integrator::RenderContext& context,
                                                 const integrator::RenderState* previous = nullptr) const;
  // Why the integrator does not support the scene; empty if it does.
  const std::string& refusal() const { return refusal_; }

  // The context of a rendering with the document's seed, or with another one. It is valid as long as this object.
  integrator::RenderContext context() const { return context(seed_); }
  integrator::RenderContext context(uint64_t seed) const;

  // Lets the sampler compute its tables for the window of kTableSamples samples that holds this one. The sample is
  // counted within its half-buffer. Does nothing while the window stays the same.
  void prepare_sampler(uint32_t sample_of_half);

 private:
  std::shared_ptr<const scene::CompiledScene> scene_;
  transport::Model model_;
  std::string sampler_name_;
  std::vector<Setting> sampler_settings_;
  std::unique_ptr<Sampler> sampler_;
  std::unique_ptr<integrator::Integrator> integrator_;
  std::string refusal_;
  integrator::Accumulation accumulation_;
  bool has_negative_samples_;
  CameraRays camera_;
  film::Filter filter_;
  uint64_t seed_;
  int width_, height_;
  uint32_t tables_end_ = 0;  // number of the prepared window, plus one; 0 before the first
};

}  // namespace etendue::render
