// Messages of OpenImageIO as messages for users.
#pragma once
#include <string>

namespace etendue::openimageio {

// The first line of `message`, with the path of a temporary file removed.
std::string cleaned(std::string message, const std::string& path);

}  // namespace etendue::openimageio
