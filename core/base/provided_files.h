// Files that another process has read and sent, and the names of the files that this process reads.
//
// A process that receives a scene has no access to its files, but reads them by the same names with the functions of
// base/file.h.
#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace etendue {

struct ProvidedFile {
  std::string path;
  std::vector<std::byte> bytes;
};

// From now on, read_file returns these contents. They take precedence over files on disk.
void provide_files(std::vector<ProvidedFile> files);
// The content of a provided file; null if there is none of this name. It exists until the process ends.
const std::vector<std::byte>* provided_file(const std::filesystem::path& path);
// Whether there is a provided file or a regular file of this name.
bool is_file(const std::filesystem::path& path);

// From now on, the names of the files that read_file reads are recorded.
void record_files_read();
// The recorded names, each once.
std::vector<std::string> files_read();
// Called by read_file.
void note_file_read(const std::filesystem::path& path);

}  // namespace etendue
