#include "advisor/class_table.h"

#include <algorithm>
#include <chrono>
#include <optional>

#include "advisor/declared_paths.h"
#include "advisor/light_kinds.h"
#include "advisor/reference_method.h"
#include "transport/path_expression/path_expression.h"

namespace etendue::advisor {
namespace {

using transport::Automaton;
using transport::Event;
using transport::PathClass;
using transport::PathExpression;

using Clock = std::chrono::steady_clock;

// What methods declare, each set once; of point lights only if there are any, and if it is less than the trusted method
// finds: what that one does not find is in no table.
std::vector<Automaton> declared_sets(bool point_lights) {
  std::vector<Automaton> sets;
  const auto add = [&](const Automaton& set) {
    if (std::ranges::find(sets, set) == sets.end()) sets.push_back(set);
  };
  const Automaton visible = declared(render::MethodSettings()).point_paths;
  for (const auto& info : integrator::integrator_infos()) {
    const Found found = declared(info);
    add(found.paths);
    if (point_lights && !without(visible, found.point_paths).empty()) add(found.point_paths);
  }
  return sets;
}

render::Document small_picture(const render::Document& document, const TableOptions& options) {
  render::Document d = smaller(trusted(document), options.divisor, options.least);
  d.limits.samples = std::max(film::kHalfBuffers, options.samples);
  return d;
}

// Nothing if it was cut short.
std::optional<ClassEnergy> measured(render::Session& session, const render::Document& document,
                                    const std::function<bool()>& go_on) {
  if (!bench::wait_for(session, session.submit(document), [&](const render::Status&) { return go_on(); })) return {};
  return energy_of(session.film_copy());
}

// A class that may be taken apart.
struct Leaf {
  PathClass coarse;
  Automaton paths;  // those of the coarse class that belong to it
  std::string text;
  ClassEnergy energy = {};
  std::vector<Leaf> parts = {};
  bool parts_by_method = false;  // one that a method finds, and one that it does not
};

class Maker {
 public:
  Maker(render::Session& session, const render::Document& document, const Automaton& only, const TableOptions& options,
        const bench::Progress& watch, const TablePublisher& publish)
      : session_(session),
        options_(options),
        watch_(watch),
        publish_(publish),
        small_(small_picture(document, options)),
        only_(common(asked(document), only)),
        apart_(declared_sets(has_point_lights(*small_.scene))) {
    apart_.insert(apart_.end(), options.apart.begin(), options.apart.end());
    table_.paths = only_ == PathExpression::all().automaton() ? "" : expression_of(only_);
    table_.width = small_.width, table_.height = small_.height, table_.samples = small_.limits.samples;
    table_.point_lights = has_point_lights(*small_.scene);
  }

  ClassTable make() {
    const auto total = rendered(small_, table_.paths);
    if (!total) return table_;
    table_.total.paths = table_.paths, table_.total.energy = *total;
    if (!begin()) return table_;
    while (Leaf* leaf = next())
      if (!take_apart(*leaf)) return table_;
    if (!find_points()) return table_;
    table_.finished = true;
    publish();
    return table_;
  }

 private:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  bool out_of_time() const { return options_.seconds > 0 && seconds() > options_.seconds; }

  // Nothing if it was cut short.
  std::optional<ClassEnergy> rendered(const render::Document& document, const std::string& paths) {
    render::Document d = document;
    d.method.paths = paths;
    return measured(session_, d, [&] { return watch_(progress(), "path classes"); });
  }

  double progress() const {
    const double by_rows = static_cast<double>(leaves_.size()) / static_cast<double>(options_.most_rows);
    return std::min(1.0, options_.seconds > 0 ? std::max(by_rows, seconds() / options_.seconds) : by_rows);
  }

  // The paths of `within` in a coarse class as a leaf; nothing if there are none, or if they cannot be written down.
  std::optional<Leaf> leaf(const PathClass& coarse, const Automaton& within) const {
    const Automaton whole = PathExpression::parse_paths(coarse.name())->automaton();
    Leaf leaf{coarse, common(whole, within), {}};
    if (leaf.paths.empty()) return {};
    leaf.text = leaf.paths == whole ? coarse.name() : expression_of(leaf.paths);
    if (!PathExpression::parse_paths(leaf.text)) return {};
    return leaf;
  }

  // Fills in what the leaf falls into.
  void find_parts(Leaf& whole) const {
    for (const Automaton& set : apart_) {
      const auto inside = leaf(whole.coarse, common(whole.paths, set)),
                 outside = leaf(whole.coarse, without(whole.paths, set));
      if (!inside || !outside) continue;
      whole.parts = {*inside, *outside};
      whole.parts_by_method = true;
      return;
    }
    for (const PathClass& part : whole.coarse.parts())
      if (const auto found = leaf(part, whole.paths)) whole.parts.push_back(*found);
  }

