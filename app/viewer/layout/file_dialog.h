// Choosing a file: folders and the files that can be used, a field for the name.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace etendue::viewer {

struct Workbench;

class FileDialog {
 public:
  // `extensions` with their dots; `chosen` gets the path. A dialog that saves accepts names that do not exist yet.
  void ask(std::string title, std::string folder, std::vector<std::string> extensions, bool saves, std::string name,
           std::function<void(const std::string&)> chosen);
  bool is_open() const { return open_; }
  void draw(Workbench& w);

 private:
  void read_folder();
  void enter(const std::filesystem::path& folder);

  bool open_ = false, appearing_ = false, saves_ = false;
  std::string title_, name_, problem_;
  std::vector<std::string> extensions_;
  std::filesystem::path folder_;
  std::vector<std::string> folders_, files_;
  std::function<void(const std::string&)> chosen_;
};

}  // namespace etendue::viewer
