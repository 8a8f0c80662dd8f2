// The tensor files of the RGL material database (`.bsdf`).
//
//   "tensor_file\0"  version: u8 1, u8 0  number of fields: u32
//   each field       name: u16 length and bytes, dimensions: u16, type: u8, offset in the file: u64, sizes: u64 each
//
// Little-endian. Types are 1 (u8) .. 9, 10 (f32), 11 (f64); only f32 is read.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace etendue {

// Row-major: the last dimension varies fastest.
struct Tensor {
  std::vector<size_t> shape;
  std::vector<float> values;
};

class TensorFile {
 public:
  // A damaged directory of fields is an input error. Allocations are bounded by the size of the file.
  static Result<TensorFile> read(const std::filesystem::path& path);

  bool has(std::string_view name) const { return find(name) != nullptr; }
  // A field of 32 bit floats with this number of dimensions. A missing field, another type or a value that is not
  // finite is an input error.
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
