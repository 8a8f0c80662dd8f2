// A rank that adds up the results of other ranks for rank 0 (cluster/collectors.h).
//
// A result that has arrived is reported to rank 0, which decides whether it is added: its samples may have arrived by
// another rank already.
#pragma once
#include <map>
#include <span>

#include "cluster/communicator.h"
#include "cluster/messages.h"
#include "cluster/piece_result.h"

namespace etendue::cluster {

class Collector {
 public:
  Collector(Communicator& communicator, int width, int height)
      : communicator_(communicator), width_(width), height_(height) {}

  // The result of a rank has arrived.
  void receive(int rank, std::span<const std::byte> bytes);
  // Rank 0 has decided about the last result of a rank.
  void decide(const Decision& decision);
  // Sends the sum to rank 0 and begins again.
  void send_sum();

 private:
  void clear();

  Communicator& communicator_;
  int width_, height_;
  std::map<int, PieceResult> waiting_;  // for a decision, by rank
  PieceResult sum_;
};

}  // namespace etendue::cluster
