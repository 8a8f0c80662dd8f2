// Reading whole files, and writing files atomically: a reader sees the old content or the new one, never a part.
#pragma once
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/result.h"

namespace etendue {

// The content of a file. Directories, missing files and unreadable files are input errors; the message names the path.
Result<std::vector<std::byte>> read_file(const std::filesystem::path& path);

// An error unless the path is that of a regular file; the message names the path.
Result<void> check_readable(const std::filesystem::path& path);

// Calls `write` with the name of a temporary file in the folder of `path` and with its extension. If `write` succeeds,
// the temporary file is renamed to `path`, otherwise it is removed. A failure leaves an existing file unchanged. A
// symbolic link is followed. A device or a pipe is not replaced: `write` receives its name.
Result<void> write_atomically(const std::filesystem::path& path,
                              const std::function<Result<void>(const std::filesystem::path&)>& write);

// An error if write_atomically could not create its temporary file, for example in a read-only folder.
Result<void> check_writable(const std::filesystem::path& path);

// Writes `size` bytes with write_atomically.
Result<void> write_file(const std::filesystem::path& path, const void* data, size_t size);

}  // namespace etendue
