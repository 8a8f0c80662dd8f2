// Distributions of the pixel values of an image: histograms, waveform and clipped shares.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "image/display.h"
#include "spectrum/rgb.h"

namespace etendue::viewer {

inline constexpr int kDisplayLevels = 256;    // of a displayed 8-bit value
inline constexpr int kWaveformColumns = 128;  // at most; each covers an equal share of the image's width
inline constexpr int kWaveformLevels = 64;
inline constexpr int kBinsPerStop = 4;  // of the luminance histogram
inline constexpr int kMaxStops = 32;    // below the brightest pixel

struct ImageStatistics {
  uint64_t pixels = 0;

  // Numbers of pixels by log2 of the linear luminance. Bin i covers [low + i, low + i + 1) / kBinsPerStop stops relative
  // to 1 cd/m^2. Darker pixels than kMaxStops below the brightest are in the first bin.
  int low = 0;
  std::vector<uint64_t> luminance_counts;
  uint64_t black = 0;    // pixels of luminance 0
  uint64_t invalid = 0;  // pixels that are not finite, which are counted nowhere else

  // Numbers of pixels by displayed value (display.h), for red, green and blue.
  std::array<std::array<uint64_t, kDisplayLevels>, 3> displayed_counts{};
  std::array<double, 3> clipped_high{};  // share of the pixels whose displayed value is 255
  std::array<double, 3> clipped_low{};   // share of the pixels whose displayed value is 0
  double above_white = 0;                // share of the pixels with a channel above 1 after exposure

  // Numbers of pixels by column of the image and displayed value: [channel][column * kWaveformLevels + level].
  int columns = 0;
  std::array<std::vector<uint32_t>, 3> waveform;

  // In stops relative to 1 cd/m^2.
  double low_stops() const { return static_cast<double>(low) / kBinsPerStop; }
};

// `pixels` are linear radiance, row by row; `exposure` is in stops.
ImageStatistics image_statistics(std::span<const Rgb> pixels, int width, float exposure, image::ToneCurve curve);

}  // namespace etendue::viewer
