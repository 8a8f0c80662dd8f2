// NanoVDB files in memory, for tests.
#pragma once
#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace etendue::test {

// False if the tests were built without NanoVDB; there are no bytes then.
extern const bool kHasNanovdb;

// A grid of floats. Voxels are numbered from 1 along each axis and must not all be 0.
struct NanovdbGrid {
  std::string name;
  std::array<int, 3> size;
  std::function<float(int, int, int)> value;
};

// How values are stored: 32-bit floats, or quantised.
enum class NanovdbValues { floats, fp4, fp8, fp16, fpn };
enum class NanovdbCompression { none, zip, blosc };

// The bytes of a file with these grids. Empty if the tests were built without Blosc, which it would need.
std::vector<std::byte> nanovdb_bytes(const std::vector<NanovdbGrid>& grids,
                                     NanovdbValues values = NanovdbValues::floats,
                                     NanovdbCompression compression = NanovdbCompression::none);

}  // namespace etendue::test
