#include "cluster/sent_scene.h"

#include <utility>

#include "base/state_bytes.h"
#include "cluster/message_text.h"
#include "cluster/messages.h"

namespace etendue::cluster {
std::vector<std::byte> sent_scene_message(const SentScene& scene) {
  StateWriter out;
  write_text(out, scene.state);
  for (const ProvidedFile& file : scene.files) {
    write_text(out, file.path);
    out.list(std::span<const std::byte>(file.bytes));
  }
  return message(MessageKind::scene, out.take());
}

std::optional<SentScene> sent_scene_from(std::span<const std::byte> body) {
  SentScene scene;
  StateReader in(body);
  if (!read_text(in, scene.state)) return std::nullopt;
  while (!in.at_end()) {
    ProvidedFile file;
    if (!read_text(in, file.path) || !in.list(file.bytes)) return std::nullopt;
    scene.files.push_back(std::move(file));
  }
  return scene;
}

void pass_on(Communicator& communicator, const std::vector<std::byte>& message) {
  const int first = 2 * communicator.rank() + 1;
  for (int rank = first; rank <= first + 1 && rank < communicator.size(); ++rank) communicator.send(rank, message);
}

}  // namespace etendue::cluster
