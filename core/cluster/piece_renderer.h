// Renders pieces of one document, one after the other, in the background.
#pragma once
#include <optional>

#include "cluster/piece_result.h"
#include "render/session.h"

namespace etendue::cluster {

class PieceRenderer {
 public:
  // Threads as in render::SessionOptions.
  PieceRenderer(render::Document document, int threads);

  // Replaces the document. A piece that is being rendered is abandoned.
  void set_document(render::Document document);
  void pause(bool paused) { session_.pause(paused); }

  // Begins a piece. One that is being rendered is abandoned.
  void begin(const Piece& piece);
  void cancel();
  bool is_busy() const { return piece_.has_value(); }
  // The result once it is complete.
  std::optional<PieceResult> take_result();
  // Of the session. Its numbers of samples are those of the present piece.
  render::Status status() const { return session_.status(); }

 private:
  render::Document document_;
  render::Session session_;
  std::optional<Piece> piece_;
  uint64_t version_ = 0;  // of the piece in the session
};

}  // namespace etendue::cluster
