#include "cluster/collector.h"

#include <utility>

#include "render/tail_statistics.h"

namespace etendue::cluster {

void Collector::receive(int rank, std::span<const std::byte> bytes) {
  auto result = piece_result_from(bytes, width_, height_);
  communicator_.send(0, arrival_message({rank, result ? 0 : 1, result ? result->piece.id : 0}));
  if (result) waiting_.insert_or_assign(rank, std::move(*result));
}

void Collector::decide(const Decision& decision) {
  const auto found = waiting_.find(decision.rank);
  if (found == waiting_.end() || found->second.piece.id != decision.piece) return;
  const PieceResult result = std::move(found->second);
  waiting_.erase(found);
  if (decision.is_added == 0) return;
  if (sum_.samples.film.width() == 0) clear();
  add_samples(sum_.samples, result.samples);
  sum_.rays += result.rays;
  sum_.paths += result.paths;
}

void Collector::send_sum() {
  if (sum_.samples.film.width() == 0) clear();
  communicator_.send(0, message(MessageKind::sum, bytes_of(sum_)));
  sum_ = {};
}

void Collector::clear() {
  sum_ = {};
  sum_.samples.film = film::Film(width_, height_);
  sum_.samples.tails.resize(render::TailStatistics::tile_count(width_, height_));
}

}  // namespace etendue::cluster
