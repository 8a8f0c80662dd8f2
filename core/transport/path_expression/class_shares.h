// The share of a path that belongs to the selected path classes.
//
// A surface can scatter by several letters at once: f = f_D + f_G for a diffuse base below a glossy layer. A path
// sampled with f therefore stands for several words; its throughput
//
//   T = prod f_v cos_v / p_v       is the sum over words w = X_1 X_2 ... of       T_w = prod f_v,Xv cos_v / p_v
//
// Since p is the density of the whole mixture, positive wherever a component of f is, each T_w is an unbiased estimator
// for its word, and their sum is exactly the T of a rendering without classes. (To assign the letter of the sampled
// lobe and to divide by its density alone is unbiased too, but loses the variance reduction of the mixture density.)
// Words that lead to the same state have the same continuations, so it suffices to store one number per live state, the
// share of T of its words:
//
//   share'(q') = sum over q, X with next(q, X) = q' of share(q) f_X / f
//
// Specular lobes are sampled separately: a sampled delta is S with the whole weight. A path that ends at a light, or is
// connected to one by a letter X, counts with the shares of the states from which L, or X L, is accepted. MIS weights
// depend on directions, sum to one for each, and so apply to every word alike. Paths are sampled exactly as without
// classes, including Russian roulette, except that a path without any share ends early. The shares of a partition of
// all paths sum to one, so its images sum to the whole image up to rounding, sample by sample.
//
// Light subpaths read the same words from their other end.
//
// Passing through a surface by stochastic opacity is not an event.
#pragma once
#include <array>
#include <bit>
#include <vector>

#include "bsdf/bsdf.h"
#include "sampling/sampler.h"
#include "transport/model_types.h"
#include "transport/path_expression/automaton.h"

namespace etendue::transport {

template <class M, bool classes = M::kClasses>
class ClassShares;

template <class M>
class ClassShares<M, false> {
 public:
  struct Saved {};
};

template <class M>
class ClassShares<M, true> {
 public:
  using Color = typename M::Color;

  // `automaton` must outlive the paths. Words begin with `first` and end with `last`.
  void begin(const Automaton& automaton, Event first = Event::camera, Event last = Event::light) {
    automaton_ = &automaton;
    states_ = automaton.size();
    first_ = first;
    last_ = last;
    shares_.resize((SampleTable::kPaths + 1) * states_);
    next_shares_.resize(states_);
    find_final_states();
  }
  void launch(int path) {
    const Automaton::State first = automaton_->next(automaton_->start(), first_);
    alive_[static_cast<size_t>(path)] = bit(first);
    row(path)[first] = Color(1);
  }

  // A row for branches, which scatter before they are assigned to a path.
  static constexpr int kBranch = SampleTable::kPaths;
  void copy_to_branch(int path) {
    alive_[kBranch] = alive(path);
    for_each(alive(path), [&](Automaton::State q) { row(kBranch)[q] = row(path)[q]; });
  }
  // The saved states of a queued branch. Its shares are appended to `shares`, from which restore_branch removes them.
  struct Saved {
    uint64_t alive;
  };
  Saved save_branch(std::vector<Color>& shares) const {
    for_each(alive(kBranch), [&](Automaton::State q) { shares.push_back(row(kBranch)[q]); });
    return {alive(kBranch)};
  }
  void restore_branch(const Saved& saved, std::vector<Color>& shares, int path) {
    alive_[static_cast<size_t>(path)] = saved.alive;
    shares.resize(shares.size() - static_cast<size_t>(std::popcount(saved.alive)));
    const Color* share = shares.data() + shares.size();
    for_each(saved.alive, [&](Automaton::State q) { row(path)[q] = *share++; });
  }

  // The share of the throughput if the path ends here, at a light or at the lens.
  Color end_share(int path) const { return sum(path, alive(path) & final_); }

