// Reads OpenVDB files.                                                                                 [Museth 2013]
#pragma once
#include <cstddef>
#include <span>
#include <string>

#include "base/result.h"
#include "medium/density_grid.h"

namespace etendue::vdb {

// See GridPlugin::read_vdb.
Result<GridValues> read_vdb(std::span<const std::byte> bytes, const std::string& name, size_t most_voxels);

}  // namespace etendue::vdb
