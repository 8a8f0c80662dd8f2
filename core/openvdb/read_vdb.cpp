#include "read_vdb.h"

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>

#include <cstring>
#include <istream>
#include <streambuf>

namespace etendue::vdb {
namespace {

using openvdb::FloatGrid;

// A stream over bytes in memory.
class MemoryBuffer : public std::streambuf {
 public:
  explicit MemoryBuffer(std::span<const std::byte> bytes) {
    char* data = const_cast<char*>(reinterpret_cast<const char*>(bytes.data()));
    setg(data, data, data + bytes.size());
  }

 protected:
  pos_type seekoff(off_type offset, std::ios_base::seekdir from, std::ios_base::openmode) override {
    const char* base = from == std::ios_base::beg ? eback() : from == std::ios_base::cur ? gptr() : egptr();
    if (offset < eback() - base || offset > egptr() - base) return pos_type(off_type(-1));
    setg(eback(), const_cast<char*>(base) + offset, egptr());
    return pos_type(gptr() - eback());
  }
  pos_type seekpos(pos_type position, std::ios_base::openmode mode) override {
    return seekoff(off_type(position), std::ios_base::beg, mode);
  }
};

// The first bytes of a file: a number that identifies the format, and its version.
struct FileStart {
  uint64_t magic;
  uint32_t version;
};

// Why the start of a file is not that of a supported one; empty if it is. Readers of early versions are not robust.
std::string start_error(std::span<const std::byte> bytes) {
  constexpr uint32_t kEarliest = openvdb::OPENVDB_FILE_VERSION_SELECTIVE_COMPRESSION;
  FileStart start{};
  if (bytes.size() < 12) return "is not an OpenVDB file";
  std::memcpy(&start.magic, bytes.data(), 8);
  std::memcpy(&start.version, bytes.data() + 8, 4);
  if (start.magic != static_cast<uint64_t>(openvdb::OPENVDB_MAGIC)) return "is not an OpenVDB file";
  if (start.version < kEarliest || start.version > openvdb::OPENVDB_FILE_VERSION)
    return "has version " + std::to_string(start.version) + " of the format; convert it to version " +
           std::to_string(openvdb::OPENVDB_FILE_VERSION);
  return {};
}

openvdb::GridPtrVecPtr grids_in(std::span<const std::byte> bytes) {
  openvdb::initialize();
  MemoryBuffer buffer(bytes);
  std::istream in(&buffer);
  // OpenVDB does not test the state of the stream while it reads: a read beyond the end must throw.
  in.exceptions(std::ios_base::failbit | std::ios_base::badbit | std::ios_base::eofbit);
  return openvdb::io::Stream(in, false).getGrids();
}

FloatGrid::Ptr find_grid(const openvdb::GridPtrVec& grids, const std::string& name) {
  for (const openvdb::GridBase::Ptr& grid : grids)
    if (grid && grid->isType<FloatGrid>() && (name.empty() || grid->getName() == name))
      return openvdb::gridPtrCast<FloatGrid>(grid);
  return nullptr;
}

// Grows a box to two voxels along each axis, which interpolation needs.
openvdb::CoordBBox with_two_voxels(openvdb::CoordBBox box) {
  for (int axis = 0; axis < 3; ++axis)
    if (box.min()[axis] == box.max()[axis]) ++box.max()[axis];
  return box;
}

bool exceeds(const openvdb::CoordBBox& box, size_t most_voxels) {
  double voxels = 1;
  for (int axis = 0; axis < 3; ++axis)
    voxels *= static_cast<double>(int64_t{box.max()[axis]} - int64_t{box.min()[axis]} + 1);
  return voxels > static_cast<double>(most_voxels);
}

std::vector<float> values_in(const FloatGrid& grid, const openvdb::CoordBBox& box) {
  openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ> dense(box);
  openvdb::tools::copyToDense(grid, dense, true);
  return {dense.data(), dense.data() + box.volume()};
}

Result<GridValues> read(std::span<const std::byte> bytes, const std::string& name, size_t most_voxels) {
  const openvdb::GridPtrVecPtr grids = grids_in(bytes);
  FloatGrid::Ptr density = find_grid(*grids, "density");
  if (!density) density = find_grid(*grids, "");
  if (!density) return input_error(name + ": has no grid of floats");
  const std::string where = name + ": the grid '" + density->getName() + "'";
  if (density->getGridClass() == openvdb::GRID_LEVEL_SET)
    return input_error(where + " is a level set, not a density; convert it to a fog volume");
  openvdb::CoordBBox box = density->evalActiveVoxelBoundingBox();
  if (box.empty()) return input_error(where + " has no voxels");
  box = with_two_voxels(box);
  if (exceeds(box, most_voxels))
    return input_error(where + " has more than " + std::to_string(most_voxels >> 20) +
                       " million voxels in its bounding box; resample it");
  GridValues result;
  for (int axis = 0; axis < 3; ++axis) result.nodes[static_cast<size_t>(axis)] = box.dim()[axis];
  result.density = values_in(*density, box);
  if (const FloatGrid::Ptr temperature = find_grid(*grids, "temperature"))
    result.temperature = values_in(*temperature, box);
  return result;
}

}  // namespace

Result<GridValues> read_vdb(std::span<const std::byte> bytes, const std::string& name, size_t most_voxels) {
  constexpr const char* kDamaged = ": is not an OpenVDB file, or it is truncated or damaged";
  if (const std::string error = start_error(bytes); !error.empty()) return input_error(name + ": " + error);
  try {
    return read(bytes, name, most_voxels);
  } catch (const std::ios_base::failure&) {
    return input_error(name + kDamaged);
  } catch (const std::bad_alloc&) {
    return input_error(name + ": there is not enough memory for its grids; it is damaged, or must be resampled");
  } catch (const std::exception& e) {
    return input_error(name + kDamaged + " (" + e.what() + ")");
  } catch (...) {
    return input_error(name + kDamaged);
  }
}

}  // namespace etendue::vdb
