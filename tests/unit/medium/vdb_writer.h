// OpenVDB files in memory, for tests.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "support/nanovdb_file.h"

namespace etendue::test {

enum class VdbCompression { none, zip, blosc };

// The bytes of a file with these grids. `half`: stored as 16-bit floats. `level_set`: declared as level sets.
std::vector<std::byte> vdb_bytes(const std::vector<NanovdbGrid>& grids,
                                 VdbCompression compression = VdbCompression::none, bool half = false,
                                 bool level_set = false);

// A file with one grid of which two voxels are active, at the ends of the range of coordinates.
std::vector<std::byte> huge_vdb_bytes();

}  // namespace etendue::test
