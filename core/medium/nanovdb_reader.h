// Reads grids of floats from NanoVDB files.                                                            [Museth 2021]
//
// All offsets in the file are checked before they are followed, so that damaged files give an error. Values that are
// negative or not finite become 0.
#pragma once
#include <cstddef>
#include <span>
#include <string>

#include "base/result.h"
#include "medium/density_grid.h"

namespace etendue {

inline constexpr size_t kMostGridVoxels = size_t{1} << 28;

// The grids `density` (or the first one) and `temperature`, in the bounding box of the density.
Result<GridValues> read_nanovdb(const std::string& path);
// The same from the bytes of a file; `name` stands for it in messages.
Result<GridValues> parse_nanovdb(std::span<const std::byte> bytes, const std::string& name);

}  // namespace etendue