  // The share of f cos for a connection in direction wi, without the shares of the throughput's other states.
  Color connection_value(int path, const Bsdf<M>& bsdf, const Vec3& wo, const Vec3& wi, const Color& f_cos) const {
    if constexpr (M::kScattering)
      if (bsdf.in_volume()) return f_cos * sum(path, alive(path) & final_after_volume_);
    const States diffuse = alive(path) & final_after_diffuse_, glossy = alive(path) & final_after_glossy_;
    if (diffuse == glossy) return diffuse == 0 ? Color(0) : f_cos * sum(path, diffuse);
    const Parts parts = letter_parts(bsdf, wo, wi, Event::diffuse);
    return f_cos * (parts.diffuse * sum(path, diffuse) + parts.glossy * sum(path, glossy));
  }

  // The share of a connection from a point in a volume.
  Color volume_connection_share(int path) const { return sum(path, alive(path) & final_after_volume_); }

  // The share of a connection by one letter, diffuse or glossy.
  Color connection_share(int path, Event letter) const {
    return sum(path, alive(path) & (letter == Event::diffuse ? final_after_diffuse_ : final_after_glossy_));
  }

  // The live states of a path, and its share in each.
  Automaton::States states(int path) const { return alive(path); }
  const Color& share(int path, Automaton::State state) const { return row(path)[state]; }
  const Automaton& automaton() const { return *automaton_; }

  // Copies the state of another path, with shares of the same automaton.
  void copy_from(int path, const ClassShares& other, int other_path) {
    alive_[static_cast<size_t>(path)] = other.alive(other_path);
    for_each(alive(path), [&](Automaton::State q) { row(path)[q] = other.row(other_path)[q]; });
  }

  // Continues the path by one letter alone; returns as `scatter`.
  bool scatter_by(int path, Event letter) {
    const auto part = [letter](Event e) { return Color(e == letter ? 1.0f : 0.0f); };
    move(path, {part(Event::diffuse), part(Event::glossy), part(Event::specular)});
    return alive(path) != 0;
  }

  // The shares of a path, and the shares after the scattering event of a connection.
  using Row = std::vector<Color>;
  void copy(int path, Row& out) const {
    out.assign(states_, Color(0));
    for_each(alive(path), [&](Automaton::State q) { out[q] = row(path)[q]; });
  }
  void after_connection(const Row& shares, const Bsdf<M>& bsdf, const Vec3& wo, const Vec3& wi, Row& out) const {
    out.assign(states_, Color(0));
    if constexpr (M::kScattering)
      if (bsdf.in_volume()) {
        for (size_t i = 0; i < states_; ++i)
          out[automaton_->next(static_cast<Automaton::State>(i), Event::volume)] += shares[i];
        return;
      }
    const Parts parts = letter_parts(bsdf, wo, wi, Event::diffuse);
    for (size_t i = 0; i < states_; ++i) {
      const auto q = static_cast<Automaton::State>(i);
      out[automaton_->next(q, Event::diffuse)] += shares[q] * parts.diffuse;
      out[automaton_->next(q, Event::glossy)] += shares[q] * parts.glossy;
    }
  }

  // Continues the path by a BSDF sample; false if no continuation belongs to the selected classes.
  bool scatter(int path, const Bsdf<M>& bsdf, const Vec3& wo, const LobeSample<Color>& s) {
    if ((alive(path) & ~constant_states_) == 0) return alive(path) != 0;
    if (s.type == ScatterType::volume)
      move(path, {Color(0), Color(0), Color(0), Color(1)});
    else if (s.delta)
      move(path, {Color(0), Color(0), Color(1)});
    else if ((alive(path) & split_states_) == 0)
      move(path, {Color(1), Color(0), Color(0)});
    else
      move(path, letter_parts(bsdf, wo, s.wi, event_of(s.type)));
    return alive(path) != 0;
  }

  // The shares of the letters in one scattering event; they sum to one.
  struct Parts {
    Color diffuse, glossy, specular;
    Color volume{0};
  };

