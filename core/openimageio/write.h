#pragma once
#include "image/plugin_interface.h"

namespace etendue::openimageio {

// Writes an RGB image, as ImagePlugin::write describes.
Result<void> write_image(const image::PluginWrite& request);

}  // namespace etendue::openimageio
