// Files with the images of all techniques.
#pragma once
#include <string>

#include "base/result.h"
#include "image/display.h"

namespace etendue::viewer {

struct TechniqueImages;

// Writes an .exr with one layer per technique, or a .png with a grid of the images as displayed. Returns the file name.
Result<std::string> write_techniques(const std::string& file, const TechniqueImages& techniques, float exposure,
                                     image::ToneCurve curve);

}  // namespace etendue::viewer
