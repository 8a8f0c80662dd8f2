// Reads densities from files: NanoVDB (.nvdb) and OpenVDB (.vdb).
#pragma once
#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "base/result.h"
#include "medium/density_grid.h"

namespace etendue {

inline constexpr size_t kMostGridVoxels = size_t{1} << 28;

// The grids `density` (or the first one) and `temperature`, in the bounding box of the density, from the bytes of a
// file; `name` stands for it in messages and selects the format by its extension. Values that are negative or not
// finite become 0, and temperatures are relative to the highest one.
Result<GridValues> parse_grid_file(std::span<const std::byte> bytes, const std::string& name);

// The voxels of a file. A file that was loaded before and has not changed since is not read again while its values are
// in use.
Result<std::shared_ptr<const GridValues>> load_grid_file(const std::string& path);

}  // namespace etendue
