// A request for a file name, which the file dialog answers.
#pragma once
#include <functional>
#include <string>
#include <vector>

namespace etendue::viewer {

struct FileRequest {
  std::string title;
  std::vector<std::string> extensions;  // of the files that are listed, with their dots
  bool saves = false;                   // names that do not exist yet are accepted
  std::string name{};                   // proposed name
  std::function<void(const std::string& path)> accept;
};

}  // namespace etendue::viewer
