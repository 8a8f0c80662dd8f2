// One Markov chain over light paths, and what it leaves in the picture.         thesis 9.4.2, 9.4.4, Remark 9.19
#pragma once
#include "film/splats.h"
#include "integrator/markov_chain/chain_state.h"
#include "integrator/markov_chain/metropolis.h"
#include "integrator/mlt/mutations.h"

namespace etendue::integrator {

// What belongs to a chain between two steps.
template <class M>
struct MutationChain {
  LightPath<M> path;
  PathShape shape;
  ChainRandom random;
  uint32_t rounds = 0;  // lens subpath mutations so far
  bool bare = false;    // of the path, only what is written below is known

  void write(StateWriter& out) const {
    out.value(path.light), out.value(path.raster), out.value(path.lens), out.value(path.time), out.value(random),
        out.value(rounds);
    out.value<int32_t>(path.edges());
    for (int i = 0; i < path.edges(); ++i) {
      const PathVertex<M>& x = path[i];
      out.value(x.hit), out.value(x.found_from), out.value(x.delta), out.value(x.transmitted);
      out.value(x.point.position), out.value(x.direction), out.value(x.length);
      if constexpr (M::kMedia) out.value(x.media);
    }
  }
  bool read(StateReader& in) {
    int32_t edges = 0;
    if (!in.value(path.light) || !in.value(path.raster) || !in.value(path.lens) || !in.value(path.time) ||
        !in.value(random) || !in.value(rounds) || !in.value(edges) || edges < 1 || edges > kLongest)
      return false;
    path.resize(edges);
    for (int i = 0; i < edges; ++i) {
      PathVertex<M>& x = path[i];
      if (!in.value(x.hit) || !in.value(x.found_from) || !in.value(x.delta) || !in.value(x.transmitted) ||
          !in.value(x.point.position) || !in.value(x.direction) || !in.value(x.length))
        return false;
      if constexpr (M::kMedia)
        if (!in.value(x.media)) return false;
    }
    return bare = true;
  }

 private:
  static constexpr int32_t kLongest = 1 << 16;
};

// Points of the unit square for one mutation of each chain, which lie evenly in it if seen together: Hammersley's set,
// shifted by chance for each round (Cranley & Patterson 1976), so that every chain's own point is independent of what
// it did before.
inline Vec2 stratified_point(uint32_t chain, uint32_t chains, uint32_t round, uint64_t seed) {
  const uint64_t shift = mix_bits(seed ^ mix_bits(uint64_t{round} + 1));
  const auto wrapped = [](float x) { return std::min(x < 1 ? x : x - 1, kOneMinusEpsilon); };
  return {wrapped(static_cast<float>(chain) / static_cast<float>(chains) +
                  to_unit_float(static_cast<uint32_t>(shift >> 32))),
          wrapped(to_unit_float(reverse_bits(chain)) + to_unit_float(static_cast<uint32_t>(shift)))};
}

// Lets chains go, one after the other.
template <class M>
class MutationRunner {
 public:
  using Counts = std::array<Acceptance, kMutations>;

  MutationRunner(const RenderContext& context, const MutationPlan& plan)
      : plan_(&plan), space_(context), filter_(*context.filter, context.width, context.height) {}

  PathSpace<M>& space() { return space_; }

  // The next step. A path counts `scale` times its colour; point() is what a lens subpath mutation takes.
  template <PicturePoints Point, class Count>
  void step(MutationChain<M>& chain, float scale, Point&& point, Count&& count, film::Splats& splats) {
    const Mutation mutation = plan_->mutations.choose(chain.shape, chain.random);
    PathShape shape;
    const double ratio =
        propose(mutation, *plan_, space_, chain.path, chain.shape, chain.random, point, proposal_, shape);
    const Verdict verdict = judge(1, 1, double{chain.random.next()}, ratio);
    count(mutation, verdict);
    stay_.take(
        verdict, [&](double n) { splat(chain.path, n * double{scale}, chain.random, splats); },
        [&](double n) { splat(proposal_, n * double{scale}, chain.random, splats); });
    if (!verdict.accepted) return;
    std::swap(chain.path, proposal_);
    chain.shape = shape;
  }

  // What the chain has gathered where it is now; before another one's step.
  void settle(MutationChain<M>& chain, float scale, film::Splats& splats) {
    splat(chain.path, stay_.settle() * double{scale}, chain.random, splats);
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
  Stay stay_;
};

}  // namespace etendue::integrator
