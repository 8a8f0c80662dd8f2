// Reads grids of floats from NanoVDB files.                                                            [Museth 2021]
//
// Grids may consist of 32-bit floats or of 4-, 8-, 16-bit or variable-rate quantised floats, and be compressed by zlib
// or Blosc. All offsets in the file are checked before they are followed, so that damaged files give an error. Values
// are those of the file.
#pragma once
#include <cstddef>
#include <span>
#include <string>

#include "base/result.h"
#include "medium/density_grid.h"

namespace etendue {

// The grids `density` (or the first one) and `temperature`, in the bounding box of the density, from the bytes of a
// file; `name` stands for it in messages. Grids with more voxels than `most_voxels` are refused.
Result<GridValues> parse_nanovdb(std::span<const std::byte> bytes, const std::string& name, size_t most_voxels);

}  // namespace etendue
