// The glTF files of the test data, and how to look at them as others did.                    data README
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "render/document.h"

namespace etendue::looks {

// One file from one side.
struct View {
  std::string name;  // its path below gltf/
  std::filesystem::path file;
  std::filesystem::path environment;            // none: the file's own light
  std::optional<Camera> camera;                 // the published one; the file's own or a fitting one without it
  std::optional<Vec3> from;                     // where the published camera stands, if only its direction is known
  float exposure = 0;                           // EV of the environment, at which white is as bright as published
  bool background = false;                      // whether the published pictures show the environment
  double aspect = 1;                            // width over height of the published picture
  std::vector<std::filesystem::path> pictures;  // published pictures, display-encoded
};

// A linear picture with everything known that it depends on.
struct Reference {
  View view;
  int width = 0, height = 0;
  std::filesystem::path linear;
};

// Every .glb and .gltf below gltf/, sorted by name.
std::vector<View> gallery(const std::filesystem::path& data);
// What fidelity/cycles holds, sorted by name.
std::vector<Reference> references(const std::filesystem::path& data);
// The folders of scenes/, sorted by name.
std::vector<Reference> scenes(const std::filesystem::path& data);

// The view as a document whose larger side is `size` pixels; without animations if there are pictures of it.
Result<render::Document> open(const View& view, int size, bool environment_visible);

}  // namespace etendue::looks
