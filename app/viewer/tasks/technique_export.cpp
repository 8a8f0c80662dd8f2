#include "viewer/tasks/technique_export.h"

#include <algorithm>

#include "image/image.h"
#include "viewer/files/file_names.h"
#include "viewer/tasks/technique_task.h"

namespace etendue::viewer {
namespace {

constexpr size_t kGap = 4;  // pixels between images

// Row k - 1 of the grid has the techniques for paths of k edges, in order of s. Unavailable techniques are black.
Result<void> write_grid(const std::string& file, const TechniqueImages& techniques, float exposure,
                        image::ToneCurve curve) {
  const auto image_width = static_cast<size_t>(techniques.width);
  const auto image_height = static_cast<size_t>(techniques.height);
  const auto rows = static_cast<size_t>(techniques.images.back().edges());
  const size_t columns = rows + 2;
  const size_t width = columns * (image_width + kGap) - kGap;
  const size_t height = rows * (image_height + kGap) - kGap;
  std::vector<uint8_t> grid(3 * width * height, 255);
  for (const TechniqueImage& image : techniques.images) {
    const auto shown = image.pixels ? image::display_pixels(*image.pixels, exposure, curve)
                                    : std::vector<uint8_t>(3 * image_width * image_height, 0);
    const size_t left = static_cast<size_t>(image.s) * (image_width + kGap);
    const size_t top = static_cast<size_t>(image.edges() - 1) * (image_height + kGap);
    for (size_t row = 0; row < image_height; ++row)
      std::copy_n(shown.begin() + static_cast<std::ptrdiff_t>(3 * image_width * row), 3 * image_width,
                  grid.begin() + static_cast<std::ptrdiff_t>(3 * ((top + row) * width + left)));
  }
  return image::write_png(file, static_cast<int>(width), static_cast<int>(height), grid);
}

Result<void> write_layers(const std::string& file, const TechniqueImages& techniques) {
  image::LayeredImage layered{techniques.width, techniques.height, {}, {}};
  const auto add_layer = [&](const std::string& name, const TechniqueImage& image) {
    if (image.pixels) layered.layers.push_back({name, {"R", "G", "B"}, *image.pixels});
  };
  add_layer("", techniques.combined);
  for (const auto& image : techniques.images)
    add_layer("technique." + std::to_string(image.s) + "." + std::to_string(image.t), image);
  return image::write_exr(file, layered);
}

}  // namespace

Result<std::string> write_techniques(const std::string& file, const TechniqueImages& techniques, float exposure,
                                     image::ToneCurve curve) {
  const std::string extension = lower_extension(file);
  if (extension != ".exr" && extension != ".png")
    return usage_error(file + ": '" + extension + "' is not a format for techniques; use .exr or .png");
  const auto written =
      extension == ".exr" ? write_layers(file, techniques) : write_grid(file, techniques, exposure, curve);
  return written ? Result<std::string>(file) : written.error();
}

}  // namespace etendue::viewer
