// Path tracing that records parts of the radiance in separate layers besides the image, from the same paths.
//
// A layer contains the contributions of some numbers of bounces and of some path classes. The number of bounces is the
// number of scattering events between camera and light: 0 is directly visible emission, 1 direct light. Layers that
// partition the paths sum to the image, sample by sample, up to rounding.
#pragma once
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "film/half_buffers.h"
#include "integrator/integrator.h"
#include "transport/path_expression/automaton.h"

namespace etendue::integrator {

struct PathLayer {
  static constexpr int kNoLimit = std::numeric_limits<int>::max();
  std::string name;
  int first_bounce = 0, last_bounce = kNoLimit;
  std::shared_ptr<const transport::Automaton> paths = nullptr;  // null: the paths of the image
};

// The layers of one rendering and the sums of their samples.
class PathLayerRecording {
 public:
  // `image` are the paths of the image; null: all.
  explicit PathLayerRecording(std::vector<PathLayer> layers,
                              std::shared_ptr<const transport::Automaton> image = nullptr)
      : layers_(std::move(layers)), image_(std::move(image)) {}

  const std::vector<PathLayer>& layers() const { return layers_; }
  const transport::Automaton* image() const { return image_.get(); }
  // Whether there are path classes, of layers or of the image.
  bool has_classes() const;

  // Discards all samples.
  void clear(int width, int height);
  // Adds one sample of each pixel of a block. `radiance` is that of the image, `values` that of the layers, one after
  // the other, each with PixelBlock::kMostPixels elements. A sample that the film rejects counts as zero. Blocks without
  // common pixels may be added from different threads.
  void add(const PixelBlock& block, std::span<const Rgb> radiance, std::span<const Rgb> values);
  // The mean of a layer, three numbers per pixel.
  std::vector<float> mean(size_t layer) const;

 private:
  std::vector<PathLayer> layers_;
  std::shared_ptr<const transport::Automaton> image_;
  int width_ = 0, height_ = 0;
  std::vector<std::vector<double>> sums_;  // by layer, then by pixel and channel
  std::vector<uint32_t> counts_;           // by pixel
};

// Why the layers of an integrator's paths cannot be recorded; empty if they can.
std::string path_layers_incompatibility(std::string_view integrator);

// The integrator of this name that also records layers. The classes of the recording count, not those of the model.
// `recording` must outlive the integrator.
std::unique_ptr<Integrator> make_layered_integrator(std::string_view name, const std::vector<Setting>& settings,
                                                    PathLayerRecording& recording);

}  // namespace etendue::integrator
