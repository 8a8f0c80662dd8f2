#include "cluster/messages.h"

#include "base/state_bytes.h"

namespace etendue::cluster {

std::optional<MessageKind> kind_of(std::span<const std::byte> message) {
  if (message.empty()) return std::nullopt;
  const auto kind = static_cast<MessageKind>(message[0]);
  return kind >= MessageKind::document && kind <= MessageKind::goodbye ? std::optional(kind) : std::nullopt;
}

std::vector<std::byte> message(MessageKind kind, std::span<const std::byte> body) {
  std::vector<std::byte> bytes;
  bytes.reserve(1 + body.size());
  bytes.push_back(static_cast<std::byte>(kind));
  bytes.insert(bytes.end(), body.begin(), body.end());
  return bytes;
}

std::vector<std::byte> text_message(MessageKind kind, const std::string& text) {
  return message(kind, std::as_bytes(std::span(text)));
}

std::string text_of(std::span<const std::byte> body) {
  return {reinterpret_cast<const char*>(body.data()), body.size()};
}

std::vector<std::byte> ready_message(const RankIdentity& identity) {
  StateWriter out;
  out.value(identity.scene_hash);
  out.list(std::span<const char>(identity.version));
  return message(MessageKind::ready, out.take());
}

std::optional<RankIdentity> identity_from(std::span<const std::byte> body) {
  RankIdentity identity;
  std::vector<char> version;
  StateReader in(body);
  if (!in.value(identity.scene_hash) || !in.list(version)) return std::nullopt;
  identity.version.assign(version.begin(), version.end());
  return identity;
}

std::vector<std::byte> piece_message(const Piece& piece) {
  StateWriter out;
  out.value(piece);
  return message(MessageKind::piece, out.take());
}

std::optional<Piece> piece_from(std::span<const std::byte> body) {
  Piece piece;
  if (!StateReader(body).value(piece) || piece.samples.is_empty()) return std::nullopt;
  return piece;
}

}  // namespace etendue::cluster
