#include "scene/gltf/import/draco_decoder.h"

#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>

namespace etendue::scene::gltf {
namespace {

// Memory limit of the decoder. The library allocates what a header declares before it reads the data. It needs about
// 200 bytes per triangle, and a compressed triangle with its vertices takes at least one byte.
constexpr uint64_t kFree = uint64_t{256} << 20, kPerByte = 2048;

// A decoder of the library that stops where a header declares more than the limit. The header layout is that of Draco
// bitstream specification 2.2, the only version that glTF allows.
template <class Base>
class MemoryLimited : public Base {
 public:
  // `size`: compressed bytes.
  MemoryLimited(uint64_t size, bool edgebreaker) : budget_(kFree + kPerByte * size), edgebreaker_(edgebreaker) {}

  bool too_large() const { return too_large_; }

 protected:
  bool DecodeConnectivity() override {
    draco::DecoderBuffer ahead = *this->buffer();
    uint32_t first = 0, second = 0;
    uint8_t attributes = 0;
    if (!draco::DecodeVarint(&first, &ahead) || !draco::DecodeVarint(&second, &ahead)) return false;
    // Edgebreaker headers hold vertices, faces and attribute tables; sequential ones faces and points.
    if (edgebreaker_ && !ahead.Decode(&attributes)) return false;
    constexpr uint64_t kBytesEach = 160, kBytesPerTable = 48;
    return fits((uint64_t{first} + second) * (kBytesEach + attributes * kBytesPerTable)) && Base::DecodeConnectivity();
  }

  bool DecodeAllAttributes() override {
    constexpr uint64_t kBytesEach = 16, kBytesPerComponent = 16;
    uint64_t bytes = 0;
    const draco::PointCloud& mesh = *this->point_cloud();
    for (int a = 0; a < mesh.num_attributes(); ++a)
      bytes += kBytesEach + kBytesPerComponent * mesh.attribute(a)->num_components();
    return fits(bytes * mesh.num_points()) && Base::DecodeAllAttributes();
  }

 private:
  bool fits(uint64_t bytes) {
    too_large_ = bytes > budget_;
    return !too_large_;
  }

  uint64_t budget_;
  bool edgebreaker_, too_large_ = false;
};

template <class Decoder>
void decode_with(Decoder&& decoder, draco::DecoderBuffer& buffer, draco::Mesh& mesh, const std::string& where) {
  const draco::Status status = decoder.Decode(draco::DecoderOptions(), &buffer, &mesh);
  if (decoder.too_large())
    fail(where, "the Draco header declares more data than " +
                    std::to_string(buffer.decoded_size() + buffer.remaining_size()) + " compressed bytes can hold");
  if (!status.ok()) fail(where, "the Draco data are damaged: " + status.error_msg_string());
}

void decode_mesh(Bytes compressed, draco::Mesh& mesh, const std::string& where) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(compressed.data()), compressed.size());
  draco::DecoderBuffer ahead = buffer;
  draco::DracoHeader header;
  if (!draco::PointCloudDecoder::DecodeHeader(&ahead, &header).ok()) fail(where, "the data are not Draco data");
  if (header.encoder_type != draco::TRIANGULAR_MESH) fail(where, "the Draco data are not a mesh");
  if (header.version_major != 2 || header.version_minor != 2)
    fail(where, "the Draco data have version " + std::to_string(header.version_major) + "." +
                    std::to_string(header.version_minor) + "; glTF allows only 2.2");
  if (header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING)
    decode_with(MemoryLimited<draco::MeshEdgebreakerDecoder>(compressed.size(), true), buffer, mesh, where);
  else if (header.encoder_method == draco::MESH_SEQUENTIAL_ENCODING)
    decode_with(MemoryLimited<draco::MeshSequentialDecoder>(compressed.size(), false), buffer, mesh, where);
  else
    fail(where, "the Draco data use an unknown encoding method");
}

template <class T>
bool convert(const draco::PointAttribute& from, size_t vertices, DracoAttribute& to) {
  std::byte* out = to.values.data();
  for (uint32_t v = 0; v < vertices; ++v, out += to.stride) {
    const draco::AttributeValueIndex value = from.mapped_index(draco::PointIndex(v));
    if (value.value() >= from.size()) return false;
    if (!from.ConvertValue(value, static_cast<int8_t>(to.components), reinterpret_cast<T*>(out))) return false;
  }
  return true;
}

bool convert(const draco::PointAttribute& from, size_t vertices, DracoAttribute& to) {
  switch (to.component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return convert<int8_t>(from, vertices, to);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return convert<uint8_t>(from, vertices, to);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return convert<int16_t>(from, vertices, to);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return convert<uint16_t>(from, vertices, to);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return convert<uint32_t>(from, vertices, to);
    default:
      return convert<float>(from, vertices, to);
  }
}

// Converts one decoded attribute to the requested type.
void convert_attribute(const InputFile& input, const draco::Mesh& mesh, DracoAttribute& attribute,
                       const std::string& where) {
  const std::string name = where + ".attributes." + attribute.name;
  const draco::PointAttribute* from = mesh.GetAttributeByUniqueId(attribute.id);
  if (!from) fail(name, "the Draco data have no attribute " + std::to_string(attribute.id));
  const auto size = static_cast<size_t>(
      tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(attribute.component_type)) * attribute.components);
  attribute.stride = (size + 3) / 4 * 4;
  check_memory(input, attribute.stride * mesh.num_points(), name);
  attribute.values.resize(attribute.stride * mesh.num_points());
  if (!convert(*from, mesh.num_points(), attribute)) fail(name, "the Draco data are damaged: values are missing");
}

}  // namespace

DracoMesh decode_draco(const InputFile& input, Bytes compressed, std::vector<DracoAttribute>& attributes,
                       const std::string& where) {
  draco::Mesh mesh;
  decode_mesh(compressed, mesh, where);
  DracoMesh result;
  result.vertices = mesh.num_points();
  check_memory(input, uint64_t{mesh.num_faces()} * 3 * sizeof(uint32_t), where);
  result.indices.reserve(size_t{mesh.num_faces()} * 3);
  for (uint32_t f = 0; f < mesh.num_faces(); ++f)
    for (const draco::PointIndex& corner : mesh.face(draco::FaceIndex(f))) {
      if (corner.value() >= mesh.num_points())
        fail(where, "the Draco data are damaged: a triangle refers to a missing vertex");
      result.indices.push_back(corner.value());
    }
  for (DracoAttribute& attribute : attributes) convert_attribute(input, mesh, attribute, where);
  return result;
}

}  // namespace etendue::scene::gltf
