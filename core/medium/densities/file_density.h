// A density from a file with a sparse grid of voxels: NanoVDB (.nvdb) or OpenVDB (.vdb).
//                                                                                      [Museth 2013; Museth 2021]
//
// The bounding box of the voxels is mapped to the bounding box of the medium. The grid `density` gives the density, or
// the first grid if none has this name; the grid `temperature`, if there is one, the temperature for emission.
#pragma once
#include "base/result.h"
#include "medium/density_grid.h"
#include "medium/density_info.h"
#include "medium/grid_file.h"

namespace etendue {

struct FileDensity {
  static constexpr DensityDescription kDescription{
      .name = "file",
      .label = "Grid file",
      .summary = "The density, and optionally the temperature, from a NanoVDB or OpenVDB file.",
      .formula = "density = scale times the values of the grid, trilinear between voxels",
      .limitations =
          "Grids of floats, in NanoVDB files also quantised, up to 256 million voxels in their bounding box. OpenVDB "
          "files and Blosc compression need the packages libopenvdb-dev and libboost-dev. Voxels that are negative or "
          "not finite count as 0.",
      .source = "[Museth 2013; Museth 2021]",
  };

  Text file{"file",
            "File",
            "",
            "Path of a .nvdb or .vdb file",
            [](std::string_view path) -> Result<void> {
              if (path.empty()) return {};
              const auto values = load_grid_file(std::string(path));
              return values ? Result<void>() : Result<void>(values.error());
            },
            {{"", "None"}}};
  Number<float> scale{"scale", "Scale", 1, {0, 1e6f}, "Factor on the values of the file", "", Scale::logarithmic};

  auto parameters() { return std::tie(file, scale); }

  Result<GridValues> values() const {
    if (file.value.empty()) return usage_error("the density 'file' has no file: set its parameter 'file'");
    auto loaded = load_grid_file(file.value);
    if (!loaded) return loaded.error();
    GridValues values = **loaded;
    for (float& v : values.density) v *= scale;
    return values;
  }
};

}  // namespace etendue
