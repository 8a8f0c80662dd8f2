#include "advisor/class_table.h"

#include <algorithm>
#include <chrono>
#include <optional>

#include "advisor/declared_paths.h"
#include "advisor/reference_integrator.h"
#include "scene/compiled_scene.h"
#include "scene/light_kinds.h"
#include "transport/path_expression/path_expression.h"

namespace etendue::advisor {
namespace {

using transport::Automaton;
using transport::Event;
using transport::PathClass;
using transport::PathExpression;

using Clock = std::chrono::steady_clock;

// The distinct sets of paths that integrators declare. Sets of paths from point lights are included if the scene has
// such lights and the set lacks some of the paths that the reference method finds; no others appear in a table.
std::vector<Automaton> declared_sets(bool point_lights, const render::MethodSettings& reference) {
  std::vector<Automaton> sets;
  const auto add = [&](const Automaton& set) {
    if (std::ranges::find(sets, set) == sets.end()) sets.push_back(set);
  };
  const Automaton measurable = declared_paths(reference).point_paths;
  for (const auto& info : integrator::integrator_infos()) {
    const DeclaredPaths declared = declared_paths(info);
    add(declared.paths);
    if (point_lights && !without(measurable, declared.point_paths).empty()) add(declared.point_paths);
  }
  return sets;
}

render::Document small_image(render::Session& session, const render::Document& document, const TableOptions& options) {
  const auto scene = scene::compile(document.scene, document.camera, session.scene());
  render::Document d = reduced_by(with_reference_integrator(document, *scene), options.divisor, options.min_side);
  d.limits.samples = std::max(film::kHalfBuffers, options.samples);
  return d;
}

// Nothing if interrupted.
std::optional<ClassEnergy> measure_energy(render::Session& session, const render::Document& document,
                                          const std::function<bool()>& keep_going) {
  if (!bench::wait_for(session, session.submit(document), [&](const render::Status&) { return keep_going(); }))
    return {};
  return class_energy(session.film_copy());
}

// A class of the current partition.
struct Leaf {
  PathClass coarse;  // a named class that contains it
  Automaton paths;   // the intersection of `coarse` with the sets along which it was split
  std::string text;
  ClassEnergy energy = {};
  std::vector<Leaf> parts = {};    // the classes it splits into; empty if it cannot be split
  bool split_by_declared = false;  // the parts lie inside and outside of a declared set
};

class TableBuilder {
 public:
  TableBuilder(render::Session& session, const render::Document& document, const Automaton& only,
               const TableOptions& options, const bench::Progress& progress, const TablePublisher& publish)
      : session_(session),
        options_(options),
        progress_(progress),
        publish_(publish),
        small_(small_image(session, document, options)),
        volumes_(scene::has_scattering_media(*document.scene)),
        only_(common(requested_paths(document), only)),
        split_sets_(declared_sets(has_point_lights(*small_.scene), small_.method)) {
    split_sets_.insert(split_sets_.end(), options.split_sets.begin(), options.split_sets.end());
    table_.paths = only_ == space() ? "" : expression_of(only_, volumes_);
    table_.volumes = volumes_;
    table_.reference = small_.method;
    table_.reference.paths.clear();
    table_.width = small_.width;
    table_.height = small_.height;
    table_.samples = small_.limits.samples;
    table_.point_lights = has_point_lights(*small_.scene);
  }

  ClassTable build() {
    const auto total = measure_paths(small_, table_.paths);
    if (!total) return table_;
    table_.total.paths = table_.paths;
    table_.total.energy = *total;
    if (!measure_coarsest()) return table_;
    while (Leaf* leaf = next_to_split())
      if (!split(*leaf)) return table_;
    if (!measure_point_lights()) return table_;
    table_.finished = true;
    publish();
    return table_;
  }

 private:
  // All paths of the scene.
  const Automaton& space() const { return PathExpression::all_of(volumes_).automaton(); }

  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  bool out_of_time() const { return options_.seconds > 0 && seconds() > options_.seconds; }

  // Nothing if interrupted.
  std::optional<ClassEnergy> measure_paths(const render::Document& document, const std::string& paths) {
    render::Document d = document;
    d.method.paths = paths;
    return measure_energy(session_, d, [&] { return progress_(done(), "path classes"); });
  }

  double done() const {
    const double by_rows = static_cast<double>(leaves_.size()) / static_cast<double>(options_.max_rows);
    return std::min(1.0, options_.seconds > 0 ? std::max(by_rows, seconds() / options_.seconds) : by_rows);
  }

  // The paths of `within` in a coarse class as a leaf; nothing if there are none or they have no path expression.
  std::optional<Leaf> leaf(const PathClass& coarse, const Automaton& within) const {
    const Automaton all = common(PathExpression::parse_paths(coarse.name())->automaton(), space());
    Leaf leaf{coarse, common(all, within), {}};
    if (leaf.paths.empty()) return {};
    leaf.text = leaf.paths == all ? coarse.name() : expression_of(leaf.paths, volumes_);
    if (!PathExpression::parse_paths(leaf.text)) return {};
    return leaf;
  }

