// What core/openvdb offers to core/medium
//
// OpenVDB depends on about 30 shared libraries. Its code is therefore in a plugin: a shared library that grid_plugin.h
// loads when the first file needs it. The plugin and the program are built together; kGridPluginVersion detects a
// plugin of another build.
#pragma once
#include <cstddef>
#include <span>
#include <string>

#include "base/result.h"
#include "medium/density_grid.h"

namespace etendue {

// Increase it with every change of this file or of GridValues.
inline constexpr int kGridPluginVersion = 1;

class GridPlugin {
 public:
  // All functions catch all exceptions. Errors are messages for users.

  // The grids `density` (or the first one of floats) and `temperature` of an OpenVDB file, in the bounding box of the
  // active voxels of the density. Grids with more voxels than `most_voxels` are refused. `name` stands for the file in
  // messages. Values are those of the file.
  virtual Result<GridValues> read_vdb(std::span<const std::byte> bytes, const std::string& name,
                                      size_t most_voxels) const = 0;
  // Decompresses one buffer of Blosc that fills `to`; false if it is damaged.
  virtual bool decompress_blosc(std::span<const std::byte> from, std::span<std::byte> to) const = 0;

 protected:
  ~GridPlugin() = default;
};

// The plugin exports `const void* etendue_grid_plugin(int version)` (base/load_plugin.h), whose result points to a
// GridPlugin.
inline constexpr const char* kGetGridPlugin = "etendue_grid_plugin";

}  // namespace etendue
