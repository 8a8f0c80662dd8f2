#include "support/nanovdb_file.h"

#ifdef ETENDUE_NANOVDB
#include <nanovdb/util/GridBuilder.h>
#include <nanovdb/util/IO.h>

#include <sstream>
#endif

namespace etendue::test {

#ifdef ETENDUE_NANOVDB

const bool kHasNanovdb = true;

std::vector<std::byte> nanovdb_bytes(const std::vector<NanovdbGrid>& grids) {
  std::string bytes;
  for (const NanovdbGrid& grid : grids) {
    nanovdb::GridBuilder<float> builder(0);
    auto accessor = builder.getAccessor();
    for (int z = 1; z <= grid.size[2]; ++z)
      for (int y = 1; y <= grid.size[1]; ++y)
        for (int x = 1; x <= grid.size[0]; ++x) accessor.setValue({x, y, z}, grid.value(x, y, z));
    const auto handle = builder.getHandle<>(1.0, nanovdb::Vec3d(0), grid.name, nanovdb::GridClass::FogVolume);
    // The writer seeks beyond the end, which a stream into memory allows only if the memory exists.
    std::ostringstream out(std::string(handle.size() + 1024, '\0'), std::ios::binary);
    nanovdb::io::writeGrid(out, handle, nanovdb::io::Codec::NONE);
    bytes += out.str().substr(0, static_cast<size_t>(out.tellp()));
  }
  const auto* data = reinterpret_cast<const std::byte*>(bytes.data());
  return {data, data + bytes.size()};
}

#else

const bool kHasNanovdb = false;

std::vector<std::byte> nanovdb_bytes(const std::vector<NanovdbGrid>&) { return {}; }

#endif

}  // namespace etendue::test
