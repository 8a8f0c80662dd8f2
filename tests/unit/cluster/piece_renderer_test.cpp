// Rendering of one piece after the other.
#include "cluster/piece_renderer.h"

#include <gtest/gtest.h>

#include <chrono>
#include <optional>
#include <thread>

namespace etendue::cluster {
namespace {

film::Film rendered(PieceRenderer& renderer, const Piece& piece) {
  renderer.begin(piece);
  std::optional<PieceResult> result;
  while (!(result = renderer.take_result())) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return std::move(result->samples.film);
}

// Samples that were lost are rendered again in pieces of other sizes. The earlier film must not be continued.
TEST(PieceRenderer, APieceHasTheSamplesOfItsRangeOnly) {
  auto document = *render::new_document("cornell");
  document.width = document.height = 8;
  PieceRenderer used(document, 1);
  rendered(used, {.id = 1, .samples = {2, 8}});
  for (const uint32_t end : {4u, 6u, 6u}) {
    const Piece piece{.id = end, .samples = {2, end}};
    const film::Film film = rendered(used, piece);
    PieceRenderer other(document, 1);
    const film::Film expected = rendered(other, piece);
    for (int y = 0; y < film.height(); ++y)
      for (int x = 0; x < film.width(); ++x)
        for (uint32_t half = 0; half < film::kHalfBuffers; ++half) {
          ASSERT_EQ(film.half_buffer_samples(x, y, half), (end - 2) / 2) << end;
          ASSERT_EQ(film.sum(x, y, half), expected.sum(x, y, half)) << end;
        }
  }
}

}  // namespace
}  // namespace etendue::cluster
