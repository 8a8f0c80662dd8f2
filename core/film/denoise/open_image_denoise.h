// Open Image Denoise, a denoiser by a trained network, if its library is installed
//
// The library libOpenImageDenoise of version 1 or 2 is looked for when it is first needed, in the places of the dynamic
// linker (LD_LIBRARY_PATH, /etc/ld.so.conf). The program is built without it.
#pragma once
#include <functional>
#include <vector>

#include "base/result.h"
#include "film/denoise/denoise_input.h"

namespace etendue::film {

// An error if the library is not installed.
Result<void> find_open_image_denoise();

// The denoised image, from the averages of the half-buffers and of their features, on the processor. Values that are not
// finite count as 0. Without features, the image alone is used. With 0 threads: one per hardware thread. Empty if
// `continues`, which is called during the work, returns false. Errors: the library is not installed, or it reports one.
Result<std::vector<Rgb>> denoise_with_open_image_denoise(const DenoiseInput& input, int threads,
                                                         const std::function<bool()>& continues);

}  // namespace etendue::film
