#include "medium/nanovdb_reader.h"

#include <fstream>
#include <iterator>

#ifdef ETENDUE_NANOVDB
#include <nanovdb/util/IO.h>

#include <cstring>
#endif

namespace etendue {

Result<GridValues> read_nanovdb(const std::string& path) {
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = in ? static_cast<std::streamoff>(in.tellg()) : -1;
  if (size < 0) return input_error(path + ": cannot be opened; give the path of a .nvdb file");
  std::vector<std::byte> bytes(static_cast<size_t>(size));
  in.seekg(0);
  if (!in.read(reinterpret_cast<char*>(bytes.data()), size)) return input_error(path + ": cannot be read");
  return parse_nanovdb(bytes, path);
}

#ifdef ETENDUE_NANOVDB
namespace {

using FloatTree = nanovdb::NanoTree<float>;
using RootNode = nanovdb::NanoRoot<float>;
using UpperNode = nanovdb::NanoUpper<float>;
using LowerNode = nanovdb::NanoLower<float>;
using LeafNode = nanovdb::NanoLeaf<float>;
using RootData = RootNode::DataType;

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

// Copies a tree into an array of voxels. Tiles and nodes outside of the box are skipped.
class TreeReader {
 public:
  TreeReader(const GridBuffer& buffer, const VoxelBox& box, std::vector<float>& values)
      : buffer_(buffer), box_(box), values_(values) {}

