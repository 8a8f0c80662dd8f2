// Samples sorted by brightness, for showing a picture without its fireflies.
//        Zirr, Hanika & Dachsbacher, "Re-weighting Firefly Samples for Improved Finite-Sample Monte Carlo Estimates",
//        Computer Graphics Forum 37(6), 2018
//
// A sample of luminance between b^i and b^(i+1) is split between the layers i and i + 1, so that it counts as one
// sample over both: w / L falls linearly in 1 / L. A layer is believed as far as samples of its brightness, and of
// those next to it, were seen in the pixel; where 3 x 3 pixels have fewer than one each, as far as they were seen
// there; and as far as one sample of its brightness would not stand out from what the darker layers show. What is shown
// tends to the mean: any brightness is seen more and more often, and stands out less and less.
//
// With one sample of its brightness a layer weighs nothing, with three everything (kappa = 1 in the paper).
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "base/parameter.h"
#include "spectrum/rgb.h"

namespace etendue::film {

// What is shown of samples that stand out: all of them, or as much as can be believed.
enum class Fireflies { keep, reweight };

class FireflyReweighting {
 public:
  // Scales from 8^-3 to 8^5: what is darker or brighter than all of them belongs to the first or the last.
  static constexpr int kLayers = 9;
  static constexpr size_t kBytesPerPixel = kLayers * sizeof(Rgb);

  FireflyReweighting(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }

  // Adds samples of one radiance, finite and not negative. Different pixels may be added to from different threads.
  void add(int x, int y, const Rgb& radiance, uint32_t samples = 1);
  // The pixel as it is shown, if it has so many samples. Below three nothing can be told apart, and it is the mean.
  Rgb shown(int x, int y, uint32_t samples) const;

  void clear_rows(int first, int end);

 private:
  static constexpr int kFirst = -3;
  using Pixel = std::array<Rgb, kLayers>;

  static float scale(int layer);
  const Pixel& at(int x, int y) const {
    return pixels_[static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x)];
  }
  // Samples of the brightness of a layer and of those next to it.
  static float seen(const Pixel& pixel, int layer);
  float seen_around(int x, int y, int layer) const;
  // How much of a layer to show over `shown`, the luminance of what the darker ones show; both are sums of samples.
  float belief(int x, int y, int layer, float shown) const;

  int width_, height_;
  std::vector<Pixel> pixels_;
};

}  // namespace etendue::film

template <>
struct etendue::Options<etendue::film::Fireflies> {
  static constexpr std::array<etendue::Option, 2> kOptions{{{"keep", "Keep"}, {"reweight", "Re-weight"}}};
};
