// Photometric profiles by name: files, and profiles that the program computes.
#pragma once
#include <array>
#include <memory>
#include <string>
#include <string_view>

#include "base/parameter.h"
#include "light/photometry_profile.h"

namespace etendue {

// Names of profiles that the program computes; the first one is the same in all directions.
extern const std::array<Option, 4> kPhotometryProfiles;

// A profile by such a name or by the path of a file. Files are read once. A source that `accepts_photometry` rejects is
// the first profile.
std::shared_ptr<const PhotometryProfile> photometry_profile(const std::string& source);
Result<void> accepts_photometry(std::string_view source);

}  // namespace etendue
