// Manifold next event estimation: light that reaches the vertices of a wavefront by way of mirrors and glass.
//                                                                        [Hanika et al. 2015; Zeltner et al. 2020]
//
// At a vertex x, a point y of a light is sampled, and a direction towards a random point of a caster starts a chain of
// random type, which Newton's method changes until it reaches y. A solution is the direction of a chain and its type.
// With the derivative of the end of the chain by its direction, its contribution to the radiance of x is
//
//    w f_s |cos| T L_e / p * N,      p = p_A(y) |det dy/dw| / |cos_y|
//
// T is the product of the coefficients of all specular events and of transmittances. N is the number of further walks
// until one of them finds the solution again, an estimate of 1 / P without bias, where P is the probability that a walk
// finds it (solution_finder.h).
//
// BSDF samples find area lights by the same chains; w is the weight of walks against them (walk_weights.h). The derivatives
// of chains that BSDF samples find are followed along the path. Chains of BSDF samples that are too long or pass other
// specular surfaces than casters (specular_casters.h) have the weight 1.
#pragma once
#include "integrator/manifold/solution_finder.h"
#include "integrator/manifold/walk_weights.h"
#include "transport/wavefront/path_estimators.h"

namespace etendue::integrator::manifold {

template <class M>
class ManifoldLight {
 public:
  using Color = typename M::Color;

  // `max_chain`: the length of the longest chains. `max_depth`: that of the longest paths; 0: no limit.
  ManifoldLight(transport::PathWavefront<M>& paths, const SpecularCasters& casters, const ChainTargets& targets,
                int max_chain, int max_depth)
      : paths_(paths),
        casters_(casters),
        targets_(targets),
        max_chain_(max_chain),
        max_depth_(max_depth),
        enabled_(!M::kDiffuse && !casters.empty() && !targets.empty()),
        followed_(chains_of_thread()) {
    if (enabled_) followed_.assign(static_cast<size_t>(paths.size()), {});
  }

  uint64_t rays() const { return rays_; }

  // The weight of the emission of a current hit, which a BSDF sample has found, against chains; 1 if none find it.
  float weight_of_emission(int hit) {
    if constexpr (!M::kDiffuse) {
      if (!enabled_) return 1;
      const FollowedChain& chain = followed(hit);
      if (!chain.exists || chain.type.length == 0) return 1;
      const auto target = ChainTarget::at(paths_.point(hit));
      const Vec3 direction = -paths_.wo(hit);
      ChainEnd end;
      end.distance = glm::distance(chain.position, target.position());
      end.derivatives = end_derivatives(chain.derivatives, Frame(direction), end.distance);
      const float pdf = chain.share * targets_.pdf(target.point, direction, std::abs(end.derivatives.determinant()),
                                                   paths_.state_at(hit).time);
      const WalkWeights weights(pdf, chain.pdf);
      if (weights.none()) return 1;
      if (weights.all()) return 0;
      ChainRandom random = random_of(hit);
      ChainTracer<M> tracer(paths_.scene(), chain.start);
      const auto walks = SolutionFinder<M>(casters_, tracer, target, random)
                             .search(weights.longest_search(), {Frame(chain.direction), chain.type, end});
      rays_ += tracer.rays();
      return walks ? 1 - weights.after(*walks) : 1;
    }
    return 1;
  }

  // Adds the light of chains at all current hits.
  void add_light() {
    if constexpr (!M::kDiffuse) {
      if (!enabled_ || longest_chain() < 1) return;
      for (int i = 0; i < paths_.hit_count(); ++i)
        if (is_start(i)) add_light(i);
    }
  }

  // The path continues from a current hit by this sample.
  void scatter(int hit, const LobeSample<Color>& s) {
    if constexpr (!M::kDiffuse) {
      if (!enabled_) return;
      FollowedChain& chain = followed(hit);
      if (!s.delta)
        start(hit, s, chain);
      else if (chain.exists)
        pass(hit, s, chain);
    }
  }

 private:
  // Chains are kept with certainty if their weight times their throughput is larger, else with a probability in
  // proportion to it.
  static constexpr float kCertain = 0.25f;
  // A walk starts at the first vertex of a path that is not specular, and at this share of those after it.
  static constexpr float kShareOfLaterVertices = 0.25f;

