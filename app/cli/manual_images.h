// The images of the manual, rendered by this program.
#pragma once
#include <filesystem>

#include "base/result.h"

namespace etendue::cli {

// Writes one PNG file per entry of the registries, "KIND-NAME.png", into a folder; `only_missing` keeps existing ones.
// Stability cases whose images are of one colour have none. Takes some minutes.
Result<void> write_manual_images(const std::filesystem::path& folder, int threads, bool only_missing);

}  // namespace etendue::cli
