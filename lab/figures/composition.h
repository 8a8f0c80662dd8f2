// Figures as files: the parts of a figure side by side, and contact sheets of several figures.
#pragma once
#include <filesystem>

#include "figures/figure.h"

namespace etendue::figures {

// A drawing and the pictures that lie on it.
struct Composition {
  struct PlacedPicture {
    int x, y;  // upper left corner, pixels
    Picture picture;
  };
  metrics::Drawing drawing;
  std::vector<PlacedPicture> pictures;
};

// The parts with their captions in `columns` columns (0: all in one row), under a heading unless it is empty.
Composition composed(const Parts& parts, int columns, const std::string& heading = {});

Picture rasterized(const Composition& composition);
// An <svg> element without an XML declaration; pictures are embedded as PNG.
std::string to_svg(const Composition& composition);

// By the extension, .png or .svg.
Result<void> write_figure(const std::filesystem::path& file, const Composition& composition);

// A picture of this width with the picture in its middle, reduced by averaging if it is wider or higher than `size`.
Picture thumbnail(const Picture& picture, int size);

}  // namespace etendue::figures
