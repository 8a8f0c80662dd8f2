#include "advisor/missing_paths.h"

#include <algorithm>
#include <cctype>

#include "advisor/light_kinds.h"
#include "advisor/number_text.h"
#include "light/placed_light.h"
#include "scene/compiled_scene.h"
#include "transport/path_expression/path_expression.h"

namespace etendue::advisor {
namespace {

using transport::Automaton;
using transport::PathExpression;

// The part of a row that is not among the paths found; nothing if all of it is. `visible` are the paths that the table
// can know of.
std::optional<MissingPathClass> lack(const std::string& paths, const ClassEnergy& energy, const Automaton& visible,
                                     const Automaton& found, double total) {
  if (!energy.found()) return {};
  const Automaton row = common(PathExpression::parse_paths(paths)->automaton(), visible);
  const Automaton rest = without(row, found);
  if (rest.empty()) return {};
  MissingPathClass spot{rest == row ? paths : expression_of(rest), energy, energy.mean / total};
  spot.part = rest != row;
  return spot;
}

// Brings the classes into order and adds them up; `missing` are the pictures of all of them.
void settle(MissingPaths& spots, std::span<const ClassEnergy> missing) {
  std::ranges::stable_sort(spots.classes, std::ranges::greater(), &MissingPathClass::share);
  for (const MissingPathClass& spot : spots.classes) {
    spots.share = std::min(1.0, spots.share + spot.share);
    spots.uncertain = spots.uncertain || spot.energy.uncertain();
  }
  spots.rms = rms_of(missing);
}

// A surface that reflects or refracts into single directions, whatever its textures say.
bool is_smooth(const SurfaceMaterial& m) { return m.specular_deltas; }

std::string name_of(const PlacedLight& light) {
  std::string type = light.type->label;
  type.front() = static_cast<char>(std::tolower(type.front()));
  return light.name.empty() ? "a " + type : "the " + type + " '" + light.name + "'";
}

std::string name_of(const SurfaceMaterial& m) {
  const std::string name = m.description.name.empty() ? "" : " '" + m.description.name + "'";
  return (m.description.transmission > 0 ? "glass" : "smooth surfaces") + name;
}

}  // namespace

MissingPaths missing_paths(const Found& found, const ClassTable& table) {
  MissingPaths spots;
  const Found all = declared(render::MethodSettings());
  const double total = table.total.energy.mean;
  std::vector<ClassEnergy> missing;
  const auto add = [&](const MissingPathClass& spot) { spots.classes.push_back(spot), missing.push_back(spot.energy); };
  for (const ClassRow& row : table.rows) {
    if (const auto spot = lack(row.paths, row.energy, all.paths, found.paths, total)) {
      add(*spot);
    } else if (auto dark = lack(row.paths, row.from_points, all.point_paths, found.point_paths, total)) {
      dark->points = true;
      add(*dark);
    }
  }
  settle(spots, missing);
  return spots;
}

MeasuredMissingPaths measured_missing_paths(render::Session& session, const render::Document& document,
                                            const TableOptions& options, const bench::Progress& watch) {
  MeasuredMissingPaths measured;
  const auto scene = scene::compile(document.scene, document.camera, session.scene());
  const Found found = declared(document, *scene), all = declared(render::MethodSettings());
  const Automaton counting = asked(document), lack = without(counting, found.paths);
  Automaton dark;  // found, but not from lights without extent
  if (has_point_lights(*document.scene))
    dark = without(common(common(counting, found.paths), all.point_paths), found.point_paths);
  if (lack.empty() && dark.empty()) return measured;
  const auto total = total_energy(session, document, options, watch);
  if (!total) return measured.finished = false, measured;
  measured.total = *total;
  std::vector<ClassEnergy> energies;
  const auto add = [&](const render::Document& d, const Automaton& paths, bool points) {
    const ClassTable table = class_table(session, d, paths, options, watch);
    measured.finished = measured.finished && table.finished;
    measured.width = table.width;
    energies.push_back(table.total.energy);
    for (const ClassRow& row : table.rows)
      measured.spots.classes.push_back({row.paths, row.energy, row.energy.mean / total->mean, points});
  };
  if (!lack.empty()) add(document, lack, false);
  if (!dark.empty()) {
    render::Document lit = document;
    lit.scene = std::make_shared<const scene::Scene>(lit_by_points(*document.scene));
    add(lit, dark, true);
  }
  settle(measured.spots, energies);
  measured.relative_square = relative_square_of(energies, measured.total);
  return measured;
}

std::string sentence_of(const MissingPaths& spots) {
  if (spots.none()) return "misses nothing that was found to carry light";
  std::string text = "misses " + percent(spots.share) + " of the light: ";
  constexpr size_t kNamed = 3;
  for (size_t i = 0; i < std::min(kNamed, spots.classes.size()); ++i) {
    const MissingPathClass& spot = spots.classes[i];
    text += (i > 0 ? ", " : "") + spot.paths + (spot.points ? " of point lights" : "");
  }
  if (spots.classes.size() > kNamed) text += " and " + std::to_string(spots.classes.size() - kNamed) + " more";
  return text;
}

std::vector<std::string> beyond_all_methods(const scene::CompiledScene& scene) {
  // Light that a smooth surface casts on another: a picture of the light itself in a mirror is a point, and no loss.
  static constexpr const char* kCaustic = "E.*(D|G)S+L";
  const Automaton caustic = PathExpression::parse_paths(kCaustic)->automaton();
  const bool found = std::ranges::any_of(integrator::integrator_infos(), [&](const auto& info) {
    return !common(declared(info).point_paths, caustic).empty();
  });
  const auto& lights = scene.lights().placed();
  if (found || lights.empty()) return {};
  for (const auto& instance : scene.instances())
    if (const auto& material = scene.materials()[instance.material]; is_smooth(material))
      return {"what " + name_of(lights.front()) + " casts through or off " + name_of(material) + " (" + kCaustic +
              "): not found by any method"};
  return {};
}

}  // namespace etendue::advisor
