// Tensor files, in which the RGL material database keeps its measurements (`.bsdf`).
//
//   "tensor_file\0"  version: u8 1, u8 0  fields: u32
//   each field       name: u16 length and bytes, dimensions: u16, type: u8, offset in the file: u64, sizes: u64 each
//
// Little-endian. Types are 1 (u8) .. 9, 10 (f32), 11 (f64); only those read here are looked at.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace etendue {

struct Tensor {
  std::vector<size_t> shape;
  std::vector<float> values;
};

class TensorFile {
 public:
  // Whatever is damaged in the directory of fields is an error. Nothing is allocated by what the file claims alone.
  static Result<TensorFile> read(const std::filesystem::path& path);

  bool has(std::string_view name) const { return find(name) != nullptr; }
  // A field of 32 bit floats, all of them finite, with so many dimensions.
  Result<Tensor> floats(std::string_view name, size_t dimensions) const;

 private:
  struct Field {
    std::string name;
    uint8_t type = 0;
    uint64_t offset = 0, count = 0;
    std::vector<size_t> shape;
  };
  const Field* find(std::string_view name) const;
  Error wrong(const std::string& what) const { return input_error(path_ + ": " + what); }

  std::string path_;
  std::vector<std::byte> bytes_;
  std::vector<Field> fields_;
};

}  // namespace etendue
