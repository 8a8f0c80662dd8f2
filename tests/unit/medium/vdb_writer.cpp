#include "unit/medium/vdb_writer.h"

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>

#include <sstream>

namespace etendue::test {
namespace {

std::vector<std::byte> bytes_of(const openvdb::GridCPtrVec& grids, VdbCompression compression) {
  std::ostringstream out(std::ios::binary);
  openvdb::io::Stream stream(out);
  const auto method = compression == VdbCompression::zip     ? openvdb::io::COMPRESS_ZIP
                      : compression == VdbCompression::blosc ? openvdb::io::COMPRESS_BLOSC
                                                             : openvdb::io::COMPRESS_NONE;
  stream.setCompression(method | openvdb::io::COMPRESS_ACTIVE_MASK);
  stream.write(grids);
  const std::string text = out.str();
  const auto* data = reinterpret_cast<const std::byte*>(text.data());
  return {data, data + text.size()};
}

}  // namespace

std::vector<std::byte> vdb_bytes(const std::vector<NanovdbGrid>& grids, VdbCompression compression, bool half,
                                 bool level_set) {
  openvdb::initialize();
  openvdb::GridCPtrVec written;
  for (const NanovdbGrid& from : grids) {
    const auto grid = openvdb::FloatGrid::create(0);
    grid->setName(from.name);
    grid->setSaveFloatAsHalf(half);
    if (level_set) grid->setGridClass(openvdb::GRID_LEVEL_SET);
    auto accessor = grid->getAccessor();
    for (int z = 1; z <= from.size[2]; ++z)
      for (int y = 1; y <= from.size[1]; ++y)
        for (int x = 1; x <= from.size[0]; ++x) accessor.setValue({x, y, z}, from.value(x, y, z));
    written.push_back(grid);
  }
  return bytes_of(written, compression);
}

std::vector<std::byte> huge_vdb_bytes() {
  openvdb::initialize();
  const auto grid = openvdb::FloatGrid::create(0);
  grid->setName("density");
  grid->getAccessor().setValue(openvdb::Coord(-2000000000), 1);
  grid->getAccessor().setValue(openvdb::Coord(2000000000), 1);
  return bytes_of({grid}, VdbCompression::none);
}

}  // namespace etendue::test
