#include "message.h"

namespace etendue::openimageio {

std::string cleaned(std::string message, const std::string& path) {
  message = message.substr(0, message.find('\n'));
  for (const std::string& quoted : {"\"" + path + "\"", "'" + path + "'", path})
    for (size_t at = message.find(quoted); at != std::string::npos; at = message.find(quoted))
      message.replace(at, quoted.size(), "the file");
  while (!message.empty() && (message.back() == '.' || message.back() == ' ')) message.pop_back();
  return message.empty() ? "the data are damaged or truncated" : message;
}

}  // namespace etendue::openimageio
