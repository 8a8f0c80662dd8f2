// The images of the manual, rendered by this program.
#pragma once
#include <filesystem>

#include "base/result.h"

namespace etendue::cli {

// Writes one PNG file per entry of the registries, "KIND-NAME.png", into a folder. Stability cases whose images are of
// one colour have none. Takes some minutes.
Result<void> write_manual_images(const std::filesystem::path& folder, int threads);

}  // namespace etendue::cli
