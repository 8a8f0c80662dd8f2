// An RGL measurement (bsdf/measured/tensor_file.h), assembled byte by byte.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace etendue::test {

// An isotropic measurement at two polar angles. All grids have 2 x 2 nodes with the value 1, except for the projected
// area and the distribution of microfacets.
inline std::vector<char> rgl_bytes(float area, float facets) {
  struct Field {
    std::string name;
    std::vector<uint64_t> shape;
    float value = 1;
  };
  const std::vector<Field> fields{{"phi_i", {1}},          {"theta_i", {2}},       {"ndf", {2, 2}, facets},
                                  {"sigma", {2, 2}, area}, {"vndf", {1, 2, 2, 2}}, {"luminance", {1, 2, 2, 2}},
                                  {"rgb", {1, 2, 3, 2, 2}}};
  const std::string head("tensor_file\0\x01\0", 14);
  std::vector<char> file(head.begin(), head.end()), values;
  const auto put = [](std::vector<char>& out, const auto& x) {
    const char* p = reinterpret_cast<const char*>(&x);
    out.insert(out.end(), p, p + sizeof x);
  };
  uint64_t offset = file.size() + sizeof(uint32_t);
  for (const Field& field : fields) offset += 2 + field.name.size() + 2 + 1 + 8 + 8 * field.shape.size();
  put(file, static_cast<uint32_t>(fields.size()));
  for (const Field& field : fields) {
    put(file, static_cast<uint16_t>(field.name.size()));
    file.insert(file.end(), field.name.begin(), field.name.end());
    put(file, static_cast<uint16_t>(field.shape.size()));
    put(file, uint8_t{10});  // 32 bit floats
    put(file, offset + values.size());
    uint64_t count = 1;
    for (const uint64_t size : field.shape) {
      put(file, size);
      count *= size;
    }
    for (uint64_t k = 0; k < count; ++k)
      put(values, field.name == "theta_i" ? static_cast<float>(k) * 1.5f : field.value);
  }
  file.insert(file.end(), values.begin(), values.end());
  return file;
}

}  // namespace etendue::test
