#include "medium/nanovdb_reader.h"

#ifdef ETENDUE_NANOVDB
#include <nanovdb/util/IO.h>
#include <zlib.h>

#include <cstring>

#include "medium/grid_plugin.h"
#endif

namespace etendue {

#ifdef ETENDUE_NANOVDB
namespace {

// The types of nodes do not depend on how the leaves store values.
using RootData = nanovdb::NanoRoot<float>::DataType;

// A box of voxels, upper bounds inclusive.
struct VoxelBox {
  std::array<int64_t, 3> lower{}, upper{};

  int64_t size(size_t axis) const { return upper[axis] - lower[axis] + 1; }
};

// The buffer of one grid, which nodes must lie in.
class GridBuffer {
 public:
  explicit GridBuffer(std::span<const std::byte> bytes)
      : size_(bytes.size()), storage_(bytes.size() / sizeof(Chunk) + 1) {
    std::memcpy(storage_.data(), bytes.data(), bytes.size());
  }
  const std::byte* begin() const { return reinterpret_cast<const std::byte*>(storage_.data()); }

  // The object at an offset in bytes from `base`; null if it does not lie in the buffer.
  template <class T>
  const T* find(const void* base, int64_t offset, size_t bytes = sizeof(T)) const {
    const int64_t start = static_cast<const std::byte*>(base) - begin();
    if (offset < -start || offset > static_cast<int64_t>(size_) - start) return nullptr;
    const auto at = static_cast<size_t>(start + offset);
    if (at % alignof(T) != 0 || bytes > size_ - at) return nullptr;
    return reinterpret_cast<const T*>(begin() + at);
  }

 private:
  struct alignas(NANOVDB_DATA_ALIGNMENT) Chunk {
    std::byte bytes[NANOVDB_DATA_ALIGNMENT];
  };
  size_t size_;
  std::vector<Chunk> storage_;
};

// Copies a tree into an array of voxels. Tiles and nodes outside of the box are skipped. `Stored` is float, or the type
// of quantised values of NanoVDB.
template <class Stored>
class TreeReader {
 public:
  TreeReader(const GridBuffer& buffer, const VoxelBox& box, std::vector<float>& values)
      : buffer_(buffer), box_(box), values_(values) {}

  // Returns false if the tree is damaged.
  bool read(const RootData& root) {
    values_.assign(count(), root.mBackground);
    const auto* tiles =
        buffer_.template find<RootData::Tile>(&root, sizeof(RootData), root.mTableSize * sizeof(RootData::Tile));
    if (!tiles) return false;
    for (uint32_t i = 0; i < root.mTableSize; ++i) {
      const auto origin = tiles[i].origin();
      if (tiles[i].isChild()) {
        if (!read_node<UpperNode>(&root, tiles[i].child, {origin[0], origin[1], origin[2]})) return false;
      } else {
        fill({origin[0], origin[1], origin[2]}, UpperNode::DIM, tiles[i].value);
      }
    }
    return true;
  }

 private:
  using Origin = std::array<int64_t, 3>;
  using UpperNode = nanovdb::NanoUpper<Stored>;
  using LowerNode = nanovdb::NanoLower<Stored>;
  using LeafNode = nanovdb::NanoLeaf<Stored>;

  size_t count() const {
    return static_cast<size_t>(box_.size(0)) * static_cast<size_t>(box_.size(1)) * static_cast<size_t>(box_.size(2));
  }

  bool outside(const Origin& origin, int64_t size) const {
    for (size_t axis = 0; axis < 3; ++axis)
      if (origin[axis] > box_.upper[axis] || origin[axis] + size <= box_.lower[axis]) return true;
    return false;
  }

