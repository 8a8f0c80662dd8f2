#include "cluster/messages.h"

#include "base/state_bytes.h"

namespace etendue::cluster {
namespace {

template <class Value>
std::vector<std::byte> value_message(MessageKind kind, const Value& value) {
  StateWriter out;
  out.value(value);
  return message(kind, out.take());
}

template <class Value>
std::optional<Value> value_from(std::span<const std::byte> body) {
  Value value;
  StateReader in(body);
  return in.value(value) && in.at_end() ? std::optional(value) : std::nullopt;
}

}  // namespace

std::optional<MessageKind> kind_of(std::span<const std::byte> message) {
  if (message.empty()) return std::nullopt;
  const auto kind = static_cast<MessageKind>(message[0]);
  return kind >= MessageKind::document && kind <= MessageKind::scene ? std::optional(kind) : std::nullopt;
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

std::vector<std::byte> piece_message(const Piece& piece) { return value_message(MessageKind::piece, piece); }

std::optional<Piece> piece_from(std::span<const std::byte> body) {
  const auto piece = value_from<Piece>(body);
  return piece && !piece->samples.is_empty() && piece->collector >= 0 ? piece : std::nullopt;
}

std::vector<std::byte> arrival_message(const Arrival& arrival) { return value_message(MessageKind::arrival, arrival); }
std::optional<Arrival> arrival_from(std::span<const std::byte> body) { return value_from<Arrival>(body); }
std::vector<std::byte> decision_message(const Decision& decision) {
  return value_message(MessageKind::decision, decision);
}
std::optional<Decision> decision_from(std::span<const std::byte> body) { return value_from<Decision>(body); }

}  // namespace etendue::cluster
