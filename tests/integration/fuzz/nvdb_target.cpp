// NanoVDB grids. Values that were read are finite and not negative.
#include <algorithm>
#include <cmath>

#include "integration/fuzz/target.h"
#include "medium/nanovdb_reader.h"
#include "support/nanovdb_file.h"

namespace etendue::fuzz {
namespace {

void read(Input input) {
  constexpr size_t kMostVoxels = size_t{1} << 24;
  const auto values = parse_nanovdb(input, "input.nvdb", kMostVoxels);
  if (!values) return;
  const auto valid = [](float v) { return v >= 0 && std::isfinite(v); };
  require(std::ranges::all_of(values->density, valid), "a density is negative or not finite");
  require(std::ranges::all_of(values->temperature, valid), "a temperature is negative or not finite");
}

std::vector<Bytes> grids() {
  const auto sum = [](int x, int y, int z) { return static_cast<float>(x + y + z); };
  const std::vector<test::NanovdbGrid> both{{"density", {5, 3, 9}, sum}, {"temperature", {5, 3, 9}, sum}};
  std::vector<Bytes> seeds;
  for (const auto& bytes : {test::nanovdb_bytes({both[0]}), test::nanovdb_bytes(both)})
    seeds.emplace_back(bytes.begin(), bytes.end());
  return seeds;
}

}  // namespace

const Target kTarget{.run = read, .seeds = grids};

}  // namespace etendue::fuzz