  // `stride` is the number of voxels along a side of a child.
  template <class Node>
  bool read_node(const void* parent, int64_t offset, const Origin& origin) {
    if (outside(origin, Node::DIM)) return true;
    const auto* node = buffer_.template find<typename Node::DataType>(parent, offset);
    if (!node) return false;
    if constexpr (std::is_same_v<Node, LeafNode>) {
      // Leaves of variable rate are followed by their values.
      if (!buffer_.template find<typename Node::DataType>(parent, offset, node->memUsage())) return false;
      for (uint32_t i = 0; i < Node::SIZE; ++i) fill(child_origin<Node>(origin, i, 1), 1, node->getValue(i));
    } else {
      using Child = std::conditional_t<std::is_same_v<Node, UpperNode>, LowerNode, LeafNode>;
      for (uint32_t i = 0; i < Node::SIZE; ++i) {
        const Origin at = child_origin<Node>(origin, i, Child::DIM);
        if (!node->mChildMask.isOn(i))
          fill(at, Child::DIM, node->mTable[i].value);
        else if (!read_node<Child>(node, node->mTable[i].child, at))
          return false;
      }
    }
    return true;
  }

  // Children are numbered with z fastest.
  template <class Node>
  static Origin child_origin(const Origin& origin, uint32_t index, int64_t stride) {
    const uint32_t mask = (1U << Node::LOG2DIM) - 1;
    return {origin[0] + stride * (index >> (2 * Node::LOG2DIM)), origin[1] + stride * (index >> Node::LOG2DIM & mask),
            origin[2] + stride * (index & mask)};
  }

  void fill(const Origin& origin, int64_t size, float value) {
    if (outside(origin, size)) return;
    const auto first = [&](size_t a) { return std::max(origin[a], box_.lower[a]) - box_.lower[a]; };
    const auto last = [&](size_t a) { return std::min(origin[a] + size - 1, box_.upper[a]) - box_.lower[a]; };
    for (int64_t z = first(2); z <= last(2); ++z)
      for (int64_t y = first(1); y <= last(1); ++y) {
        const auto row = static_cast<size_t>((z * box_.size(1) + y) * box_.size(0));
        std::fill(&values_[row + static_cast<size_t>(first(0))], &values_[row + static_cast<size_t>(last(0))] + 1,
                  value);
      }
  }

  const GridBuffer& buffer_;
  const VoxelBox& box_;
  std::vector<float>& values_;
};

// A grid of a file.
struct FoundGrid {
  std::string name;
  uint64_t size;                     // bytes of its buffer
  std::span<const std::byte> bytes;  // of the file
  nanovdb::io::Codec codec;
};

// Reads consecutive objects.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : rest_(bytes) {}

  bool empty() const { return rest_.empty(); }
  template <class T>
  bool read(T& to) {
    if (rest_.size() < sizeof(T)) return false;
    std::memcpy(static_cast<void*>(&to), rest_.data(), sizeof(T));
    rest_ = rest_.subspan(sizeof(T));
    return true;
  }
  bool take(uint64_t size, std::span<const std::byte>& to) {
    if (size > rest_.size()) return false;
    to = rest_.first(static_cast<size_t>(size));
    rest_ = rest_.subspan(static_cast<size_t>(size));
    return true;
  }

