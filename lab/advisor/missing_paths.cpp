#include "advisor/missing_paths.h"

#include <algorithm>
#include <cctype>

#include "advisor/reference_integrator.h"
#include "advisor/report_numbers.h"
#include "base/number_text.h"
#include "light/placed_light.h"
#include "scene/compiled_scene.h"
#include "scene/light_kinds.h"
#include "transport/path_expression/path_expression.h"

namespace etendue::advisor {
namespace {

using transport::Automaton;
using transport::PathExpression;

// The part of a row that is not declared; nothing if all of it is. `measurable` are the paths that the reference
// integrator finds and that can therefore appear in the table.
std::optional<MissingPathClass> missing_part(const std::string& paths, const ClassEnergy& energy,
                                             const Automaton& measurable, const Automaton& declared, double total,
                                             bool volumes) {
  if (!energy.found()) return {};
  const Automaton row = common(PathExpression::parse_paths(paths)->automaton(), measurable);
  const Automaton rest = without(row, declared);
  if (rest.empty()) return {};
  return MissingPathClass{.paths = rest == row ? paths : expression_of(rest, volumes),
                          .energy = energy,
                          .share = energy.mean / total,
                          .partial = rest != row};
}

// Sorts the classes and computes the totals; `energies` are those of all missing classes.
void summarize(MissingPaths& missing, std::span<const ClassEnergy> energies) {
  std::ranges::stable_sort(missing.classes, std::ranges::greater(), &MissingPathClass::share);
  for (const MissingPathClass& c : missing.classes) {
    missing.share = std::min(1.0, missing.share + c.share);
    missing.uncertain = missing.uncertain || c.energy.uncertain();
  }
  missing.rms = rms_of(energies);
}

// True for surfaces with a perfectly specular lobe.
bool is_smooth(const SurfaceMaterial& m) { return m.has_delta_lobes; }

std::string name_of(const PlacedLight& light) {
  std::string type = light.type->label;
  type.front() = static_cast<char>(std::tolower(type.front()));
  return light.name.empty() ? "a " + type : "the " + type + " '" + light.name + "'";
}

std::string name_of(const SurfaceMaterial& m) {
  const std::string name = m.description.name.empty() ? "" : " '" + m.description.name + "'";
  return (m.description.transmission > 0 ? "glass" : "specular surfaces") + name;
}

}  // namespace

MissingPaths missing_paths(const DeclaredPaths& declared, const ClassTable& table) {
  MissingPaths missing;
  const Automaton& space = PathExpression::all_of(table.volumes).automaton();
  const DeclaredPaths found = declared_paths(table.reference),
                      measurable{common(found.paths, space), common(found.point_paths, space)};
  const double total = table.total.energy.mean;
  std::vector<ClassEnergy> energies;
  const auto add = [&](const MissingPathClass& c) {
    missing.classes.push_back(c);
    energies.push_back(c.energy);
  };
  for (const ClassRow& row : table.rows) {
    if (const auto c = missing_part(row.paths, row.energy, measurable.paths, declared.paths, total, table.volumes)) {
      add(*c);
    } else if (auto p = missing_part(row.paths, row.from_points, measurable.point_paths, declared.point_paths, total,
                                     table.volumes)) {
      p->from_point_lights = true;
      add(*p);
    }
  }
  summarize(missing, energies);
  return missing;
}

MeasuredMissingPaths measure_missing_paths(render::Session& session, const render::Document& document,
                                           const TableOptions& options, const bench::Progress& progress) {
  MeasuredMissingPaths measured;
  const auto scene = scene::compile(document.scene, document.camera, session.scene());
  const DeclaredPaths declared = declared_paths(document, *scene);
  const Automaton requested = requested_paths(document);
  const Automaton missing = without(requested, declared.paths);
  Automaton missing_from_points;  // declared, but not for lights without extent
  if (has_point_lights(*document.scene)) {
    const render::MethodSettings reference = with_reference_integrator(document, *scene).method;
    const Automaton measurable = common(declared_paths(reference).point_paths, requested);
    missing_from_points = without(common(declared.paths, measurable), declared.point_paths);
  }
  if (missing.empty() && missing_from_points.empty()) return measured;
  const auto total = total_energy(session, document, options, progress);
  if (!total) {
    measured.finished = false;
    return measured;
  }
  measured.total = *total;
  std::vector<ClassEnergy> energies;
  const auto add = [&](const render::Document& d, const Automaton& paths, bool from_point_lights) {
    const ClassTable table = class_table(session, d, paths, options, progress);
    measured.finished = measured.finished && table.finished;
    measured.width = table.width;
    energies.push_back(table.total.energy);
    for (const ClassRow& row : table.rows)
      measured.missing.classes.push_back({.paths = row.paths,
                                          .energy = row.energy,
                                          .share = row.energy.mean / total->mean,
                                          .from_point_lights = from_point_lights});
  };
  if (!missing.empty()) add(document, missing, false);
  if (!missing_from_points.empty()) {
    render::Document lit = document;
    lit.scene = std::make_shared<const scene::Scene>(with_point_lights_only(*document.scene));
    add(lit, missing_from_points, true);
  }
  summarize(measured.missing, energies);
  measured.relative_square = relative_square_of(energies, measured.total);
  return measured;
}

std::string missing_paths_text(const MissingPaths& missing) {
  if (missing.none()) return "misses no path class with measurable energy";
  std::string text = "misses " + format_percent(missing.share) + " of the light: ";
  constexpr size_t kNamed = 3;
  for (size_t i = 0; i < std::min(kNamed, missing.classes.size()); ++i) {
    const MissingPathClass& c = missing.classes[i];
    text += (i > 0 ? ", " : "") + c.paths + (c.from_point_lights ? " of point lights" : "");
  }
  if (missing.classes.size() > kNamed) text += " and " + std::to_string(missing.classes.size() - kNamed) + " more";
  return text;
}

std::vector<std::string> beyond_all_methods(const scene::CompiledScene& scene) {
  // Caustics. The mirror image of a point light itself has no extent, so it does not count as missing.
  static constexpr const char* kCaustic = "E.*(D|G)S+L";
  const Automaton caustic = PathExpression::parse_paths(kCaustic)->automaton();
  const bool found = std::ranges::any_of(integrator::integrator_infos(), [&](const auto& info) {
    return !common(declared_paths(info).point_paths, caustic).empty();
  });
  const auto& lights = scene.lights().placed();
  if (found || lights.empty()) return {};
  for (const auto& instance : scene.instances())
    if (const auto& material = scene.materials()[instance.material]; is_smooth(material))
      return {"caustics of " + name_of(lights.front()) + " by " + name_of(material) + " (" + kCaustic +
              ") are not found by any method"};
  return {};
}

}  // namespace etendue::advisor
