// A Markov chain over light paths, and its contributions to the image.           [Lang, sec. 9.4.2, 9.4.4, Remark 9.19]
#pragma once
#include "film/splats.h"
#include "base/state_bytes.h"
#include "integrator/markov_chain/metropolis.h"
#include "integrator/mlt/mutations.h"

namespace etendue::integrator {

// The state of a chain between two steps.
template <class M>
struct MutationChain {
  LightPath<M> path;
  PathShape shape;
  ChainRandom random;
  uint32_t subpath_mutations = 0;  // number of lens subpath mutations so far
  bool needs_rebuild = false;      // the path has been read from a checkpoint: only the data written below is valid

  void write(StateWriter& out) const {
    out.value(path.light);
    out.value(path.raster);
    out.value(path.lens);
    out.value(path.time);
    out.value(random);
    out.value(subpath_mutations);
    out.value<int32_t>(path.edges());
    for (int i = 0; i < path.edges(); ++i) {
      const PathVertex<M>& x = path[i];
      out.value(x.hit);
      out.value(x.traced_from);
      out.value(x.delta);
      out.value(x.transmitted);
      out.value(x.point.position);
      out.value(x.direction);
      out.value(x.length);
      if constexpr (M::kMedia) out.value(x.media);
    }
  }
  bool read(StateReader& in) {
    int32_t edges = 0;
    if (!in.value(path.light) || !in.value(path.raster) || !in.value(path.lens) || !in.value(path.time) ||
        !in.value(random) || !in.value(subpath_mutations) || !in.value(edges) || edges < 1 || edges > kMaxLength)
      return false;
    path.resize(edges);
    for (int i = 0; i < edges; ++i) {
      PathVertex<M>& x = path[i];
      if (!in.value(x.hit) || !in.value(x.traced_from) || !in.value(x.delta) || !in.value(x.transmitted) ||
          !in.value(x.point.position) || !in.value(x.direction) || !in.value(x.length))
        return false;
      if constexpr (M::kMedia)
        if (!in.value(x.media)) return false;
    }
    return needs_rebuild = true;
  }

 private:
  static constexpr int32_t kMaxLength = 1 << 16;
};

// Points of the unit square for one mutation of each chain: Hammersley's set, shifted at random in each round [Cranley
// and Patterson 1976]. The points of all chains are stratified; those of one chain are independent of each other.
inline Vec2 stratified_point(uint32_t chain, uint32_t chains, uint32_t round, uint64_t seed) {
  const uint64_t shift = mix_bits(seed ^ mix_bits(uint64_t{round} + 1));
  const auto wrapped = [](float x) { return std::min(x < 1 ? x : x - 1, kOneMinusEpsilon); };
  return {wrapped(static_cast<float>(chain) / static_cast<float>(chains) +
                  to_unit_float(static_cast<uint32_t>(shift >> 32))),
          wrapped(to_unit_float(reverse_bits(chain)) + to_unit_float(static_cast<uint32_t>(shift)))};
}

// Advances chains, one after the other.
template <class M>
class MutationRunner {
 public:
  MutationRunner(const RenderContext& context, const MutationPlan& plan)
      : plan_(&plan), space_(context), filter_(*context.filter, context.width, context.height) {}

  PathSpace<M>& space() { return space_; }

  // Performs one mutation. A path contributes `scale` times its colour; point() is the image point of a lens subpath
  // mutation, in the unit square.
  template <ImagePointSource Point, class Count>
  void step(MutationChain<M>& chain, float scale, Point&& point, Count&& count, film::Splats& splats) {
    const Mutation mutation = plan_->mutations.choose(chain.shape, chain.random);
    PathShape shape;
    const double ratio =
        propose(mutation, *plan_, space_, chain.path, chain.shape, chain.random, point, proposal_, shape);
    const AcceptanceDecision decision = decide_acceptance(1, 1, double{chain.random.next()}, ratio);
    count(mutation, decision);
    occupancy_.record(
        decision, [&](double n) { splat(chain.path, n * double{scale}, chain.random, splats); },
        [&](double n) { splat(proposal_, n * double{scale}, chain.random, splats); });
    if (!decision.accepted) return;
    std::swap(chain.path, proposal_);
    chain.shape = shape;
  }

  // Adds the remaining contribution of the current path; to be called before another chain's step.
  void finish(MutationChain<M>& chain, float scale, film::Splats& splats) {
    splat(chain.path, occupancy_.take_remaining() * double{scale}, chain.random, splats);
  }

 private:
  void splat(const LightPath<M>& path, double weight, ChainRandom& random, film::Splats& splats) const {
    const auto to = weight > 0 ? filter_.choose(path.raster, random.next_2d()) : std::nullopt;
    if (to) splats.push_back({to->pixel, path.color * (static_cast<float>(weight) * to->weight)});
  }

  const MutationPlan* plan_;
  PathSpace<M> space_;
  film::SplatFilter filter_;
  LightPath<M> proposal_;
  Occupancy occupancy_;
};

}  // namespace etendue::integrator