  // Determines the parts of a leaf: inside and outside of the first set that cuts it, or its subclasses.
  void find_parts(Leaf& parent) const {
    for (const Automaton& set : split_sets_) {
      const auto inside = leaf(parent.coarse, common(parent.paths, set));
      const auto outside = leaf(parent.coarse, without(parent.paths, set));
      if (!inside || !outside) continue;
      parent.parts = {*inside, *outside};
      parent.split_by_declared = true;
      return;
    }
    for (const PathClass& subclass : parent.coarse.parts())
      if (const auto part = leaf(subclass, parent.paths)) parent.parts.push_back(*part);
  }

  // The coarsest partition: directly visible light, and the other paths by their first scattering event.
  bool measure_coarsest() {
    const PathClass directly_visible = PathClass::of({}, options_.naming, 0, volumes_);
    const Event any[] = {Event::diffuse};
    std::vector<PathClass> classes = PathClass::of(any, options_.naming, 0, volumes_).parts();
    classes.insert(classes.begin(), directly_visible);
    std::vector<Leaf> leaves;
    for (const PathClass& c : classes)
      if (const auto part = leaf(c, only_)) leaves.push_back(*part);
    return measure(leaves);
  }

  // Measures leaves and adds them to the partition; adds none of them if interrupted.
  bool measure(std::vector<Leaf> leaves) {
    for (Leaf& leaf : leaves) {
      const auto energy = measure_paths(small_, leaf.text);
      if (!energy) return false;
      leaf.energy = *energy;
      if (energy->found()) find_parts(leaf);
    }
    for (Leaf& leaf : leaves) leaves_.push_back(std::move(leaf));
    publish();
    return true;
  }

  bool split(Leaf& parent) {
    std::vector<Leaf> parts = std::move(parent.parts);
    std::erase_if(leaves_, [&](const Leaf& leaf) { return &leaf == &parent; });
    return measure(std::move(parts));
  }

  // The next leaf to split: first those cut by declared sets, then the one with the most energy. Null if there is none.
  Leaf* next_to_split() {
    const auto rows = std::ranges::count_if(leaves_, [](const Leaf& leaf) { return leaf.energy.found(); });
    if (out_of_time() || static_cast<size_t>(rows) >= options_.max_rows) return nullptr;
    Leaf* best = nullptr;
    for (Leaf& leaf : leaves_) {
      if (leaf.parts.empty()) continue;
      if (!leaf.split_by_declared && leaf.energy.mean < options_.min_share * table_.total.energy.mean) continue;
      const bool is_better =
          !best || leaf.split_by_declared > best->split_by_declared ||
          (leaf.split_by_declared == best->split_by_declared && leaf.energy.mean > best->energy.mean);
      if (is_better) best = &leaf;
    }
    return best;
  }

  // Measures the part of each row that comes from lights without extent.
  bool measure_point_lights() {
    if (!table_.point_lights) return true;
    if (!has_extended_lights(*small_.scene)) {
      for (ClassRow& row : table_.rows) row.from_points = row.energy;
      table_.total.from_points = table_.total.energy;
      return true;
    }
    render::Document lit = small_;
    lit.scene = std::make_shared<const scene::Scene>(with_point_lights_only(*small_.scene));
    std::vector<ClassRow*> rows{&table_.total};
    for (ClassRow& row : table_.rows) rows.push_back(&row);
    for (ClassRow* row : rows) {
      const auto energy = measure_paths(lit, row->paths);
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
    table_.rows.clear();
    table_.unseen.clear();
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
  const bench::Progress& progress_;
  const TablePublisher& publish_;
  render::Document small_;
  bool volumes_;  // the scene has scattering media
  Automaton only_;
  std::vector<Automaton> split_sets_;
  Clock::time_point start_ = Clock::now();
  std::vector<Leaf> leaves_;  // a partition of only_
  ClassTable table_;
};

}  // namespace

std::vector<double> ClassTable::shares() const {
  std::vector<double> list;
  for (const ClassRow& row : rows) list.push_back(row.share);
  return list;
}

std::optional<ClassEnergy> total_energy(render::Session& session, const render::Document& document,
                                        const TableOptions& options, const bench::Progress& progress) {
  return measure_energy(session, small_image(session, document, options), [&] { return progress(0, "all paths"); });
}

ClassTable class_table(render::Session& session, const render::Document& document, const TableOptions& options,
                       const bench::Progress& progress, const TablePublisher& publish) {
  return class_table(session, document, PathExpression::all().automaton(), options, progress, publish);
}

ClassTable class_table(render::Session& session, const render::Document& document, const Automaton& only,
                       const TableOptions& options, const bench::Progress& progress, const TablePublisher& publish) {
  return TableBuilder(session, document, only, options, progress, publish).build();
}

}  // namespace etendue::advisor
