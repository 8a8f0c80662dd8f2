// The glTF files of the test data with the views of their published images (see the README of the test data).
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "render/document.h"

namespace etendue::looks {

// A file and a view of it.
struct View {
  std::string name;  // path below gltf/
  std::filesystem::path file;
  std::filesystem::path environment;            // empty: the lights of the file
  std::optional<Camera> camera;                 // published camera; if empty, that of the file or a framing one
  std::optional<Vec3> from;                     // direction of the published camera, if only this is known
  float exposure = 0;                           // EV of the environment that matches the published brightness
  bool background = false;                      // true if the published images show the environment
  double aspect = 1;                            // width over height of the published image
  std::vector<std::filesystem::path> pictures;  // published images, display-encoded
};

// A linear image with all rendering parameters.
struct Reference {
  View view;
  int width = 0, height = 0;
  std::filesystem::path linear;
};

// Every .glb and .gltf below gltf/, sorted by name.
std::vector<View> gallery(const std::filesystem::path& data);
// The references in fidelity/cycles, sorted by name.
std::vector<Reference> references(const std::filesystem::path& data);
// The folders of scenes/, sorted by name.
std::vector<Reference> scenes(const std::filesystem::path& data);

// The view as a document whose longer side is `size` pixels. Without animations if there are published images.
Result<render::Document> open(const View& view, int size, bool environment_visible);

}  // namespace etendue::looks