 private:
  std::span<const std::byte> rest_;
};

Result<std::vector<FoundGrid>> grids_of(std::span<const std::byte> bytes, const std::string& file) {
  const auto truncated = [&] { return input_error(file + ": the file ends early; it is truncated or damaged"); };
  std::vector<FoundGrid> grids;
  ByteReader reader(bytes);
  while (!reader.empty()) {
    nanovdb::io::Header header;
    if (!reader.read(header)) return truncated();
    if (header.magic != NANOVDB_MAGIC_NUMBER) return input_error(file + ": is not a NanoVDB file");
    if (header.version.getMajor() != NANOVDB_MAJOR_VERSION_NUMBER)
      return input_error(file + ": has version " + std::to_string(header.version.getMajor()) +
                         " of NanoVDB; convert it to version " + std::to_string(NANOVDB_MAJOR_VERSION_NUMBER));
    if (header.codec > nanovdb::io::Codec::BLOSC)
      return input_error(file + ": is compressed by an unknown method; write it without compression");
    const size_t first = grids.size();
    std::vector<uint64_t> sizes;
    for (int i = 0; i < header.gridCount; ++i) {
      nanovdb::io::MetaData meta;
      std::span<const std::byte> name;
      if (!reader.read(meta) || !reader.take(meta.nameSize, name)) return truncated();
      const auto* text = reinterpret_cast<const char*>(name.data());
      grids.push_back({std::string(text, strnlen(text, name.size())), meta.gridSize, {}, header.codec});
      sizes.push_back(header.codec == nanovdb::io::Codec::NONE ? meta.gridSize : meta.fileSize);
    }
    for (size_t i = 0; i < sizes.size(); ++i)
      if (!reader.take(sizes[i], grids[first + i].bytes)) return truncated();
  }
  if (grids.empty()) return input_error(file + ": has no grids");
  return grids;
}

// Compressed data are blocks, each preceded by its number of bytes: one of zlib, or one of Blosc per gigabyte.
bool decompress(const FoundGrid& grid, const GridPlugin* blosc, std::vector<std::byte>& buffer) {
  constexpr uint64_t kBloscBlock = uint64_t{1} << 30;
  ByteReader reader(grid.bytes);
  std::span<std::byte> rest(buffer);
  while (!rest.empty()) {
    uint64_t size = 0;
    std::span<const std::byte> block;
    if (!reader.read(size) || !reader.take(size, block)) return false;
    if (!blosc) {
      uLongf length = rest.size();
      return uncompress(reinterpret_cast<Bytef*>(rest.data()), &length, reinterpret_cast<const Bytef*>(block.data()),
                        block.size()) == Z_OK &&
             length == rest.size();
    }
    const auto to = rest.first(std::min<uint64_t>(rest.size(), kBloscBlock));
    if (!blosc->decompress_blosc(block, to)) return false;
    rest = rest.subspan(to.size());
  }
  return true;
}

// The bytes of the buffer of a grid. No method of compression is better than 1 to 1100 (zlib).
Result<std::vector<std::byte>> buffer_of(const FoundGrid& grid, const std::string& where) {
  constexpr uint64_t kMostCompression = 1100;
  if (grid.codec == nanovdb::io::Codec::NONE) return std::vector<std::byte>(grid.bytes.begin(), grid.bytes.end());
  const bool is_blosc = grid.codec == nanovdb::io::Codec::BLOSC;
  if (!is_blosc && grid.size / kMostCompression > grid.bytes.size())
    return input_error(where + " is damaged: it claims more bytes than can be compressed in this file");
  const GridPlugin* blosc = nullptr;
  if (is_blosc) {
    const auto plugin = grid_plugin();
    if (!plugin) return input_error(where + " is compressed by Blosc and " + plugin.error().message);
    blosc = *plugin;
  }
  if (is_blosc && grid.size / (kMostCompression * 32) > grid.bytes.size())
    return input_error(where + " is damaged: it claims more bytes than can be compressed in this file");
  std::vector<std::byte> buffer(grid.size);
  if (!decompress(grid, blosc, buffer)) return input_error(where + " is damaged: it cannot be decompressed");
  return buffer;
}

// The root of the tree in a buffer, or an error.
Result<const RootData*> root_of(const GridBuffer& buffer, const std::string& where) {
  const auto* grid = buffer.find<nanovdb::GridData>(buffer.begin(), 0);
  if (!grid || grid->mMagic != NANOVDB_MAGIC_NUMBER) return input_error(where + " is damaged");
  const auto* tree = buffer.find<nanovdb::TreeData<3>>(grid, sizeof(nanovdb::GridData));
  const auto* root = tree && tree->mNodeOffset[3] <= uint64_t{1} << 62
                         ? buffer.find<RootData>(tree, static_cast<int64_t>(tree->mNodeOffset[3]))
                         : nullptr;
  if (!root) return input_error(where + " is damaged: its tree lies outside of the file");
  return root;
}

Result<VoxelBox> box_of(const RootData& root, const std::string& where, size_t most_voxels) {
  VoxelBox box;
  uint64_t voxels = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<size_t>(axis);
    box.lower[a] = root.mBBox.min()[axis];
    box.upper[a] = root.mBBox.max()[axis];
    if (box.size(a) <= 0) return input_error(where + " has no voxels");
    if (box.size(a) == 1) ++box.upper[a];  // interpolation needs two
    voxels = std::min<uint64_t>(voxels * static_cast<uint64_t>(box.size(a)), uint64_t{1} << 62);
    if (voxels > most_voxels)
      return input_error(where + " has more than " + std::to_string(most_voxels >> 20) +
                         " million voxels in its bounding box; resample it");
  }
  return box;
}

