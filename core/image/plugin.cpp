#include "image/plugin.h"

#include <dlfcn.h>

#include <vector>

#include "base/plugin_folders.h"

namespace etendue::image {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPluginFile = "libetendue_openimageio.so";

}  // namespace

Result<const ImagePlugin*> load_image_plugin(const std::vector<fs::path>& folders) {
  const auto unavailable = [](const std::string& reason) { return input_error("needs OpenImageIO, " + reason); };
  for (const fs::path& folder : folders) {
    const fs::path file = folder / kPluginFile;
    std::error_code code;
    if (!fs::exists(file, code)) continue;
    void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!library)
      return unavailable("which cannot be loaded (" + std::string(dlerror()) +
                         "); install the package libopenimageio2.4");
    const auto get = reinterpret_cast<GetImagePlugin>(dlsym(library, kGetImagePlugin));
    if (const ImagePlugin* plugin = get ? get(kPluginVersion) : nullptr) return plugin;
    return unavailable("but " + file.string() + " is of another version of this program; build both again");
  }
  return unavailable(std::string("but this program has no ") + kPluginFile +
                     "; install the package libopenimageio-dev and build again");
}

Result<const ImagePlugin*> image_plugin() {
  static const Result<const ImagePlugin*> plugin = load_image_plugin(plugin_folders());
  return plugin;
}

}  // namespace etendue::image