  // `otherwise` is the letter if both components are zero.
  static Parts letter_parts(const Bsdf<M>& bsdf, const Vec3& wo, const Vec3& wi, Event otherwise) {
    if (!bsdf.has_component(ScatterType::glossy)) return {Color(1), Color(0), Color(0)};
    if (!bsdf.has_component(ScatterType::diffuse)) return {Color(0), Color(1), Color(0)};
    const Color diffuse = bsdf.eval_component(ScatterType::diffuse, wo, wi),
                glossy = bsdf.eval_component(ScatterType::glossy, wo, wi);
    const Color both = diffuse + glossy;
    if (!is_black(both)) return {ratio(diffuse, both), ratio(glossy, both), Color(0)};
    if (otherwise == Event::diffuse) return {Color(1), Color(0), Color(0)};
    return {Color(0), Color(1), Color(0)};
  }

 private:
  using States = Automaton::States;
  static constexpr auto bit = Automaton::bit;

  States alive(int path) const { return alive_[static_cast<size_t>(path)]; }
  Color* row(int path) { return &shares_[static_cast<size_t>(path) * states_]; }
  const Color* row(int path) const { return &shares_[static_cast<size_t>(path) * states_]; }

  template <class F>
  static void for_each(States states, F&& f) {
    for (; states != 0; states &= states - 1) f(static_cast<Automaton::State>(std::countr_zero(states)));
  }

  Color sum(int path, States states) const {
    Color total(0);
    for_each(states, [&](Automaton::State q) { total += row(path)[q]; });
    return total;
  }

  // Moves the shares to the next states.
  void move(int path, const Parts& parts) {
    Color* shares = row(path);
    for (size_t q = 0; q < states_; ++q) next_shares_[q] = Color(0);
    States reached = 0;
    const auto give = [&](Automaton::State q, Event event, const Color& part) {
      const Automaton::State to = automaton_->next(q, event);
      if (to == Automaton::kDead || is_black(part)) return;
      next_shares_[to] += shares[q] * part;
      if (!is_black(next_shares_[to])) reached |= bit(to);
    };
    for_each(alive(path), [&](Automaton::State q) {
      give(q, Event::diffuse, parts.diffuse);
      give(q, Event::glossy, parts.glossy);
      give(q, Event::specular, parts.specular);
      if constexpr (M::kScattering) give(q, Event::volume, parts.volume);
    });
    for_each(reached, [&](Automaton::State q) { shares[q] = next_shares_[q]; });
    alive_[static_cast<size_t>(path)] = reached;
  }

  void find_final_states() {
    const auto lit = [&](Automaton::State q) { return automaton_->accepts(automaton_->next(q, last_)); };
    final_ = final_after_diffuse_ = final_after_glossy_ = final_after_volume_ = split_states_ = constant_states_ = 0;
    for (size_t i = 1; i < states_; ++i) {
      const auto q = static_cast<Automaton::State>(i);
      const auto d = automaton_->next(q, Event::diffuse), g = automaton_->next(q, Event::glossy);
      if (lit(q)) final_ |= bit(q);
      if (lit(d)) final_after_diffuse_ |= bit(q);
      if (lit(g)) final_after_glossy_ |= bit(q);
      if (lit(automaton_->next(q, Event::volume))) final_after_volume_ |= bit(q);
      if (d != g) split_states_ |= bit(q);
      const bool is_constant = d == q && g == q && automaton_->next(q, Event::specular) == q &&
                               (!M::kScattering || automaton_->next(q, Event::volume) == q);
      if (is_constant) constant_states_ |= bit(q);
    }
  }

  const Automaton* automaton_ = nullptr;
  size_t states_ = 0;
  Event first_ = Event::camera, last_ = Event::light;
  States final_ = 0;                                         // the last letter is accepted from here
  States final_after_diffuse_ = 0, final_after_glossy_ = 0;  // after a D, a G
  States final_after_volume_ = 0;                            // after a V
  States split_states_ = 0;                                  // D and G lead to different states
  States constant_states_ = 0;                               // every scattering event leads back, with the whole share
  // By path.
  std::array<States, SampleTable::kPaths + 1> alive_{};  // states with a share; other shares are undefined
  std::vector<Color> shares_;                            // by path and state
  std::vector<Color> next_shares_;
};

}  // namespace etendue::transport
