#include "size.h"

#include <cstdio>

namespace etendue::cli {

Result<Vec2i> parse_size(const std::string& text) {
  int width = 0, height = 0;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &rest) != 2)
    return usage_error("--size: '" + text + "' is no size; give WIDTHxHEIGHT, as 1280x720");
  if (width < 1 || height < 1 || width > 16384 || height > 16384)
    return usage_error("--size: '" + text + "' is out of range; give 1x1 to 16384x16384");
  return Vec2i(width, height);
}

}  // namespace etendue::cli
