// Path classes that partition an image.
#pragma once
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/integrator_scenes.h"

namespace etendue::test {

// Expects that the images of these path classes sum to the image of all paths, sample by sample up to this relative
// error, and returns them.
inline std::vector<film::Film> expect_sum_of_classes(const render::Document& d, const std::vector<std::string>& classes,
                                                     uint32_t samples, const std::string& what,
                                                     float tolerance = 1e-4f) {
  const film::Film whole = rendered(d, samples);
  std::vector<film::Film> parts;
  for (const std::string& paths : classes) parts.push_back(rendered(with(d, "film.paths", paths), samples));
  for (int y = 0; y < whole.height(); ++y)
    for (int x = 0; x < whole.width(); ++x) {
      Rgb sum(0);
      for (const film::Film& part : parts) sum += part.mean(x, y);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(sum[c], whole.mean(x, y)[c], tolerance * whole.mean(x, y)[c] + 1e-6f)
            << what << ' ' << x << ' ' << y;
    }
  return parts;
}

}  // namespace etendue::test
