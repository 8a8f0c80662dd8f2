// A file in memory, for readers that open a path.
#pragma once
#include <sys/mman.h>
#include <unistd.h>

#include <string>

#include "integration/fuzz/target.h"

namespace etendue::fuzz {

class MemoryFile {
 public:
  explicit MemoryFile(Input content) : descriptor_(::memfd_create("input", 0)) {
    require(descriptor_ >= 0 &&
                ::write(descriptor_, content.data(), content.size()) == static_cast<ssize_t>(content.size()),
            "the input could not be written to memory");
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { ::close(descriptor_); }

  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

}  // namespace etendue::fuzz
