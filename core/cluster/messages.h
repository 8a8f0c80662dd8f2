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
  goodbye,       // to rank 0: answer to `quit`; the rank sends nothing more
  arrival,       // to rank 0: a collector has received a result (cluster/collector.h)
  decision,      // from rank 0: whether the collector adds it
  collect,       // from rank 0: the collector sends its sum
  sum,           // to rank 0: a result without a piece
  scene          // from rank 0, passed on: the document with the files of its scene (cluster/sent_scene.h)
};

// What must be equal on all ranks.
struct RankIdentity {
  std::string version;      // of the program
  uint64_t scene_hash = 0;  // of everything that determines the samples

  friend bool operator==(const RankIdentity&, const RankIdentity&) = default;
};

// A collector has received the result of a rank.
struct Arrival {
  int32_t rank = 0, is_damaged = 0;
  uint64_t piece = 0;
};

// Whether a collector adds the result of a rank.
struct Decision {
  int32_t rank = 0, is_added = 0;
  uint64_t piece = 0;
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
std::vector<std::byte> arrival_message(const Arrival& arrival);
std::optional<Arrival> arrival_from(std::span<const std::byte> body);
std::vector<std::byte> decision_message(const Decision& decision);
std::optional<Decision> decision_from(std::span<const std::byte> body);

}  // namespace etendue::cluster
