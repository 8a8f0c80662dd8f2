// Which part of a walk belongs to the classes of paths that are asked for.
//
// A surface scatters by several letters at once: f = f_D + f_G where a diffuse base lies under a glossy layer. A walk
// that was carried on by f therefore stands for several words: its throughput
//
//   T = prod f_v cos_v / p_v       is the sum over words w = X_1 X_2 ... of       T_w = prod f_v,Xv cos_v / p_v
//
// and as p is the density of the whole mixture, positive wherever a part of f is, each T_w is an unbiased estimator for
// its word, and all together are the very T of a rendering without classes. (The other way, to give a walk the letter
// of the lobe that was sampled and to weight it by that lobe's density alone, is unbiased too, but gives up what the
// lobes' densities do for each other.) Words that lead the automaton into one state have one future, so what is carried
// is one number for each state that is alive, the share of T that its words have:
//
//   share'(q') = sum over q, X with next(q, X) = q' of share(q) f_X / f
//
// Deltas are chosen apart from everything else: a sampled delta is S with all its weight. A walk ends on a light, or is
// connected to one by a letter X, with the shares of the states from which L, or X L, is accepted. The weights of
// multiple importance sampling belong to directions, add up to one for each, and so serve every word alike. Walks go
// exactly as they would without classes, roulette included; only one without any share left ends early. Shares of a
// partition of all paths add up to one, so its images add up to the whole image up to rounding, sample by sample.
//
// Walks from a light read the same words from their other end.
//
// Passing through a surface by stochastic opacity is no event.
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
  struct Kept {};
};

template <class M>
class ClassShares<M, true> {
 public:
  using Color = typename M::Color;

  // `automaton` must stay where it is while walks go on. Words begin with `first` and end with `last`.
  void begin(const Automaton& automaton, Event first = Event::camera, Event last = Event::light) {
    automaton_ = &automaton, states_ = automaton.size();
    first_ = first, last_ = last;
    shares_.resize((SampleTable::kPaths + 1) * states_);
    moved_.resize(states_);
    find_lit_states();
  }
  void launch(int path) {
    const Automaton::State first = automaton_->next(automaton_->start(), first_);
    alive_[static_cast<size_t>(path)] = bit(first);
    row(path)[first] = Color(1);
  }

  // A row that belongs to no path: for branches, which scatter on their own.
  static constexpr int kBranch = SampleTable::kPaths;
  void copy_to_branch(int path) {
    alive_[kBranch] = alive(path);
    for_each(alive(path), [&](Automaton::State q) { row(kBranch)[q] = row(path)[q]; });
  }
  // What a branch has, for as long as no path stands for it. Its shares are put at the end of `shares`, where
  // `give_back` takes them from again.
  struct Kept {
    uint64_t alive;
  };
  Kept keep_branch(std::vector<Color>& shares) const {
    for_each(alive(kBranch), [&](Automaton::State q) { shares.push_back(row(kBranch)[q]); });
    return {alive(kBranch)};
  }
  void give_back(const Kept& kept, std::vector<Color>& shares, int path) {
    alive_[static_cast<size_t>(path)] = kept.alive;
    shares.resize(shares.size() - static_cast<size_t>(std::popcount(kept.alive)));
    const Color* share = shares.data() + shares.size();
    for_each(kept.alive, [&](Automaton::State q) { row(path)[q] = *share++; });
  }

  // Of the throughput, if the path ends here, on a light or on the lens.
  Color of_end(int path) const { return sum(path, alive(path) & lit_); }

  // Of f cos, if the path is connected to its end in direction wi: the same but for the letters that do not count.
  Color of_connection(int path, const Bsdf<M>& bsdf, const Vec3& wo, const Vec3& wi, const Color& f_cos) const {
    const States diffuse = alive(path) & lit_after_diffuse_, glossy = alive(path) & lit_after_glossy_;
    if (diffuse == glossy) return diffuse == 0 ? Color(0) : f_cos * sum(path, diffuse);
    const Parts parts = parts_of(bsdf, wo, wi, Event::diffuse);
    return f_cos * (parts.diffuse * sum(path, diffuse) + parts.glossy * sum(path, glossy));
  }

  // The same apart for light that is scattered by one letter, diffuse or glossy.
  Color of_connection_by(int path, Event letter) const {
    return sum(path, alive(path) & (letter == Event::diffuse ? lit_after_diffuse_ : lit_after_glossy_));
  }

  // The states that a path is in, and its share in each.
  Automaton::States states(int path) const { return alive(path); }
  const Color& share(int path, Automaton::State state) const { return row(path)[state]; }
  const Automaton& automaton() const { return *automaton_; }

