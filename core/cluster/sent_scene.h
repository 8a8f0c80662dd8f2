// A document with the files of its scene, which rank 0 sends to ranks that cannot or should not read them.
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/provided_files.h"
#include "cluster/communicator.h"

namespace etendue::cluster {

struct SentScene {
  std::string state;  // of the document (render::state_json)
  std::vector<ProvidedFile> files;
};

std::vector<std::byte> sent_scene_message(const SentScene& scene);
// Nothing if the bytes are damaged.
std::optional<SentScene> sent_scene_from(std::span<const std::byte> body);

// Sends a message of rank 0 to the next ranks of a binary tree: from rank r to 2r + 1 and 2r + 2. Rank 0 sends it twice,
// however many ranks there are.
void pass_on(Communicator& communicator, const std::vector<std::byte>& message);

}  // namespace etendue::cluster