  // Returns false if the tree is damaged.
  bool read(const RootData& root) {
    values_.assign(count(), valid(root.mBackground));
    const auto* tiles = buffer_.find<RootData::Tile>(&root, sizeof(RootData), root.mTableSize * sizeof(RootData::Tile));
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

  size_t count() const {
    return static_cast<size_t>(box_.size(0)) * static_cast<size_t>(box_.size(1)) * static_cast<size_t>(box_.size(2));
  }
  static float valid(float value) { return value > 0 && std::isfinite(value) ? value : 0; }

  bool outside(const Origin& origin, int64_t size) const {
    for (size_t axis = 0; axis < 3; ++axis)
      if (origin[axis] > box_.upper[axis] || origin[axis] + size <= box_.lower[axis]) return true;
    return false;
  }

  // `stride` is the number of voxels along a side of a child.
  template <class Node>
  bool read_node(const void* parent, int64_t offset, const Origin& origin) {
    if (outside(origin, Node::DIM)) return true;
    const auto* node = buffer_.find<typename Node::DataType>(parent, offset);
    if (!node) return false;
    if constexpr (std::is_same_v<Node, LeafNode>) {
      for (uint32_t i = 0; i < Node::SIZE; ++i) fill(child_origin<Node>(origin, i, 1), 1, node->mValues[i]);
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
    const float v = valid(value);
    for (int64_t z = first(2); z <= last(2); ++z)
      for (int64_t y = first(1); y <= last(1); ++y) {
        const auto row = static_cast<size_t>((z * box_.size(1) + y) * box_.size(0));
        std::fill(&values_[row + static_cast<size_t>(first(0))], &values_[row + static_cast<size_t>(last(0))] + 1, v);
      }
  }

  const GridBuffer& buffer_;
  const VoxelBox& box_;
  std::vector<float>& values_;
};

// A grid of a file.
struct FoundGrid {
  std::string name;
  std::span<const std::byte> bytes;
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
    if (header.codec != nanovdb::io::Codec::NONE)
      return input_error(file + ": is compressed; write it without compression");
    const size_t first = grids.size();
    std::vector<uint64_t> sizes;
    for (int i = 0; i < header.gridCount; ++i) {
      nanovdb::io::MetaData meta;
      std::span<const std::byte> name;
      if (!reader.read(meta) || !reader.take(meta.nameSize, name)) return truncated();
      const auto* text = reinterpret_cast<const char*>(name.data());
      grids.push_back({std::string(text, strnlen(text, name.size())), {}});
      sizes.push_back(meta.gridSize);
    }
    for (size_t i = 0; i < sizes.size(); ++i)
      if (!reader.take(sizes[i], grids[first + i].bytes)) return truncated();
  }
  if (grids.empty()) return input_error(file + ": has no grids");
  return grids;
}

// The root of the tree of floats in a buffer, or an error.
Result<const RootData*> root_of(const GridBuffer& buffer, const std::string& where) {
  const auto* grid = buffer.find<nanovdb::GridData>(buffer.begin(), 0);
  if (!grid || grid->mMagic != NANOVDB_MAGIC_NUMBER) return input_error(where + " is damaged");
  if (grid->mGridType != nanovdb::GridType::Float)
    return input_error(where + " does not consist of 32-bit floats; convert it");
  const auto* tree = buffer.find<nanovdb::TreeData<3>>(grid, sizeof(nanovdb::GridData));
  const auto* root = tree && tree->mNodeOffset[3] <= uint64_t{1} << 62
                         ? buffer.find<RootData>(tree, static_cast<int64_t>(tree->mNodeOffset[3]))
                         : nullptr;
  if (!root) return input_error(where + " is damaged: its tree lies outside of the file");
  return root;
}

Result<VoxelBox> box_of(const RootData& root, const std::string& where) {
  VoxelBox box;
  uint64_t voxels = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<size_t>(axis);
    box.lower[a] = root.mBBox.min()[axis];
    box.upper[a] = root.mBBox.max()[axis];
    if (box.size(a) <= 0) return input_error(where + " has no voxels");
    if (box.size(a) == 1) ++box.upper[a];  // interpolation needs two
    voxels = std::min<uint64_t>(voxels * static_cast<uint64_t>(box.size(a)), uint64_t{1} << 62);
    if (voxels > kMostGridVoxels)
      return input_error(where + " has more than 256 million voxels in its bounding box; resample it");
  }
  return box;
}

Result<std::vector<float>> values_in(const FoundGrid& grid, const std::string& file, std::optional<VoxelBox>& box) {
  const std::string where = file + ": the grid '" + grid.name + "'";
  const GridBuffer buffer(grid.bytes);
  const auto root = root_of(buffer, where);
  if (!root) return root.error();
  if (!box) {
    auto found = box_of(**root, where);
    if (!found) return found.error();
    box = *found;
  }
  std::vector<float> values;
  if (!TreeReader(buffer, *box, values).read(**root))
    return input_error(where + " is damaged: a node lies outside of the file");
  return values;
}

}  // namespace

Result<GridValues> parse_nanovdb(std::span<const std::byte> bytes, const std::string& name) {
  const auto grids = grids_of(bytes, name);
  if (!grids) return grids.error();
  const auto named = [&](const char* wanted) {
    for (const FoundGrid& grid : *grids)
      if (grid.name == wanted) return &grid;
    return static_cast<const FoundGrid*>(nullptr);
  };
  const FoundGrid* density = named("density");
  std::optional<VoxelBox> box;
  auto values = values_in(density ? *density : grids->front(), name, box);
  if (!values) return values.error();
  GridValues result;
  for (size_t axis = 0; axis < 3; ++axis) result.nodes[axis] = static_cast<int>(box->size(axis));
  result.density = std::move(*values);
  if (const FoundGrid* temperature = named("temperature")) {
    auto kelvin = values_in(*temperature, name, box);
    if (!kelvin) return kelvin.error();
    float highest = 0;
    for (const float t : *kelvin) highest = std::max(highest, t);
    for (float& t : *kelvin) t = highest > 0 ? t / highest : 0;
    result.temperature = std::move(*kelvin);
  }
  return result;
}

#else

Result<GridValues> parse_nanovdb(std::span<const std::byte>, const std::string& name) {
  return input_error(name + ": this build cannot read NanoVDB files; install libnanovdb-dev and build again");
}

#endif

}  // namespace etendue
