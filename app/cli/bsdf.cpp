// etendue bsdf: measures energy conservation, reciprocity and sampling quality of a reflection model.
#include <cstdio>
#include <filesystem>
#include <memory>

#include "base/file.h"
#include "bsdf/measured/brdf_table.h"
#include "bsdf_analysis/checks.h"
#include "bsdf_analysis/drawings.h"
#include "bsdf_analysis/reflectance_geometries.h"
#include "command.h"
#include "interrupt.h"
#include "json.h"
#include "scene/builtin/builtin.h"
#include "scene_options.h"
#include "subjects.h"

namespace etendue::cli {
namespace {

struct BsdfArguments {
  std::string model, against, scene, material, out, table;
  std::vector<std::string> settings, settings_against;
  std::vector<int> steps{24, 72};  // of a table: polar and azimuthal
  double degrees = 45, cone = 10;
  bool json = false, all = false;
};

// One of the reflection models that are compared.
struct Subject {
  std::string name;
  Material material;
  std::vector<ParameterInfo> parameters;
  bsdf_analysis::Lobes lobes;
  bsdf_analysis::SurfaceAnalysis analysis;
  // In nine geometries; transmittances only of surfaces that transmit.
  std::vector<bsdf_analysis::Reflectance> reflectances, transmittances;
};

// A document with one material: the chosen one of a scene, or the default.
Result<render::Document> document_with_material(const BsdfArguments& a) {
  render::Document d;
  auto scene = std::make_shared<scene::Scene>();
  scene->materials.emplace_back();
  if (!a.scene.empty()) {
    auto loaded = scene::load(a.scene);
    if (!loaded) return loaded.error();
    const auto& materials = loaded->materials;
    size_t index = 0;
    while (index < materials.size() && materials[index].name != a.material && std::to_string(index) != a.material)
      ++index;
    if (index == materials.size())
      return usage_error(a.scene + ": there is no material '" + a.material + "'; give its name, or its index below " +
                         std::to_string(materials.size()));
    scene->materials[0] = materials[index];
  }
  d.scene = scene;
  return d;
}

// An unqualified name is a parameter of the model if there is one of that name, otherwise of the material.
Result<render::Document> with_setting(const render::Document& d, const std::string& model, const std::string& text) {
  const auto setting = split_setting(text);
  if (!setting) return setting.error();
  const std::string qualified = "material.0." + model + "." + setting->name;
  for (const auto& parameter : render::section_parameters(d, "material.0"))
    if (parameter.info.name == qualified) return render::with_text(d, qualified, setting->value);
  return render::with_text(d, "material.0." + setting->name, setting->value);
}

Result<Subject> make_subject(const BsdfArguments& a, const std::string& model,
                             const std::vector<std::string>& settings) {
  auto d = document_with_material(a);
  if (!d) return d.error();
  if (!model.empty()) d = render::with_text(*d, "material.0.model", model);
  if (!d) return d.error();
  const BsdfModelRef chosen = d->scene->materials[0].model;
  const std::string name = chosen ? chosen->info().description.name : "gltf";
  for (const auto& setting : settings) {
    d = with_setting(*d, name, setting);
    if (!d) return d.error();
  }
  Subject s{name, d->scene->materials[0], {}, {}, {}, {}, {}};
  if (s.material.model) s.parameters = s.material.model->parameters();
  s.lobes = bsdf_analysis::lobes_of(s.material);
  return s;
}

json albedo_json(const std::vector<bsdf_analysis::Albedo>& curve) {
  json list = json::array();
  for (const auto& a : curve)
    list.push_back({{"degrees", a.degrees},
                    {"albedo", color_json(a.value)},
                    {"standard_error", number_json(a.error)},
                    {"diffuse", color_json(a.diffuse)},
                    {"glossy", color_json(a.glossy)},
                    {"specular", color_json(a.specular)},
                    {"transmitted", color_json(a.transmitted)}});
  return list;
}

json reflectances_json(const std::vector<bsdf_analysis::Reflectance>& list) {
  json array = json::array();
  for (const auto& r : list)
    array.push_back({{"from", bsdf_analysis::kExtentNames[static_cast<size_t>(r.from)]},
                     {"to", bsdf_analysis::kExtentNames[static_cast<size_t>(r.to)]},
                     {"factor", color_json(r.factor)},
                     {"fraction", color_json(r.fraction)},
                     {"standard_error", number_json(r.error)}});
  return array;
}

json subject_json(const Subject& s) {
  json parameters = json::object(), checks = json::object(), sampling = json::array();
  for (const auto& p : s.parameters) parameters[p.name] = to_json_value<json>(p.default_value);
  for (const auto& check : s.analysis.checks) checks[check.name] = {{"holds", check.holds}, {"reason", check.reason}};
  for (const auto& q : s.analysis.sampling)
    sampling.push_back({{"degrees", q.degrees},
                        {"deviation", number_json(q.deviation)},
                        {"largest", number_json(q.largest)},
                        {"absorbed", q.absorbed},
                        {"deviation_by_cosine", number_json(q.cosine_deviation)},
                        {"discrepancy", number_json(q.discrepancy)}});
  return {{"model", s.name},
          {"parameters", parameters},
          {"badges", checks},
          {"asymmetry", s.analysis.plausibility.asymmetry},
          {"hemispherical_albedo", number_json(bsdf_analysis::hemispherical_albedo(s.analysis.albedo))},
          {"albedo", albedo_json(s.analysis.albedo)},
          {"albedo_inside", albedo_json(s.analysis.albedo_inside)},
          {"reflectance", reflectances_json(s.reflectances)},
          {"transmittance", reflectances_json(s.transmittances)},
          {"sampling", sampling}};
}

// Luminances of reflectance factors: a row for each geometry of the incident light.
void print_reflectances(const char* title, const std::vector<bsdf_analysis::Reflectance>& list) {
  if (list.empty()) return;
  std::printf("  %s, from (rows) to (columns)\n    %-14s %14s %20s %20s\n", title, "", "directional", "conical",
              "hemispherical");
  for (size_t i = 0; i < list.size(); ++i) {
    if (i % 3 == 0) std::printf("    %-14s", bsdf_analysis::kExtentNames[i / 3]);
    std::printf("  %9.4f ± %-7.1g", static_cast<double>(luminance(list[i].factor)), list[i].error);
    if (i % 3 == 2) std::printf("\n");
  }
}

void print(const Subject& s) {
  std::printf("%s\n", s.name.c_str());
  for (const auto& check : s.analysis.checks)
    std::printf("  %s %-22s %s\n", check.holds ? " " : "!", check.label(), check.reason.c_str());
  std::printf("  directional albedo (hemispherical %.4f)\n", bsdf_analysis::hemispherical_albedo(s.analysis.albedo));
  for (const auto& a : s.analysis.albedo)
    std::printf("    %5.1f°  %.4f %.4f %.4f  ± %.1g\n", a.degrees, static_cast<double>(a.value.r),
                static_cast<double>(a.value.g), static_cast<double>(a.value.b), a.error);
  print_reflectances("reflectance factors", s.reflectances);
  print_reflectances("transmittance factors", s.transmittances);
  std::printf("  sample weights: standard deviation (with cosine sampling), maximum, absorbed samples\n");
  for (const auto& q : s.analysis.sampling)
    std::printf("    %5.1f°  %.3f (%.3f)  %.3g  %.1f %%\n", q.degrees, q.deviation, q.cosine_deviation, q.largest,
                100 * q.absorbed);
}

Result<void> write_drawings(const std::vector<Subject>& subjects, const BsdfArguments& a) {
  std::error_code error;
  std::filesystem::create_directories(a.out, error);
  if (error) return output_error(a.out + ": the folder cannot be created: " + error.message());
  std::vector<bsdf_analysis::Slice> slices;
  std::vector<std::vector<bsdf_analysis::Albedo>> curves;
  std::vector<std::string> names;
  for (const auto& s : subjects) {
    slices.push_back(bsdf_analysis::slice(s.lobes, a.degrees));
    curves.push_back(s.analysis.albedo);
    names.push_back(s.name);
  }
  const auto write = [&](const char* name, const metrics::Drawing& drawing) {
    const std::string svg = metrics::to_svg(drawing);
    return write_file(std::filesystem::path(a.out) / name, svg.data(), svg.size());
  };
  if (auto ok = write("polar.svg", bsdf_analysis::polar_drawing(slices, names)); !ok) return ok;
  if (auto ok = write("albedo.svg", bsdf_analysis::albedo_drawing(curves, names)); !ok) return ok;
  for (const auto& s : subjects) {
    std::vector<bsdf_analysis::LobeSurface> sides{bsdf_analysis::lobe_surface(s.lobes, a.degrees)};
    if (bsdf_analysis::transmits_light(s.lobes))
      sides.push_back(bsdf_analysis::lobe_surface(s.lobes, a.degrees, bsdf_analysis::Side::lower));
    const char* name = &s == subjects.data() ? "lobe.svg" : "lobe-against.svg";
    if (auto ok = write(name, bsdf_analysis::lobe_drawing(sides, a.degrees)); !ok) return ok;
  }
  return {};
}

// Samples the reflection into a table, as a gonioreflectometer does. The model `tabulated` reads the file.
Result<void> write_table(const Subject& s, const BsdfArguments& a) {
  const auto f = [&](const Vec3& wo, const Vec3& wi) { return s.lobes.eval(wo, wi, TransportMode::radiance); };
  const bool isotropic = !SurfaceMaterial(s.material, {}).is_anisotropic;
  return BrdfTable::measured(f, a.steps[0], a.steps[1], isotropic).write(a.table);
}

// Prints all models with default parameters as a Markdown table, for docs/results/materials.md.
void print_all_models() {
  std::printf(
      "| model | class | non-negative | reciprocal | energy conserving | largest albedo | hemispherical albedo | "
      "standard deviation of sample weights at 0°, 45°, 80° |\n|---|---|---|---|---|---|---|---|\n");
  const auto result = [](const bsdf_analysis::Check& check) { return check.holds ? "yes" : "**no**"; };
  for (const BsdfModelInfo& info : bsdf_model_infos()) {
    Material material;
    material.model.model = make_bsdf_model(info.description.name);
    const bsdf_analysis::SurfaceAnalysis analysis = bsdf_analysis::analyze(bsdf_analysis::lobes_of(material));
    std::printf("| `%s` | %s | %s | %s | %s | %.3f at %.4g° | %.3f |", info.description.name,
                etendue::Options<ModelClass>::kOptions[static_cast<size_t>(info.description.model_class)].name,
                result(analysis.checks[0]), result(analysis.checks[1]), result(analysis.checks[2]),
                static_cast<double>(max_component(analysis.plausibility.largest_albedo.value)),
                analysis.plausibility.largest_albedo.degrees, bsdf_analysis::hemispherical_albedo(analysis.albedo));
    for (const auto& q : analysis.sampling)
      if (q.degrees == 0 || q.degrees == 45 || q.degrees == 80) std::printf(" %.2f", q.deviation);
    std::printf(" |\n");
  }
}

void measure_reflectances(Subject& s, const BsdfArguments& a) {
  const auto measured = [&](bool transmission) {
    const auto all = bsdf_analysis::reflectances(
        s.lobes, {.degrees = a.degrees, .half_angle = a.cone, .transmission = transmission});
    return std::vector(all.begin(), all.end());
  };
  s.reflectances = measured(false);
  if (bsdf_analysis::transmits_light(s.lobes)) s.transmittances = measured(true);
}

int run_bsdf(const BsdfArguments& a) {
  if (a.all) {
    print_all_models();
    return 0;
  }
  if (a.model.empty() && a.scene.empty())
    return fail(
        usage_error("bsdf: no model; give the name of one (see etendue list materials), or --scene and "
                    "--material"));
  auto made = make_subjects<Subject>({a.model, a.settings}, {a.against, a.settings_against},
                                     [&](const NamedSettings& s) { return make_subject(a, s.name, s.settings); });
  if (!made) return fail(made.error());
  std::vector<Subject>& subjects = *made;
  if (!a.table.empty())
    if (const auto ok = write_table(subjects.front(), a); !ok) return fail(ok.error());
  const std::atomic<bool>& interrupted = watch_interrupts();
  for (auto& s : subjects) {
    s.analysis = bsdf_analysis::analyze(s.lobes, [&] { return !interrupted; });
    measure_reflectances(s, a);
  }
  if (interrupted) return static_cast<int>(Fault::interrupted);
  if (!a.out.empty())
    if (const auto ok = write_drawings(subjects, a); !ok) return fail(ok.error());
  if (a.json) return print_json_of(subjects, subject_json);
  for (const auto& s : subjects) print(s);
  return 0;
}

}  // namespace

Command bsdf_command() {
  const auto a = std::make_shared<BsdfArguments>();
  return {
      .name = "bsdf",
      .summary = "Analyse a reflection model: energy, reciprocity, sampling",
      .options =
          {{.names = "model", .target = &a->model, .doc = "A reflection model, or gltf; see etendue list materials"},
           {.names = "--set",
            .target = &a->settings,
            .doc = "NAME=VALUE: sets a parameter of the model or of the material; may be repeated"},
           {.names = "--against", .target = &a->against, .doc = "A second model for comparison"},
           {.names = "--set-against",
            .target = &a->settings_against,
            .doc = "NAME=VALUE: sets a parameter of the second model; may be repeated"},
           {.names = "--scene", .target = &a->scene, .doc = "Analyse a material of this scene"},
           {.names = "--material",
            .target = &a->material,
            .doc = "Name or index of the material in the scene",
            .needs = "--scene"},
           {.names = "--angle",
            .target = &a->degrees,
            .doc = "Angle between direction and normal in the drawings and of reflectances, in degrees (45)",
            .bounds = between(0, 89.9)},
           {.names = "--cone",
            .target = &a->cone,
            .doc = "Half angle of the cones of conical reflectances, in degrees (10)",
            .bounds = between(0.1, 89.9)},
           {.names = "--out", .target = &a->out, .doc = "Folder for the drawings polar.svg, albedo.svg and lobe.svg"},
           {.names = "--table",
            .target = &a->table,
            .doc = "File for a table of the reflection, which the model 'tabulated' reads"},
           {.names = "--steps",
            .target = &a->steps,
            .doc = "Polar and azimuthal steps of the table (24 72)",
            .bounds = between(2, 360),
            .count = 2},
           {.names = "--all", .target = &a->all, .doc = "Print all models with default parameters as a Markdown table"},
           json_flag(a->json)},
      .run = [a] { return run_bsdf(*a); }};
}

}  // namespace etendue::cli
