// One Markov chain, and what it leaves in the picture.                          thesis 9.4.2, Remarks 9.18, 9.19
#pragma once
#include "film/splats.h"
#include "integrator/mutations.h"

namespace etendue::integrator {

// What belongs to a chain between two steps.
template <class M>
struct ChainState {
  LightPath<M> path;
  PathShape shape;
  ChainRandom random;
  uint32_t number = 0, rounds = 0;  // its own among all, and lens subpath mutations so far
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

template <class M>
class ChainRunner {
 public:
  ChainRunner(const Pass& pass, const MutationPlan& plan)
      : plan_(&plan), space_(pass), filter_(*pass.filter, pass.width, pass.height) {}

  PathSpace<M>& space() { return space_; }

  // The next step of the chain, which stands for `scale` times the colour of where it is.
  void step(ChainState<M>& chain, uint32_t chains, uint64_t seed, float scale, MutationCounts& counts,
            film::Splats& splats) {
    const Mutation mutation = plan_->choose(chain.shape, chain.random);
    const auto point = [&] { return stratified_point(chain.number, chains, chain.rounds++, seed); };
    PathShape shape;
    const double accepted =
        propose(mutation, *plan_, space_, chain.path, chain.shape, chain.random, point, proposal_, shape);
    ++counts.proposed[static_cast<size_t>(mutation)];
    staying_ += 1 - accepted;
    if (accepted > 0 && double{chain.random.next()} < accepted) {
      ++counts.accepted[static_cast<size_t>(mutation)];
      leave(chain, scale, splats);
      std::swap(chain.path, proposal_);
      chain.shape = shape;
      staying_ = accepted;
    } else if (accepted > 0) {
      splat(proposal_, accepted * double{scale}, chain.random, splats);
    }
  }

  // What the chain has gathered where it is now; before another one's step.
  void leave(ChainState<M>& chain, float scale, film::Splats& splats) {
    if (staying_ > 0) splat(chain.path, staying_ * double{scale}, chain.random, splats);
    staying_ = 0;
  }

 private:
  void splat(const LightPath<M>& path, double weight, ChainRandom& random, film::Splats& splats) const {
    if (const auto to = filter_.choose(path.raster, random.next_2d()))
      splats.push_back({to->pixel, path.color * (static_cast<float>(weight) * to->weight)});
  }

  const MutationPlan* plan_;
  PathSpace<M> space_;
  film::SplatFilter filter_;
  LightPath<M> proposal_;
  double staying_ = 0;
};

}  // namespace etendue::integrator
