// The files of the source tree, for tests that read them.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace etendue::test {

struct SourceFile {
  std::string path;  // relative to the root, with '/'
  std::vector<std::string> lines;

  // The same path without its extension: a header and its implementation are one unit.
  std::string unit() const;
  bool ends_with(std::string_view extension) const { return path.ends_with(extension); }
};

// The root of the source tree.
std::filesystem::path source_root();

// All files below `folder` (relative to the root) with one of these extensions, sorted by path.
std::vector<SourceFile> source_files(const std::string& folder, const std::vector<std::string>& extensions);

}  // namespace etendue::test
