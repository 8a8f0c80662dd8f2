#pragma once
#include "image/plugin_interface.h"

namespace etendue::openimageio {

// The first image of a file, as ImagePlugin::read describes.
Result<image::Image> read_image(const image::PluginRead& request);

}  // namespace etendue::openimageio
