#include "bsdf/measured/tensor_file.h"

#include <cmath>
#include <cstring>

#include "base/file.h"

namespace etendue {
namespace {

constexpr char kMagic[12] = "tensor_file";
constexpr uint8_t kFloat32 = 10;
constexpr uint16_t kMaxDimensions = 16;

// Reads consecutive values. `ok` becomes false when the bytes run out; values are then 0.
struct Reader {
  const std::vector<std::byte>& bytes;
  size_t at = 0;
  bool ok = true;

  template <class T>
  T next() {
    T value{};
    take(&value, sizeof value);
    return value;
  }
  void take(void* to, size_t size) {
    ok = ok && size <= bytes.size() - at;
    if (!ok) return;
    std::memcpy(to, bytes.data() + at, size);
    at += size;
  }
};

}  // namespace

Result<TensorFile> TensorFile::read(const std::filesystem::path& path) {
  TensorFile file;
  file.path_ = path.string();
  auto bytes = read_file(path);
  if (!bytes) return bytes.error();
  file.bytes_ = std::move(*bytes);

  Reader reader{file.bytes_};
  char magic[sizeof kMagic] = {};
  reader.take(magic, sizeof magic);
  const auto major = reader.next<uint8_t>();
  reader.next<uint8_t>();
  if (!reader.ok || std::memcmp(magic, kMagic, sizeof magic) != 0 || major != 1)
    return file.wrong("not a tensor file of version 1 as in the RGL database (.bsdf)");
  const auto count = reader.next<uint32_t>();
  for (uint32_t k = 0; k < count && reader.ok; ++k) {
    Field field;
    field.name.resize(reader.next<uint16_t>());
    reader.take(field.name.data(), field.name.size());
    const auto dimensions = reader.next<uint16_t>();
    field.type = reader.next<uint8_t>();
    field.offset = reader.next<uint64_t>();
    if (!reader.ok || dimensions > kMaxDimensions) return file.wrong("the directory of fields is damaged");
    // A field cannot have more elements than the file has bytes.
    field.count = 1;
    for (uint16_t d = 0; d < dimensions; ++d) {
      const auto size = reader.next<uint64_t>();
      if (size > file.bytes_.size() || field.count * size > file.bytes_.size())
        return file.wrong("field " + field.name + " is larger than the file");
      field.count *= size;
      field.shape.push_back(size);
    }
    file.fields_.push_back(std::move(field));
  }
  if (!reader.ok) return file.wrong("the file ends within the directory of fields");
  return file;
}

const TensorFile::Field* TensorFile::find(std::string_view name) const {
  for (const Field& field : fields_)
    if (field.name == name) return &field;
  return nullptr;
}

Result<Tensor> TensorFile::floats(std::string_view name, size_t dimensions) const {
  const std::string named = "field " + std::string(name);
  const Field* field = find(name);
  if (!field) return wrong(named + " is missing");
  if (field->type != kFloat32) return wrong(named + " does not contain 32 bit floats");
  if (field->shape.size() != dimensions)
    return wrong(named + " has " + std::to_string(field->shape.size()) + " dimensions, not " +
                 std::to_string(dimensions));
  const uint64_t size = field->count * sizeof(float);
  if (field->offset > bytes_.size() || size > bytes_.size() - field->offset)
    return wrong(named + " extends beyond the end of the file");
  Tensor tensor{field->shape, std::vector<float>(field->count)};
  if (size > 0) std::memcpy(tensor.values.data(), bytes_.data() + field->offset, size);
  for (const float x : tensor.values)
    if (!std::isfinite(x)) return wrong(named + " contains a value that is not finite");
  return tensor;
}

}  // namespace etendue
