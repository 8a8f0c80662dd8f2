// The lengths of the attributes in the headers of an OpenEXR file. The library allocates the length that an attribute
// states before it reads it, up to 2 GiB, so lengths are checked before the library sees the file.
#pragma once
#include "image/format.h"

namespace etendue::image {

// An error if an attribute of the file is longer than the rest of the file, or does not have the length of its type.
// `bytes` is the whole file, which begins with the magic number of OpenEXR.
Result<void> check_exr_attributes(Bytes bytes, const std::string& name);

}  // namespace etendue::image
