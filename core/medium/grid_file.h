// Reads densities from NanoVDB files.
#pragma once
#include <memory>
#include <string>

#include "base/result.h"
#include "medium/density_grid.h"

namespace etendue {

// The voxels of a file. A file that was loaded before and has not changed since is not read again while its values are
// in use.
Result<std::shared_ptr<const GridValues>> load_grid_file(const std::string& path);

}  // namespace etendue
