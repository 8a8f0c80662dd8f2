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

// The bytes of a file with these grids.
std::vector<std::byte> nanovdb_bytes(const std::vector<NanovdbGrid>& grids);

}  // namespace etendue::test