  // The path is where another one is, of shares in the same automaton.
  void take_over(int path, const ClassShares& other, int other_path) {
    alive_[static_cast<size_t>(path)] = other.alive(other_path);
    for_each(alive(path), [&](Automaton::State q) { row(path)[q] = other.row(other_path)[q]; });
  }

  // The path goes on by one letter alone; false as below.
  bool scatter_by(int path, Event letter) {
    const auto part = [letter](Event e) { return Color(e == letter ? 1.0f : 0.0f); };
    move(path, {part(Event::diffuse), part(Event::glossy), part(Event::specular)});
    return alive(path) != 0;
  }

  // The shares of a path as they are, and as they would be after the letters of a connection.
  using Row = std::vector<Color>;
  void copy(int path, Row& out) const {
    out.assign(states_, Color(0));
    for_each(alive(path), [&](Automaton::State q) { out[q] = row(path)[q]; });
  }
  void connected(const Row& shares, const Bsdf<M>& bsdf, const Vec3& wo, const Vec3& wi, Row& out) const {
    const Parts parts = parts_of(bsdf, wo, wi, Event::diffuse);
    out.assign(states_, Color(0));
    for (size_t i = 0; i < states_; ++i) {
      const auto q = static_cast<Automaton::State>(i);
      out[automaton_->next(q, Event::diffuse)] += shares[q] * parts.diffuse;
      out[automaton_->next(q, Event::glossy)] += shares[q] * parts.glossy;
    }
  }

  // The path goes on as sampled; false if nothing that counts can come of it any more.
  bool scatter(int path, const Bsdf<M>& bsdf, const Vec3& wo, const LobeSample<Color>& s) {
    if (s.delta)
      move(path, {Color(0), Color(0), Color(1)});
    else if ((alive(path) & apart_) == 0)
      move(path, {Color(1), Color(0), Color(0)});
    else
      move(path, parts_of(bsdf, wo, s.wi, event_of(s.type)));
    return alive(path) != 0;
  }

  // Shares of the letters in one scattering event; together they are one.
  struct Parts {
    Color diffuse, glossy, specular;
  };

  // `otherwise` is the letter where rounding leaves nothing to compare.
  static Parts parts_of(const Bsdf<M>& bsdf, const Vec3& wo, const Vec3& wi, Event otherwise) {
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

  // Shares go to the states that the letters lead to.
  void move(int path, const Parts& parts) {
    Color* shares = row(path);
    for (size_t q = 0; q < states_; ++q) moved_[q] = Color(0);
    States reached = 0;
    const auto give = [&](Automaton::State q, Event event, const Color& part) {
      const Automaton::State to = automaton_->next(q, event);
      if (to == Automaton::kDead || is_black(part)) return;
      moved_[to] += shares[q] * part;
      if (!is_black(moved_[to])) reached |= bit(to);
    };
    for_each(alive(path), [&](Automaton::State q) {
      give(q, Event::diffuse, parts.diffuse);
      give(q, Event::glossy, parts.glossy);
      give(q, Event::specular, parts.specular);
    });
    for_each(reached, [&](Automaton::State q) { shares[q] = moved_[q]; });
    alive_[static_cast<size_t>(path)] = reached;
  }

  void find_lit_states() {
    const auto lit = [&](Automaton::State q) { return automaton_->accepts(automaton_->next(q, last_)); };
    lit_ = lit_after_diffuse_ = lit_after_glossy_ = apart_ = 0;
    for (size_t i = 1; i < states_; ++i) {
      const auto q = static_cast<Automaton::State>(i);
      const auto d = automaton_->next(q, Event::diffuse), g = automaton_->next(q, Event::glossy);
      if (lit(q)) lit_ |= bit(q);
      if (lit(d)) lit_after_diffuse_ |= bit(q);
      if (lit(g)) lit_after_glossy_ |= bit(q);
      if (d != g) apart_ |= bit(q);
    }
  }

  const Automaton* automaton_ = nullptr;
  size_t states_ = 0;
  Event first_ = Event::camera, last_ = Event::light;
  States lit_ = 0;                                       // the last letter is accepted from here
  States lit_after_diffuse_ = 0, lit_after_glossy_ = 0;  // after a D, a G
  States apart_ = 0;                                     // D and G lead to different states
  // By path.
  std::array<States, SampleTable::kPaths + 1> alive_{};  // states with a share; the other shares are not defined
  std::vector<Color> shares_;                            // of each state
  std::vector<Color> moved_;
};

}  // namespace etendue::transport
