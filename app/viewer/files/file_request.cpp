#include "viewer/files/file_request.h"

#include <utility>

#include "image/format.h"

namespace etendue::viewer {

FileRequest image_file_request(std::string title, std::string name, std::function<void(const std::string&)> accept) {
  FileRequest request;
  request.title = std::move(title);
  request.saves = true;
  request.name = std::move(name);
  request.accept = std::move(accept);
  for (const image::ImageFormat* format : image::image_formats())
    if (format->can_write()) {
      request.extensions.emplace_back(format->extensions.front());
      request.formats.emplace_back(format->label);
    }
  return request;
}

}  // namespace etendue::viewer
