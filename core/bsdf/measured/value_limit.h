// The range of values in files of measured BRDFs.
#pragma once

namespace etendue {

// Larger values are rejected, so that products of three tabulated values are finite. The narrowest lobes that can be
// measured stay below 1e8 / sr.
inline constexpr float kMostTabulated = 1e12f;

}  // namespace etendue
