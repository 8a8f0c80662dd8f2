// Checks of file headers that OpenImageIO 2.4 lacks.
#pragma once
#include <string>

#include "base/result.h"

namespace etendue::openimageio {

// Fails for headers with which OpenImageIO does not end or allocates gigabytes: DDS files without a bit mask for a channel,
// and DPX and PSD files with a section that is longer than the file. `name` is the file in messages.
Result<void> check_header(const std::string& path, const std::string& name);

}  // namespace etendue::openimageio
