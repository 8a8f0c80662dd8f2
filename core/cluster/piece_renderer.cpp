#include "cluster/piece_renderer.h"

#include <utility>

namespace etendue::cluster {

PieceRenderer::PieceRenderer(render::Document document, int threads)
    : document_(std::move(document)), session_({.threads = threads}) {}

void PieceRenderer::set_document(render::Document document) {
  cancel();
  document_ = std::move(document);
}

void PieceRenderer::begin(const Piece& piece) {
  render::Document part = document_;
  part.part = {.first_sample = piece.samples.first, .region = std::nullopt};
  part.limits = {piece.samples.size(), 0, 0, document_.limits.measure};
  // An empty film: otherwise the session would continue one with the same first sample, which may have more samples.
  version_ = session_.submit(part, render::ResumePoint(film::Film(part.width, part.height)));
  piece_ = piece;
}

void PieceRenderer::cancel() {
  session_.stop();
  piece_.reset();
}

std::optional<PieceResult> PieceRenderer::take_result() {
  if (!piece_) return std::nullopt;
  const render::Status status = session_.status();
  if (status.version != version_ || !status.finished) return std::nullopt;
  PieceResult result{.piece = *piece_,
                     .samples = {session_.film_copy(), session_.tail_states()},
                     .rays = status.rays,
                     .paths = status.paths};
  piece_.reset();
  return result;
}

}  // namespace etendue::cluster