  // The chain of a path since its last vertex that is not specular.
  struct FollowedChain {
    bool exists = false;
    ChainType type;
    float share = 1;  // the probability of a walk at its start
    float pdf = 0;    // of its direction and events by BSDF samples, per solid angle
    Vec3 direction;   // at its start
    Vec3 position;    // of its last vertex
    RayDerivatives derivatives;
    ChainStart<M> start;
    float share_here = 1;  // the probability of a walk at the current vertex of the path
  };
  // Kept between blocks of pixels to save allocations.
  static std::vector<FollowedChain>& chains_of_thread() {
    static thread_local std::vector<FollowedChain> chains;
    return chains;
  }
  FollowedChain& followed(int hit) { return followed_[static_cast<size_t>(paths_.path_at(hit))]; }
  const FollowedChain& followed(int hit) const { return followed_[static_cast<size_t>(paths_.path_at(hit))]; }

  bool is_start(int hit) const { return paths_.bsdf(hit).has_non_delta_lobe(); }

  // Random numbers of a vertex.
  ChainRandom random_of(int hit) const {
    return ChainRandom(uint64_t{hash_combine(paths_.state_at(hit).seed, paths_.sample())} << 32 | opacity_seed(hit));
  }
  uint32_t opacity_seed(int hit) const {
    return paths_.opacity_seed(paths_.path_at(hit)) + static_cast<uint32_t>(paths_.length());
  }

  ChainStart<M> start_at(int hit) const {
    const scene::SurfacePoint& x = paths_.point(hit);
    return {x,
            paths_.wo(hit),
            paths_.state_at(hit).time,
            opacity_seed(hit),
            longest_chain(),
            {paths_.medium_beyond(hit, -x.ng), paths_.medium_beyond(hit, x.ng)}};
  }

  void start(int hit, const LobeSample<Color>& s, FollowedChain& chain) const {
    chain.exists = longest_chain() > 0;
    if (!chain.exists) return;
    chain.type = {};
    chain.share = chain.share_here;
    chain.pdf = s.pdf_solid_angle;
    chain.direction = s.wi;
    chain.position = paths_.point(hit).position;
    chain.derivatives = RayDerivatives::around(Frame(s.wi));
    chain.start = start_at(hit);
  }
  void pass(int hit, const LobeSample<Color>& s, FollowedChain& chain) const {
    const scene::SurfacePoint& point = paths_.point(hit);
    const Vec3& wo = paths_.wo(hit);
    DeltaDirection<Color> event;
    if (chain.type.length == chain.start.max_length || !is_caster(point, wo) ||
        !paths_.bsdf(hit).delta_direction(wo, s.transmitted, TransportMode::radiance, event)) {
      chain.exists = false;
      return;
    }
    chain.type.append(s.transmitted);
    chain.pdf *= event.probability;
    scatter_derivatives(point, -wo, glm::distance(chain.position, point.position), s.transmitted, event.eta,
                        chain.derivatives);
    chain.position = point.position;
  }

  int longest_chain() const {
    return max_depth_ > 0 ? std::min(max_chain_, max_depth_ - paths_.length() - 1) : max_chain_;
  }

  void add_light(int hit) {
    ChainRandom random = random_of(hit);
    const float share = paths_.state_at(hit).all_specular ? 1 : kShareOfLaterVertices;
    followed(hit).share_here = share;
    if (share < 1 && !(random.next() < share)) return;
    const ChainStart<M> start = start_at(hit);
    const auto target = targets_.sample(random, start.time);
    if (!target) return;
    ChainTracer<M> tracer(paths_.scene(), start);
    SolutionFinder<M> finder(casters_, tracer, *target, random);
    Chain<M> chain;
    ChainEnd end;
    if (finder.find(chain, end)) {
      const auto scattered = scatter_into(hit, chain);
      if (!is_black(scattered.f_cos)) {
        const Color radiance = radiance_along(tracer, finder, *target, chain, end, scattered.pdf, share, random);
        if (!is_black(radiance)) add(hit, *target, chain, end, scattered, radiance);
      }
    }
    rays_ += tracer.rays();
  }

