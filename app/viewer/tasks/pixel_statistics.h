// Statistics of the samples of one pixel. All luminances are in cd/m^2.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "base/vec.h"
#include "film/tail.h"
#include "sampling/counting_sampler.h"
#include "spectrum/rgb.h"

namespace etendue::viewer {

// A histogram of luminances. Values of exactly zero are counted separately, also because a logarithmic axis has no
// place for them.
struct Histogram {
  bool logarithmic = false;  // the bins are evenly spaced in the logarithm of the luminance
  double low = 0;            // of the first bin
  double high = 1;           // of the last bin
  std::vector<uint32_t> counts;
  uint32_t zeros = 0;
};
Histogram histogram_of(const std::vector<float>& values);

struct PixelStatistics {
  // The estimate after some number of samples.
  struct Estimate {
    uint32_t samples = 0;
    double mean = 0;
    double confidence = 0;               // half of the width of the 95 % confidence interval
    std::array<double, 2> half_means{};  // of the two half-buffers
  };

  Vec2i pixel{0};
  uint32_t target_samples = 0;
  Rgb mean;
  double standard_deviation = 0;  // of one sample
  double maximum = 0;             // of the samples
  film::Tail tail;
  std::vector<Estimate> running_mean;  // in order of the number of samples
  Histogram histogram;
  // Of the first counted_samples samples.
  DimensionCounts drawn_dimensions;
  uint32_t counted_samples = 0;

  uint32_t samples() const { return running_mean.empty() ? 0 : running_mean.back().samples; }
};

}  // namespace etendue::viewer
