// Stored vertices of light subpaths, for connections.
#pragma once
#include <memory>
#include <vector>

#include "integrator/guiding/guided_density.h"
#include "scene/compiled_scene.h"
#include "transport/mis/mis_chain.h"
#include "transport/path_expression/class_shares.h"

namespace etendue::integrator {

struct NoShares {};

template <class M>
struct LightVertex {
  scene::SurfacePoint point;
  Bsdf<M> bsdf;  // at `point`
  Vec3 wo;       // toward the previous vertex
  typename M::Color flux;
  transport::MisVertex mis;
  guiding::GuidedDensity guided;  // of camera subpaths that continue here
  int length;                     // edges from the light
  const LightVertex* previous;    // null for the first
  // Shares of the path classes, in a model with classes.
  using Shares = std::conditional_t<M::kClasses, std::vector<typename M::Color>, NoShares>;
  [[no_unique_address]] Shares shares;
};

// Vertices at stable addresses; their memory is reused.
template <class M>
class VertexPool {
 public:
  void clear() { size_ = 0; }
  LightVertex<M>& add() {
    if (size_ == chunks_.size() * kChunk) chunks_.push_back(std::make_unique<Chunk>());
    LightVertex<M>& vertex = (*chunks_[size_ / kChunk])[size_ % kChunk];
    ++size_;
    return vertex;
  }

 private:
  static constexpr size_t kChunk = 256;
  using Chunk = std::array<LightVertex<M>, kChunk>;
  std::vector<std::unique_ptr<Chunk>> chunks_;
  size_t size_ = 0;
};

}  // namespace etendue::integrator
