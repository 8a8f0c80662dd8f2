// What ranks send to each other, besides the results of pieces (piece_result.h). Rank 0 manages the others.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cluster/work_schedule.h"

namespace etendue::cluster {

// The first byte of a message.
enum class MessageKind : uint8_t {
  document = 1,  // from rank 0: the state of the document (render::state_json)
  ready,         // to rank 0: the rank has opened the document
  failed,        // to rank 0: the rank cannot render the document, as a text
  piece,         // from rank 0: to be rendered
  result,        // to rank 0
  quit,          // from rank 0: the job has ended
  goodbye        // to rank 0: answer to `quit`; the rank sends nothing more
};

// What must be equal on all ranks.
struct RankIdentity {
  std::string version;      // of the program
  uint64_t scene_hash = 0;  // of everything that determines the samples

  friend bool operator==(const RankIdentity&, const RankIdentity&) = default;
};

std::optional<MessageKind> kind_of(std::span<const std::byte> message);
inline std::span<const std::byte> body_of(std::span<const std::byte> message) { return message.subspan(1); }

std::vector<std::byte> message(MessageKind kind, std::span<const std::byte> body = {});
std::vector<std::byte> text_message(MessageKind kind, const std::string& text);
std::string text_of(std::span<const std::byte> body);
std::vector<std::byte> ready_message(const RankIdentity& identity);
std::optional<RankIdentity> identity_from(std::span<const std::byte> body);
std::vector<std::byte> piece_message(const Piece& piece);
std::optional<Piece> piece_from(std::span<const std::byte> body);

}  // namespace etendue::cluster
