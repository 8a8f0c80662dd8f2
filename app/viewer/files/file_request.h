// A request for a file name, which the file dialog answers.
#pragma once
#include <functional>
#include <string>
#include <vector>

namespace etendue::viewer {

struct FileRequest {
  std::string title;
  std::vector<std::string> extensions;  // of the files that are listed, with their dots
  // What a saved file can be, "PNG" for ".png"; one for each extension, or none. The user can choose among them.
  std::vector<std::string> formats{};
  bool saves = false;    // names that do not exist yet are accepted
  std::string name{};    // proposed name
  std::string folder{};  // that is shown first; empty: the folder of the last file
  std::function<void(const std::string& path)> accept;
};

// A request for the name of an image file in one of the formats that can be written.
FileRequest image_file_request(std::string title, std::string name, std::function<void(const std::string&)> accept);

}  // namespace etendue::viewer
