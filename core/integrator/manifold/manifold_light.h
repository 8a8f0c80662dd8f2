// Manifold next event estimation: light that reaches the vertices of a wavefront by way of mirrors and glass.
//                                                                        [Hanika et al. 2015; Zeltner et al. 2020]
//
// At a vertex x, a point y of a light is sampled, and a direction towards a random point of a caster starts a chain of
// random type, which Newton's method changes until it reaches y. A solution is the direction of a chain and its type.
// With the derivative of the end of the chain by its direction, its contribution to the radiance of x is
//
//    w f_s |cos| T L_e / p * 1 / P,      p = p_A(y) |det dy/dw| / |cos_y|
//
// T is the product of the coefficients of all specular events and of transmittances. P is the probability that the walk
// finds this solution. The number of further walks until one of them finds it again has the expectation 1 / P, and
// takes the place of it [Booth 2007; Zeltner et al. 2020, sec. 4.3].
//
// BSDF samples find area lights by the same chains, with a density p_b. Both techniques are weighted by multiple
// importance sampling with the densities p and p_b: w is the weight of p. P is left out of the weights, which are a
// function of the chain and have the sum 1; a constant takes its place. Close to a focus, where p vanishes, BSDF samples
// have all the weight. The derivatives of chains that BSDF samples find are followed along the path. Chains of BSDF samples
// that are too long or pass other specular surfaces than casters (specular_casters.h) have the weight 1.
#pragma once
#include "integrator/manifold/manifold_walk.h"
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
  float weight_of_emission(int hit) const {
    if (!enabled_) return 1;
    const FollowedChain& chain = followed(hit);
    if (!(chain.events > 0)) return 1;
    const scene::SurfacePoint& point = paths_.point(hit);
    const Vec3 direction = -paths_.wo(hit);
    const auto end =
        end_derivatives(chain.derivatives, Frame(direction), glm::distance(chain.position, point.position));
    const float pdf =
        kSuccess * chain.share * targets_.pdf(point, direction, std::abs(end.determinant()), paths_.state_at(hit).time);
    return transport::mis_weight(kHeuristic, chain.pdf, pdf);
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
      else if (chain.events != kNone)
        pass(hit, s, chain);
    }
  }

 private:
  static constexpr transport::MisHeuristic kHeuristic = transport::MisHeuristic::power;
  static constexpr int kNone = -1;
  // A typical probability that a walk finds a given solution, for the weights.
  static constexpr float kSuccess = 0.1f;
  // Chains are kept with certainty if their weight times their throughput is larger, else with a probability in
  // proportion to it.
  static constexpr float kCertain = 0.25f;
  // A walk starts at the first vertex of a path that is not specular, and at this share of those after it.
  static constexpr float kShareOfLaterVertices = 0.25f;
  static constexpr float kStraight = 0.5f;  // the share of walks that start straight towards the light
  // Blocks of walks. Chains that fewer than one in about 2 kLastBlock walks finds lose a part of their light.
  static constexpr int kFirstBlock = 32, kLastBlock = 1 << 15;

  // The chain of a path since its last vertex that is not specular.
  struct FollowedChain {
    int events = kNone;  // casters passed; kNone: the path is on no chain
    float share = 1;     // the probability of a walk at its start
    float pdf = 0;       // of its direction and events by BSDF samples, per solid angle
    Vec3 position;       // of its last vertex
    RayDerivatives derivatives;
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

  void start(int hit, const LobeSample<Color>& s, FollowedChain& chain) const {
    chain.events = 0;
    chain.share = chain.share_here;
    chain.pdf = s.pdf_solid_angle;
    chain.position = paths_.point(hit).position;
    chain.derivatives = RayDerivatives::around(Frame(s.wi));
  }
  void pass(int hit, const LobeSample<Color>& s, FollowedChain& chain) const {
    const scene::SurfacePoint& point = paths_.point(hit);
    const Vec3& wo = paths_.wo(hit);
    DeltaDirection<Color> event;
    if (chain.events == max_chain_ || !is_caster(point, wo) ||
        !paths_.bsdf(hit).delta_direction(wo, s.transmitted, TransportMode::radiance, event)) {
      chain.events = kNone;
      return;
    }
    ++chain.events;
    chain.pdf *= event.probability;
    scatter_derivatives(point, -wo, glm::distance(chain.position, point.position), s.transmitted, event.eta,
                        chain.derivatives);
    chain.position = point.position;
  }

  int longest_chain() const {
    return max_depth_ > 0 ? std::min(max_chain_, max_depth_ - paths_.length() - 1) : max_chain_;
  }

  void add_light(int hit) {
    const int path = paths_.path_at(hit);
    const scene::SurfacePoint& x = paths_.point(hit);
    const auto& state = paths_.state(path);
    const uint32_t seed = paths_.opacity_seed(path) + static_cast<uint32_t>(paths_.length());
    ChainRandom random(uint64_t{hash_combine(state.seed, paths_.sample())} << 32 | seed);
    const float share = state.all_specular ? 1 : kShareOfLaterVertices;
    followed(hit).share_here = share;
    if (share < 1 && !(random.next() < share)) return;
    const ChainStart<M> start{
        &x, state.time, seed, {paths_.medium_beyond(hit, -x.ng), paths_.medium_beyond(hit, x.ng)}};
    ChainTracer<M> tracer(paths_.scene(), start);
    const auto target = targets_.sample(random, state.time);
    Chain<M> chain;
    ChainEnd end;
    if (target && find(tracer, hit, *target, random, chain, end)) {
      const auto scattered = scatter_into(hit, chain);
      const Color radiance = radiance_along(tracer, *target, chain, end, scattered.pdf, share, state.time, random);
      if (!is_black(radiance) && !is_black(scattered.f_cos)) {
        const float walks = walks_to_find_again(tracer, hit, *target, chain, end, random);
        add(hit, *target, chain, end, scattered, radiance * walks);
      }
    }
    rays_ += tracer.rays();
  }

  // One walk from a random start.
  bool find(ChainTracer<M>& tracer, int hit, const ChainTarget& target, ChainRandom& random, Chain<M>& chain,
            ChainEnd& end) {
    const scene::SurfacePoint& x = paths_.point(hit);
    const Vec3 direction = random_direction(x.position, target, random);
    if (x.material->is_opaque && (glm::dot(direction, x.ng) > 0) != (glm::dot(paths_.wo(hit), x.ng) > 0)) return false;
    return tracer.trace_any(direction, target.finite_position(), longest_chain(), random, chain) &&
           ManifoldWalk<M>(tracer, target, random).walk(chain, end);
  }
  // Straight to the target, from which chains through flat glass deviate little, or to a random point of a caster.
  Vec3 random_direction(const Vec3& from, const ChainTarget& target, ChainRandom& random) const {
    if (random.next() < kStraight) return target.direction_from(from);
    const float choice = random.next();
    return normalize_or(casters_.sample(choice, random.next_2d()) - from, Vec3(0, 0, 1));
  }

  // Whether two chains are the same solution, up to rounding errors. They are large in direction close to a focus.
  static bool is_same(const Chain<M>& a, const ChainEnd& end, const Chain<M>& b) {
    constexpr float kEqual = 1e-4f, kEqualAtEnd = 1e-5f, kClose = 1e-2f;  // radians
    if (a.type != b.type) return false;
    const Vec3 difference = b.start.z - a.start.z;
    const Vec2 step(glm::dot(difference, a.start.x), glm::dot(difference, a.start.y));
    const float length = glm::length(difference);
    return length < kEqual || (length < kClose && end.angle_of(step) < kEqualAtEnd);
  }

  // The number of walks until one finds the chain again, in expectation. Roulette ends long searches: after each block of
  // walks, whose lengths double, a search goes on with probability 1/2, and its further walks count twice as much.
  float walks_to_find_again(ChainTracer<M>& tracer, int hit, const ChainTarget& target, const Chain<M>& found,
                            const ChainEnd& found_end, ChainRandom& random) {
    Chain<M> chain;
    ChainEnd end;
    float walks = 0, weight = 1;
    for (int block = kFirstBlock; block <= kLastBlock; block *= 2, weight *= 2) {
      for (int i = 0; i < block; ++i) {
        walks += weight;
        if (find(tracer, hit, target, random, chain, end) && is_same(found, found_end, chain)) return walks;
      }
      if (random.next() < 0.5f) break;
    }
    return walks;
  }

  // The radiance from the target along a chain, times its weight over the density of the target. `bsdf_pdf` is that of
  // the chain's direction, and `share` the probability of a walk at its start. Chains that transport little light are
  // black at random, which saves the search for them, and the others count for them.
  Color radiance_along(ChainTracer<M>& tracer, const ChainTarget& target, const Chain<M>& chain, const ChainEnd& end,
                       float bsdf_pdf, float share, float time, ChainRandom& random) const {
    const Vec3 direction = target.is_infinite() ? chain.direction : target.direction_from(chain.last.position);
    const float distance = target.is_infinite() ? kInfinity : glm::distance(target.position(), chain.last.position);
    const float determinant = std::abs(end.derivatives.determinant());
    const auto arriving = targets_.arriving(target, direction, distance, determinant, time);
    if (is_black(arriving.radiance)) return Color(0);
    float weight = 1, weight_over_pdf = 1 / share;
    if (arriving.pdf > 0) {
      const float pdf = kSuccess * share * arriving.pdf;
      weight_over_pdf = kSuccess * transport::mis_weight_over_pdf(kHeuristic, pdf, bsdf_pdf * chain.probability);
      weight = share * arriving.pdf * weight_over_pdf;
    }
    const float survival = std::min(1.0f, weight * max_component(chain.throughput) / kCertain);
    if (!(random.next() < survival)) return Color(0);
    return chain.throughput * arriving.radiance * tracer.transmittance_to_end(chain, direction, distance) *
           (weight_over_pdf / survival);
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
