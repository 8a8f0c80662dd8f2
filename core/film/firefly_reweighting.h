// Samples sorted by brightness, for displaying an image without fireflies.                        [Zirr et al. 2018]
//
// A sample of luminance L between b^i and b^(i+1) is split between the layers i and i + 1 with weights that sum to one
// and are linear in 1 / L. A layer has full weight if enough samples of its brightness, or of that of its neighbours,
// were found in the pixel; if the 3 x 3 pixels around have less than one each, the count of these pixels is used. It
// also has full weight if one sample of its brightness would not exceed what the darker layers show. The displayed
// value converges to the mean: samples of any brightness are found more and more often and become less and less
// exceptional.
//
// A layer with one sample of its brightness has weight zero, one with three samples weight one (kappa = 1 in the paper).
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "base/parameter.h"
#include "spectrum/rgb.h"

namespace etendue::film {

// Whether exceptionally bright samples are displayed completely or with reduced weight.
enum class Fireflies { keep, reweight };

class FireflyReweighting {
 public:
  // Luminances from 8^-3 to 8^5. Darker and brighter samples belong to the first and last layer.
  static constexpr int kLayers = 9;
  static constexpr size_t kBytesPerPixel = kLayers * sizeof(Rgb);

  FireflyReweighting(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }

  // Adds samples of equal radiance, finite and not negative. Threads may add to different pixels concurrently.
  void add(int x, int y, const Rgb& radiance, uint32_t samples = 1);
  // The displayed radiance of a pixel with this number of samples; the mean if there are fewer than three.
  Rgb displayed(int x, int y, uint32_t samples) const;

  void clear_rows(int first, int end);

 private:
  static constexpr int kFirst = -3;
  using Pixel = std::array<Rgb, kLayers>;

  static float scale(int layer);
  const Pixel& at(int x, int y) const {
    return pixels_[static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x)];
  }
  // The number of samples with the brightness of a layer or of its neighbours.
  static float sample_count(const Pixel& pixel, int layer);
  float mean_count_around(int x, int y, int layer) const;
  // The weight of a layer. `displayed` is the luminance displayed by the darker layers, as a sum over samples.
  float weight(int x, int y, int layer, float displayed) const;

  int width_, height_;
  std::vector<Pixel> pixels_;
};

}  // namespace etendue::film

template <>
struct etendue::Options<etendue::film::Fireflies> {
  static constexpr std::array<etendue::Option, 2> kOptions{{{"keep", "Keep"}, {"reweight", "Re-weight"}}};
};