  // The radiance from the target along a chain, times its weight over the density of the target, and divided by the
  // probability that a walk finds the chain. `bsdf_pdf` is that of the chain's direction, and `share` the probability of a
  // walk at its start. Chains that transport little light are black at random, which saves the search for them, and the
  // others count for them.
  Color radiance_along(ChainTracer<M>& tracer, SolutionFinder<M>& finder, const ChainTarget& target,
                       const Chain<M>& chain, const ChainEnd& end, float bsdf_pdf, float share,
                       ChainRandom& random) const {
    const Vec3 direction = target.is_infinite() ? chain.direction : target.direction_from(chain.last.position);
    const float determinant = std::abs(end.derivatives.determinant());
    const auto arriving = targets_.arriving(target, direction, end.distance, determinant, tracer.start().time);
    if (is_black(arriving.radiance)) return Color(0);
    const bool is_shared = arriving.pdf > 0;  // with BSDF samples
    const WalkWeights weights(share * arriving.pdf, bsdf_pdf * chain.probability);
    if (is_shared && weights.none()) return Color(0);
    const float typical = is_shared ? weights.typical() : 1;
    const float survival = std::min(1.0f, typical * max_component(chain.throughput) / kCertain);
    if (!(random.next() < survival)) return Color(0);
    const Color radiance =
        chain.throughput * arriving.radiance * tracer.transmittance_to_end(chain, direction, end.distance);
    if (is_black(radiance)) return Color(0);
    const float pdf = is_shared ? share * arriving.pdf : share;
    const Solution solution{chain.start, chain.type, end};
    return radiance * (weight_over_probability(finder, is_shared && !weights.all() ? &weights : nullptr, solution) /
                       (pdf * survival));
  }

  // An estimate without bias of a weight, or of 1, over the probability that a walk finds a solution.
  static float weight_over_probability(SolutionFinder<M>& finder, const WalkWeights* weights,
                                       const Solution& solution) {
    if (!weights) return finder.estimate_walks(solution);
    const auto walks = finder.search(weights->longest_search(), solution);
    if (!walks) return 0;
    return weights->over_probability(*walks, finder.estimate_walks(solution), SolutionFinder<M>::kCertainWalks);
  }

  // The scattering at the start of a chain, restricted to the selected path classes.
  typename Bsdf<M>::Value scatter_into(int hit, const Chain<M>& chain) {
    const Vec3 &wo = paths_.wo(hit), &wi = chain.start.z;
    auto scattered = paths_.bsdf(hit).evaluate(wo, wi);
    if constexpr (M::kClasses) {
      auto& shares = paths_.shares();
      const transport::Automaton& classes = shares.automaton();
      shares.copy(paths_.path_at(hit), shares_);
      shares.after_connection(shares_, paths_.bsdf(hit), wo, wi, next_shares_);
      Color share(0);
      for (size_t i = 0; i < next_shares_.size(); ++i) {
        auto q = static_cast<transport::Automaton::State>(i);
        for (int k = 0; k < chain.type.length; ++k) q = classes.next(q, transport::Event::specular);
        if (classes.accepts(classes.next(q, transport::Event::light))) share += next_shares_[i];
      }
      scattered.f_cos *= share;
    }
    return scattered;
  }

  void add(int hit, const ChainTarget& target, const Chain<M>& chain, const ChainEnd& end,
           const typename Bsdf<M>::Value& scattered, const Color& radiance) {
    auto& state = paths_.state_at(hit);
    const Color contribution = state.throughput * scattered.f_cos * radiance;
    state.radiance += contribution;
    if (!paths_.recorder()) [[likely]]
      return;
    LightSample sample;
    sample.kind = target.emission.kind;
    sample.light = target.emission.light;
    sample.wi = chain.start.z;
    sample.distance = end.distance;
    sample.delta = true;
    sample.pdf = 1;
    sample.radiance = radiance;
    transport::record_light(paths_, hit, sample, 1, scattered, contribution, false);
  }

  transport::PathWavefront<M>& paths_;
  const SpecularCasters& casters_;
  const ChainTargets& targets_;
  const int max_chain_, max_depth_;
  const bool enabled_;
  uint64_t rays_ = 0;
  std::vector<FollowedChain>& followed_;     // by path
  std::vector<Color> shares_, next_shares_;  // by automaton state
};

}  // namespace etendue::integrator::manifold
