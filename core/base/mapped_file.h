// Files whose bytes are mapped into memory: they are read when they are used, and not copied.
//
// Another program may shorten a file while it is mapped. The bytes that are missing then read as zero, and is_damaged()
// states it. Without this, the first access to them would end the process.
#pragma once
#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "base/result.h"

namespace etendue {

class MappedFile {
 public:
  // Errors as read_file. A provided file is not on disk; its bytes are used.
  static Result<MappedFile> open(const std::filesystem::path& path);

  std::span<const std::byte> bytes() const { return bytes_; }
  // Whether the file is shorter than when it was opened, or was when its bytes were used.
  bool is_damaged() const;

 private:
  class Mapping;

  std::span<const std::byte> bytes_;
  std::shared_ptr<const Mapping> mapping_;              // null if the file is not mapped
  std::shared_ptr<const std::vector<std::byte>> copy_;  // of the bytes, if too many files are mapped already
};

}  // namespace etendue