// Reads a tree by the type of its values; false if it is damaged, nothing if the type is not supported.
std::optional<bool> read_tree(const GridBuffer& buffer, const RootData& root, const VoxelBox& box,
                              std::vector<float>& values) {
  const auto read = [&]<class Stored>(Stored*) { return TreeReader<Stored>(buffer, box, values).read(root); };
  switch (buffer.find<nanovdb::GridData>(buffer.begin(), 0)->mGridType) {
    case nanovdb::GridType::Float:
      return read(static_cast<float*>(nullptr));
    case nanovdb::GridType::Fp4:
      return read(static_cast<nanovdb::Fp4*>(nullptr));
    case nanovdb::GridType::Fp8:
      return read(static_cast<nanovdb::Fp8*>(nullptr));
    case nanovdb::GridType::Fp16:
      return read(static_cast<nanovdb::Fp16*>(nullptr));
    case nanovdb::GridType::FpN:
      return read(static_cast<nanovdb::FpN*>(nullptr));
    default:
      return {};
  }
}

// The values of a grid in a box, or in its own bounding box if there is none yet.
Result<std::vector<float>> values_in(const FoundGrid& grid, const std::string& file, size_t most_voxels,
                                     std::optional<VoxelBox>& box) {
  const std::string where = file + ": the grid '" + grid.name + "'";
  const auto bytes = buffer_of(grid, where);
  if (!bytes) return bytes.error();
  const GridBuffer buffer(*bytes);
  const auto root = root_of(buffer, where);
  if (!root) return root.error();
  if (!box) {
    auto found = box_of(**root, where, most_voxels);
    if (!found) return found.error();
    box = *found;
  }
  std::vector<float> values;
  const auto read = read_tree(buffer, **root, *box, values);
  if (!read) return input_error(where + " does not consist of floats; convert it");
  if (!*read) return input_error(where + " is damaged: a node lies outside of the file");
  return values;
}

}  // namespace

Result<GridValues> parse_nanovdb(std::span<const std::byte> bytes, const std::string& name, size_t most_voxels) {
  const auto grids = grids_of(bytes, name);
  if (!grids) return grids.error();
  const auto named = [&](const char* wanted) {
    for (const FoundGrid& grid : *grids)
      if (grid.name == wanted) return &grid;
    return static_cast<const FoundGrid*>(nullptr);
  };
  const FoundGrid* density = named("density");
  std::optional<VoxelBox> box;
  auto values = values_in(density ? *density : grids->front(), name, most_voxels, box);
  if (!values) return values.error();
  GridValues result;
  for (size_t axis = 0; axis < 3; ++axis) result.nodes[axis] = static_cast<int>(box->size(axis));
  result.density = std::move(*values);
  if (const FoundGrid* temperature = named("temperature")) {
    auto kelvin = values_in(*temperature, name, most_voxels, box);
    if (!kelvin) return kelvin.error();
    result.temperature = std::move(*kelvin);
  }
  return result;
}

#else

Result<GridValues> parse_nanovdb(std::span<const std::byte>, const std::string& name, size_t) {
  return input_error(name + ": this build cannot read NanoVDB files; install libnanovdb-dev and build again");
}

#endif

}  // namespace etendue
