// Reading whole files, and writing them so that a reader never sees half of one.
#pragma once
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/result.h"

namespace etendue {

// The whole file. Directories, missing and unreadable files are input errors that name the path.
Result<std::vector<std::byte>> read_file(const std::filesystem::path& path);

// Calls `write` with a temporary name in the same folder and renames it to `path` if it succeeded; removes it if not.
// The temporary name keeps the extension of `path`. What stood there before survives every failure.
Result<void> write_atomically(const std::filesystem::path& path,
                              const std::function<Result<void>(const std::filesystem::path&)>& write);

// The same for bytes that are already there.
Result<void> write_file(const std::filesystem::path& path, const void* data, size_t size);

}  // namespace etendue
