// Limits of OpenEXR files, so that a damaged header cannot cause large allocations.
//
// A part must be a flat image that fits into the length of its file, however well it is compressed. All channels
// together have at most 2^30 values (4 GiB). The display window has at most 2^25 pixels, or as many as are stored.
#pragma once
#include <ImfMultiPartInputFile.h>

#include "image/format.h"

namespace etendue::image {

// The number of integers from `min` to `max`.
inline uint64_t extent(int min, int max) { return max < min ? 0 : static_cast<uint64_t>(int64_t{max} - min + 1); }
inline uint64_t width_of(const Imath::Box2i& box) { return extent(box.min.x, box.max.x); }
inline uint64_t height_of(const Imath::Box2i& box) { return extent(box.min.y, box.max.y); }

// An error if a part of the file exceeds a limit. `bytes` is the whole file.
Result<void> check_exr_parts(const Imf::MultiPartInputFile& file, Bytes bytes, const std::string& name);

}  // namespace etendue::image
