#include "unit/project/source_tree.h"

#include <algorithm>
#include <fstream>

namespace etendue::test {

std::string SourceFile::unit() const { return path.substr(0, path.rfind('.')); }

std::filesystem::path source_root() { return ETENDUE_SOURCE_DIR; }

std::vector<SourceFile> source_files(const std::string& folder, const std::vector<std::string>& extensions) {
  std::vector<SourceFile> files;
  const auto root = source_root();
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
    const std::string extension = entry.path().extension().string();
    if (!entry.is_regular_file() || std::ranges::find(extensions, extension) == extensions.end()) continue;
    SourceFile file{entry.path().lexically_relative(root).generic_string(), {}};
    std::ifstream in(entry.path());
    for (std::string line; std::getline(in, line);) file.lines.push_back(line);
    files.push_back(std::move(file));
  }
  std::ranges::sort(files, {}, &SourceFile::path);
  return files;
}

}  // namespace etendue::test
