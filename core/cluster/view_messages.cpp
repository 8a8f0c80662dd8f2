#include "cluster/view_messages.h"

#include "base/state_bytes.h"
#include "cluster/message_text.h"

namespace etendue::cluster {
namespace {

StateWriter begun(ViewMessageKind kind) {
  StateWriter out;
  out.value(static_cast<uint8_t>(kind));
  return out;
}

}  // namespace

std::optional<ViewMessageKind> view_kind_of(std::span<const std::byte> message) {
  if (message.empty()) return std::nullopt;
  const auto kind = static_cast<ViewMessageKind>(message[0]);
  return kind >= ViewMessageKind::stop && kind <= ViewMessageKind::film ? std::optional(kind) : std::nullopt;
}

std::vector<std::byte> view_message(ViewMessageKind kind) { return begun(kind).take(); }

std::vector<std::byte> epoch_message(ViewMessageKind kind, uint64_t epoch) {
  StateWriter out = begun(kind);
  out.value(epoch);
  return out.take();
}

std::optional<uint64_t> epoch_from(std::span<const std::byte> body) {
  uint64_t epoch = 0;
  return StateReader(body).value(epoch) ? std::optional(epoch) : std::nullopt;
}

std::vector<std::byte> document_message(ViewMessageKind kind, const DocumentMessage& content) {
  StateWriter out = begun(kind);
  out.value(content.epoch);
  write_text(out, content.text);
  return out.take();
}

std::optional<DocumentMessage> document_message_from(std::span<const std::byte> body) {
  DocumentMessage content;
  StateReader in(body);
  return in.value(content.epoch) && read_text(in, content.text) ? std::optional(std::move(content)) : std::nullopt;
}

std::vector<std::byte> hold_message(bool stopped) {
  StateWriter out = begun(ViewMessageKind::hold);
  out.value<uint8_t>(stopped);
  return out.take();
}

std::optional<bool> hold_from(std::span<const std::byte> body) {
  uint8_t stopped = 0;
  return StateReader(body).value(stopped) ? std::optional(stopped != 0) : std::nullopt;
}

std::vector<std::byte> encoded(const ReadyMessage& content) {
  StateWriter out = begun(ViewMessageKind::ready);
  out.value(content.epoch);
  out.value(content.identity.scene_hash);
  write_text(out, content.identity.version);
  return out.take();
}

std::optional<ReadyMessage> ready_message_from(std::span<const std::byte> body) {
  ReadyMessage content;
  StateReader in(body);
  if (!in.value(content.epoch) || !in.value(content.identity.scene_hash) || !read_text(in, content.identity.version))
    return std::nullopt;
  return content;
}

std::vector<std::byte> encoded(const PieceMessage& content) {
  StateWriter out = begun(ViewMessageKind::piece);
  out.value(content.epoch);
  out.value(content.piece);
  return out.take();
}

std::optional<PieceMessage> piece_message_from(std::span<const std::byte> body) {
  PieceMessage content;
  StateReader in(body);
  if (!in.value(content.epoch) || !in.value(content.piece) || content.piece.samples.is_empty()) return std::nullopt;
  return content;
}

std::vector<std::byte> encoded(const RenderedMessage& content) {
  StateWriter out = begun(ViewMessageKind::rendered);
  out.value(content.epoch);
  out.value(content.samples);
  out.value(content.seconds);
  return out.take();
}

std::optional<RenderedMessage> rendered_message_from(std::span<const std::byte> body) {
  RenderedMessage content;
  StateReader in(body);
  if (!in.value(content.epoch) || !in.value(content.samples) || !in.value(content.seconds)) return std::nullopt;
  return content;
}

std::vector<std::byte> encoded(const FilmMessage& content) {
  StateWriter out = begun(ViewMessageKind::film);
  out.value(content.epoch);
  out.list(std::span<const uint64_t>(content.pieces));
  std::vector<std::byte> bytes = out.take();
  bytes.insert(bytes.end(), content.result.begin(), content.result.end());
  return bytes;
}

std::optional<FilmMessage> film_message_from(std::span<const std::byte> body) {
  FilmMessage content;
  StateReader in(body);
  if (!in.value(content.epoch) || !in.list(content.pieces)) return std::nullopt;
  content.result = body.subspan(sizeof(uint64_t) * (content.pieces.size() + 2));  // epoch, number and pieces
  return content;
}

}  // namespace etendue::cluster
