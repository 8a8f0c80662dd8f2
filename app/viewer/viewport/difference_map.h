// The difference of two images as a false-colour image.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "image/display.h"
#include "spectrum/rgb.h"

namespace etendue::viewer {

// wipe: the images are on both sides of a divider; difference: signed difference of luminance; flip: the FLIP metric.
enum class CompareMode : uint8_t { off, wipe, difference, flip };
const char* name_of(CompareMode mode);

// What a map is computed from.
struct DifferenceInput {
  CompareMode mode = CompareMode::off;
  std::shared_ptr<const std::vector<Rgb>> left;
  std::shared_ptr<const std::vector<Rgb>> right;
  float exposure = 0;  // for FLIP, which compares displayed images
  image::ToneCurve curve = image::ToneCurve::none;

  friend bool operator==(const DifferenceInput&, const DifferenceInput&) = default;
};

struct DifferenceMap {
  DifferenceInput input;
  std::vector<float> values;  // luminance of left minus right, cd/m^2; or FLIP, 0 to 1
  std::vector<Rgb> pixels;    // the values in false colours, linear
  float scale = 1;            // the value at the end of the colour scale; 0 if the images are equal
  double mean = 0;            // of the values
  double rms = 0;             // root mean square of the values
  double seconds = 0;         // that the computation took
};

// Computes the map of two images of the same size. A difference takes milliseconds per megapixel, FLIP about a second.
// "equal", or the mean with its sign and four digits, and the root mean square difference. A mean that rounds to zero
// keeps its sign.
std::string difference_text(const DifferenceMap& map);

std::shared_ptr<const DifferenceMap> make_difference_map(const DifferenceInput& input, int width, int height);

}  // namespace etendue::viewer
