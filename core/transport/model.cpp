#include "transport/model.h"

#include <algorithm>

#include "scene/compiled_scene.h"
#include "transport/path_expression/path_expression.h"

namespace etendue::transport {
namespace {

using scene::CompiledScene;

using Materials = std::vector<const SurfaceMaterial*>;

// The number of materials of meshes and of lights with a surface.
size_t count_materials_of_surfaces(const CompiledScene& scene) {
  const size_t all = scene.materials().size(), of_meshes = scene.description().materials.size();
  std::vector<bool> possible(all);
  std::fill(possible.begin() + static_cast<std::ptrdiff_t>(std::min(of_meshes, all)), possible.end(), true);
  for (const scene::MeshGroup& mesh : scene.description().meshes)
    for (const scene::Primitive& primitive : mesh.primitives)
      if (const auto number = static_cast<size_t>(primitive.material); number < all) possible[number] = true;
  return static_cast<size_t>(std::ranges::count(possible, true));
}

// The materials of surfaces, in the order of the instances. There may be a million instances, but seldom as many
// materials: the search ends when all were seen.
Materials used_materials(const CompiledScene& scene) {
  const std::vector<SurfaceMaterial>& all = scene.materials();
  const size_t count = count_materials_of_surfaces(scene);
  std::vector<bool> seen(all.size());
  Materials used;
  for (const auto& instance : scene.instances()) {
    if (seen[instance.material]) continue;
    seen[instance.material] = true;
    used.push_back(&all[instance.material]);
    if (used.size() == count) break;
  }
  return used;
}

// The first material for which `test` holds, or null.
template <class Test>
const SurfaceMaterial* find_in(const Materials& materials, Test&& test) {
  const auto found = std::ranges::find_if(materials, [&](const SurfaceMaterial* m) { return test(*m); });
  return found == materials.end() ? nullptr : *found;
}

std::string node_name(const CompiledScene& scene, uint32_t node) {
  const std::string& name = scene.description().nodes[node].name;
  return name.empty() ? "node " + std::to_string(node) : "node '" + name + "'";
}

std::string named(const SurfaceMaterial& material) {
  return material.description.name.empty() ? "an unnamed material" : "material '" + material.description.name + "'";
}

Decision decide(const char* flag, bool larger, const char* small, const char* large, std::string reason, bool forced) {
  Decision d{flag, larger || forced ? large : small, larger ? large : small, std::move(reason)};
  if (forced && !larger) d.reason += "; forced on";
  return d;
}

// The first medium whose coefficients are measured by wavelength; empty if there is none.
std::string medium_with_spectrum(const CompiledScene& scene) {
  for (uint32_t i = 0; i < scene.solids().size(); ++i) {
    const SurfaceMaterial& material = scene.materials()[scene.solids()[i].material];
    if (material.description.medium.has_spectrum()) return "the medium in " + named(material);
  }
  return scene.solids().atmosphere() && scene.description().atmosphere.medium.has_spectrum() ? "the atmosphere" : "";
}

// RGB or spectral, which is needed if the index of refraction of a visible material depends on the wavelength, or if an
// emitter or a medium has a spectrum.
Decision decide_color(const CompiledScene& scene, const Materials& used, ColorMode mode) {
  const auto* dispersive = find_in(used, [](const auto& m) { return m.disperses(); });
  const std::string emitter = scene.emitter_with_spectrum(), medium = medium_with_spectrum(scene);
  Decision d{"colour", "RGB", "RGB", "no material disperses light, and no emitter or medium has a spectrum"};
  if (dispersive)
    d.needed = "spectral", d.reason = named(*dispersive) + " disperses light";
  else if (!emitter.empty() || !medium.empty())
    d.needed = "spectral", d.reason = (emitter.empty() ? medium : emitter) + " has a spectrum";
  d.value = mode == ColorMode::automatic ? d.needed : mode == ColorMode::spectral ? "spectral" : "RGB";
  if (d.value == d.needed) return d;
  d.reason += d.value == "spectral" ? "; spectral selected" : "; RGB selected";
  if (dispersive) d.reason += ", dispersion ignored";
  return d;
}

// Only Lambertian lobes, the lobes of most glTF files, or all lobes.
Decision decide_surfaces(const Materials& used, bool forced) {
  const auto* shiny = find_in(used, [](const auto& m) { return !m.is_lambertian; });
  const auto* rare = find_in(used, [](const auto& m) { return !m.uses_standard_lobes; });
  Decision d{"surfaces", "diffuse", "diffuse", "every surface is Lambertian"};
  if (shiny) d.needed = "standard", d.reason = named(*shiny) + " is not Lambertian";
  if (rare) d.needed = "any", d.reason = named(*rare) + " has a reflection model or a layer of its own";
  d.value = forced ? "any" : d.needed;
  if (forced && d.value != d.needed) d.reason += "; forced on";
  return d;
}

// A clear solid that touches no other one refracts against a vacuum, from either side.
std::string reason_for_media(const CompiledScene& scene) {
  const scene::Solids& solids = scene.solids();
  for (uint32_t i = 0; i < solids.size(); ++i)
    if (solids[i].heterogeneous)
      return "the density of the medium in " + named(scene.materials()[solids[i].material]) + " varies";
  if (solids.atmosphere() && solids.atmosphere()->heterogeneous) return "the density of the atmosphere varies";
  for (uint32_t i = 0; i < solids.size(); ++i)
    if (solids[i].medium.emits())
      return "the medium in " + named(scene.materials()[solids[i].material]) + " emits light";
  if (solids.atmosphere() && solids.atmosphere()->medium.emits()) return "the atmosphere emits light";
  if (solids.atmosphere()) return "the scene has an atmosphere";
  for (uint32_t i = 0; i < solids.size(); ++i)
    if (solids[i].medium.scatters()) return named(scene.materials()[solids[i].material]) + " scatters inside";
  for (uint32_t i = 0; i < solids.size(); ++i)
    if (solids[i].absorbs) return named(scene.materials()[solids[i].material]) + " absorbs inside";
  for (uint32_t i = 0; i < solids.size(); ++i)
    if (solids[i].may_overlap)
      return "the bounds of " + node_name(scene, solids[i].node) + " intersect those of another solid";
  for (uint32_t i = 0; i < solids.size(); ++i)
    if (!solids[i].has_surface)
      return named(scene.materials()[solids[i].material]) + " is the boundary of a medium only";
  return "no solid absorbs or touches another one";
}

// Media between surfaces: none, those of solids, scattering or emitting media, or media whose density varies.
Decision decide_media(const CompiledScene& scene, bool forced) {
  Decision d = decide("media", !scene.solids().empty(), "vacuum", "solids", reason_for_media(scene), forced);
  if (scene.scatters()) d.value = d.needed = "homogeneous scattering";
  if (scene.solids().any_medium_emits()) d.value = d.needed = "homogeneous emitting";
  if (scene.solids().any_heterogeneous()) d.value = d.needed = "heterogeneous";
  return d;
}

// Whether the expression excludes any path of the scene.
bool filters(std::string_view paths, bool has_scattering_media) {
  if (paths.empty()) return false;
  const Automaton& all = PathExpression::all_of(has_scattering_media).automaton();
  const auto excluded = Automaton::difference(all, PathExpression::parse_paths(paths)->automaton());
  return !excluded || !excluded->empty();
}

std::string reason_for_classes(std::string_view paths, bool filtered) {
  if (paths.empty()) return "no expression says which paths count";
  return "'" + std::string(paths) + (filtered ? "' leaves paths out" : "' takes every path");
}

std::string reason_for_motion(const CompiledScene& scene) {
  if (!(scene.camera().shutter > 0)) return "the shutter is open for an instant only";
  const std::string moving = scene.moving();
  return moving.empty() ? "nothing moves while the shutter is open" : moving + " moves while the shutter is open";
}

}  // namespace

std::vector<std::string> model_flags() { return {"surfaces", "media", "motion", "classes"}; }

std::string Model::summary() const {
  std::string text;
  for (const auto& d : decisions) text += (text.empty() ? "" : ", ") + d.value;
  return text;
}

Model model_for(const CompiledScene& scene, std::span<const std::string> forced, std::string_view paths,
                ColorMode color) {
  const auto is_forced = [&](const char* flag) {
    return std::find(forced.begin(), forced.end(), flag) != forced.end();
  };
  const Materials used = used_materials(scene);
  Model model;
  auto& out = model.decisions;
  out.push_back(decide_color(scene, used, color));
  model.spectral = out[0].value == "spectral";
  out.push_back(decide_surfaces(used, is_forced("surfaces")));
  out.push_back(decide_media(scene, is_forced("media")));
  const auto* clear = find_in(used, [](const auto& m) { return m.has_alpha; });
  out.push_back({"transparency", clear ? "stochastic" : "opaque", clear ? "stochastic" : "opaque",
                 clear ? named(*clear) + " has an alpha mode" : "no material has an alpha mode"});
  const auto* textured = find_in(used, [](const auto& m) { return m.has_textures; });
  out.push_back({"textures", textured ? "textured" : "constant", textured ? "textured" : "constant",
                 textured ? named(*textured) + " has a texture" : "no material has a texture"});
  const bool moves = !scene.moving().empty();
  out.push_back(decide("motion", moves, "static", "moving", reason_for_motion(scene), is_forced("motion")));
  const bool lens = scene.camera().lens_radius > 0;
  out.push_back({"lens", lens ? "thin lens" : "pinhole", lens ? "thin lens" : "pinhole",
                 lens ? "the camera's lens has a radius" : "the camera's lens radius is 0"});

  const bool filtered = filters(paths, scene.scatters());
  out.push_back(decide("classes", filtered, "all paths", "path classes", reason_for_classes(paths, filtered),
                       is_forced("classes")));

  model.moving = moves || is_forced("motion");
  const bool classes = filtered || is_forced("classes"), media = out[2].value != "vacuum";
  model.diffuse = out[1].value == "diffuse" && !media && !(model.spectral && classes);
  // Spectral rendering has one small model and one large one.
  const bool large_spectral = model.spectral && !model.diffuse;
  model.classes = classes || large_spectral;
  if (model.classes)
    model.paths =
        std::make_shared<const PathExpression>(filtered ? *PathExpression::parse_paths(paths) : PathExpression::all());
  model.media = media || large_spectral;
  model.scattering = scene.scatters();
  model.heterogeneous = scene.solids().any_heterogeneous() || scene.solids().any_medium_emits();
  model.wide = out[1].value == "any";
  return model;
}

}  // namespace etendue::transport