  // Without any detail: light in view, and the rest by its first letter.
  bool begin() {
    const PathClass in_view = PathClass::of({}, options_.naming, 0);
    const Event any[] = {Event::diffuse};
    std::vector<PathClass> coarse = PathClass::of(any, options_.naming, 0).parts();
    coarse.insert(coarse.begin(), in_view);
    std::vector<Leaf> first;
    for (const PathClass& c : coarse)
      if (const auto found = leaf(c, only_)) first.push_back(*found);
    return measure(first);
  }

  // Renders leaves and lets them into the table, all or none.
  bool measure(std::vector<Leaf> leaves) {
    for (Leaf& leaf : leaves) {
      const auto energy = rendered(small_, leaf.text);
      if (!energy) return false;
      leaf.energy = *energy;
      if (energy->found()) find_parts(leaf);
    }
    for (Leaf& leaf : leaves) leaves_.push_back(std::move(leaf));
    publish();
    return true;
  }

  bool take_apart(Leaf& whole) {
    std::vector<Leaf> parts = std::move(whole.parts);
    std::erase_if(leaves_, [&](const Leaf& leaf) { return &leaf == &whole; });
    return measure(std::move(parts));
  }

  // The leaf that it is worth most to take apart; null if there is none.
  Leaf* next() {
    const auto found = std::ranges::count_if(leaves_, [](const Leaf& leaf) { return leaf.energy.found(); });
    if (out_of_time() || static_cast<size_t>(found) >= options_.most_rows) return nullptr;
    Leaf* best = nullptr;
    for (Leaf& leaf : leaves_) {
      if (leaf.parts.empty()) continue;
      if (!leaf.parts_by_method && leaf.energy.mean < options_.least_share * table_.total.energy.mean) continue;
      const bool sooner = !best || leaf.parts_by_method > best->parts_by_method ||
                          (leaf.parts_by_method == best->parts_by_method && leaf.energy.mean > best->energy.mean);
      if (sooner) best = &leaf;
    }
    return best;
  }

  // What of each row comes from lights without extent.
  bool find_points() {
    if (!table_.point_lights) return true;
    if (!has_extended_lights(*small_.scene)) {
      for (ClassRow& row : table_.rows) row.from_points = row.energy;
      table_.total.from_points = table_.total.energy;
      return true;
    }
    render::Document lit = small_;
    lit.scene = std::make_shared<const scene::Scene>(lit_by_points(*small_.scene));
    std::vector<ClassRow*> rows{&table_.total};
    for (ClassRow& row : table_.rows) rows.push_back(&row);
    for (ClassRow* row : rows) {
      const auto energy = rendered(lit, row->paths);
      if (!energy) return false;
      row->from_points = *energy;
    }
    return true;
  }

  void publish() {
    if (!table_.finished) fill_rows();
    table_.seconds = seconds();
    if (publish_) publish_(table_);
  }

  void fill_rows() {
    table_.rows.clear(), table_.unseen.clear();
    const double total = table_.total.energy.mean;
    for (const Leaf& leaf : leaves_)
      if (leaf.energy.found())
        table_.rows.push_back({leaf.text, leaf.energy, {}, total > 0 ? leaf.energy.mean / total : 0});
      else
        table_.unseen.push_back(leaf.text);
    std::ranges::stable_sort(table_.rows, std::ranges::greater(), [](const ClassRow& row) { return row.energy.mean; });
    table_.total.share = total > 0 ? 1 : 0;
  }

  render::Session& session_;
  const TableOptions& options_;
  const bench::Progress& watch_;
  const TablePublisher& publish_;
  render::Document small_;
  Automaton only_;
  std::vector<Automaton> apart_;  // sets that rows should lie within or without
  Clock::time_point start_ = Clock::now();
  std::vector<Leaf> leaves_;  // they part what counts
  ClassTable table_;
};

}  // namespace

std::optional<ClassEnergy> total_energy(render::Session& session, const render::Document& document,
                                        const TableOptions& options, const bench::Progress& watch) {
  return measured(session, small_picture(document, options), [&] { return watch(0, "all paths"); });
}

ClassTable class_table(render::Session& session, const render::Document& document, const TableOptions& options,
                       const bench::Progress& watch, const TablePublisher& publish) {
  return class_table(session, document, PathExpression::all().automaton(), options, watch, publish);
}

ClassTable class_table(render::Session& session, const render::Document& document, const Automaton& only,
                       const TableOptions& options, const bench::Progress& watch, const TablePublisher& publish) {
  return Maker(session, document, only, options, watch, publish).make();
}

}  // namespace etendue::advisor
