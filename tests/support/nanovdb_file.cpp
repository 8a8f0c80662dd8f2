#include "support/nanovdb_file.h"

#ifdef ETENDUE_NANOVDB
#define NANOVDB_USE_ZIP
#ifdef ETENDUE_OPENVDB
#define NANOVDB_USE_BLOSC
#endif
#include <nanovdb/util/GridBuilder.h>
#include <nanovdb/util/IO.h>

#include <sstream>
#endif

namespace etendue::test {

#ifdef ETENDUE_NANOVDB

const bool kHasNanovdb = true;

namespace {

template <class Stored>
nanovdb::GridHandle<> handle_of(const NanovdbGrid& grid) {
  nanovdb::GridBuilder<float, Stored> builder(0);
  auto accessor = builder.getAccessor();
  for (int z = 1; z <= grid.size[2]; ++z)
    for (int y = 1; y <= grid.size[1]; ++y)
      for (int x = 1; x <= grid.size[0]; ++x) accessor.setValue({x, y, z}, grid.value(x, y, z));
  return builder.template getHandle<>(1.0, nanovdb::Vec3d(0), grid.name);
}

nanovdb::GridHandle<> handle_of(const NanovdbGrid& grid, NanovdbValues values) {
  switch (values) {
    case NanovdbValues::fp4:
      return handle_of<nanovdb::Fp4>(grid);
    case NanovdbValues::fp8:
      return handle_of<nanovdb::Fp8>(grid);
    case NanovdbValues::fp16:
      return handle_of<nanovdb::Fp16>(grid);
    case NanovdbValues::fpn:
      return handle_of<nanovdb::FpN>(grid);
    case NanovdbValues::floats:
      break;
  }
  return handle_of<float>(grid);
}

}  // namespace

std::vector<std::byte> nanovdb_bytes(const std::vector<NanovdbGrid>& grids, NanovdbValues values,
                                     NanovdbCompression compression) {
#ifndef ETENDUE_OPENVDB
  if (compression == NanovdbCompression::blosc) return {};
#endif
  std::string bytes;
  for (const NanovdbGrid& grid : grids) {
    const auto handle = handle_of(grid, values);
    // The writer seeks beyond the end, which a stream into memory allows only if the memory exists.
    std::ostringstream out(std::string(handle.size() + 4096, '\0'), std::ios::binary);
    nanovdb::io::writeGrid(out, handle, static_cast<nanovdb::io::Codec>(compression));
    bytes += out.str().substr(0, static_cast<size_t>(out.tellp()));
  }
  const auto* data = reinterpret_cast<const std::byte*>(bytes.data());
  return {data, data + bytes.size()};
}

#else

const bool kHasNanovdb = false;

std::vector<std::byte> nanovdb_bytes(const std::vector<NanovdbGrid>&, NanovdbValues, NanovdbCompression) { return {}; }

#endif

}  // namespace etendue::test
