// What ranks send to each other while a document is viewed, besides `quit` and `goodbye` (messages.h).
//
// Each document has a number, its epoch. A film carries the epoch of its document, so that rank 0 adds it to no other.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cluster/messages.h"
#include "cluster/piece_result.h"

namespace etendue::cluster {

inline constexpr double kAliveInterval = 1;  // seconds

// The first byte of a message. The numbers differ from those of MessageKind.
enum class ViewMessageKind : uint8_t {
  stop =
      32,  // from rank 0: an epoch begins; samples of earlier ones are of no use. Its document follows if there is one
  document,  // from rank 0: the state of the document of an epoch
  piece,     // from rank 0: to be rendered
  hold,      // from rank 0: whether to stop
  taken,     // from rank 0: a film has been taken; the next one may be sent
  alive,     // both ways, every kAliveInterval
  ready,     // to rank 0: the document of an epoch is open
  failed,    // to rank 0: it cannot be opened, as a text
  rendered,  // to rank 0: a piece is complete; its samples will be delivered
  film       // to rank 0: the samples of pieces
};

std::optional<ViewMessageKind> view_kind_of(std::span<const std::byte> message);

struct DocumentMessage {
  uint64_t epoch = 0;
  std::string text;  // the state, or what is wrong with it
};
struct ReadyMessage {
  uint64_t epoch = 0;
  RankIdentity identity;  // scene_hash: of the document as it was opened, before all edits
};
struct PieceMessage {
  uint64_t epoch = 0;
  Piece piece;
};
struct RenderedMessage {
  uint64_t epoch = 0;
  uint32_t samples = 0;
  double seconds = 0;
};
struct FilmMessage {
  uint64_t epoch = 0;
  std::vector<uint64_t> pieces;       // their numbers
  std::span<const std::byte> result;  // bytes_of their samples (piece_result.h)
};

// Messages, and their bodies. Nothing if a body is damaged.
std::vector<std::byte> view_message(ViewMessageKind kind);
std::vector<std::byte> epoch_message(ViewMessageKind kind, uint64_t epoch);
std::vector<std::byte> document_message(ViewMessageKind kind, const DocumentMessage& content);
std::vector<std::byte> hold_message(bool stopped);
std::vector<std::byte> encoded(const ReadyMessage& content);
std::vector<std::byte> encoded(const PieceMessage& content);
std::vector<std::byte> encoded(const RenderedMessage& content);
std::vector<std::byte> encoded(const FilmMessage& content);
std::optional<uint64_t> epoch_from(std::span<const std::byte> body);
std::optional<DocumentMessage> document_message_from(std::span<const std::byte> body);
std::optional<bool> hold_from(std::span<const std::byte> body);
std::optional<ReadyMessage> ready_message_from(std::span<const std::byte> body);
std::optional<PieceMessage> piece_message_from(std::span<const std::byte> body);
std::optional<RenderedMessage> rendered_message_from(std::span<const std::byte> body);
std::optional<FilmMessage> film_message_from(std::span<const std::byte> body);

}  // namespace etendue::cluster
