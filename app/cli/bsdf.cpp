// etendue bsdf: what a reflection model does with energy, reciprocity and samples, measured.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "bsdf/measured/brdf_table.h"
#include "bsdf_analysis/checks.h"
#include "bsdf_analysis/drawings.h"
#include "command.h"
#include "interrupt.h"
#include "render/document.h"
#include "scene/builtin/builtin.h"

namespace etendue::cli {
namespace {

using nlohmann::json;

struct Options {
  std::string model, against, scene, material, out, table;
  std::vector<std::string> set, set_against;
  std::vector<int> steps{24, 72};  // of a table: polar, azimuth
  double degrees = 45;
  bool json = false, all = false;
};

// One side of the comparison.
struct Specimen {
  std::string name;
  Material material;
  std::vector<ParameterInfo> parameters;
  bsdf_analysis::Lobes lobes;
  bsdf_analysis::Audit audit;
};

Result<render::Document> document_of(const Options& o) {
  render::Document d;
  auto scene = std::make_shared<scene::Scene>();
  scene->materials.emplace_back();
  if (!o.scene.empty()) {
    auto loaded = scene::load(o.scene);
    if (!loaded) return loaded.error();
    const auto& materials = loaded->materials;
    size_t index = 0;
    while (index < materials.size() && materials[index].name != o.material && std::to_string(index) != o.material)
      ++index;
    if (index == materials.size())
      return usage_error(o.scene + ": there is no material '" + o.material + "'; `etendue inspect` lists them");
    scene->materials[0] = materials[index];
  }
  d.scene = scene;
  return d;
}

// A name alone is a parameter of the model, or else of the material.
Result<render::Document> with_setting(const render::Document& d, const std::string& model, const std::string& setting) {
  const size_t equals = setting.find('=');
  if (equals == std::string::npos) return usage_error("'" + setting + "' has no value; a setting is NAME=VALUE");
  const std::string name = setting.substr(0, equals), value = setting.substr(equals + 1);
  const std::string own = "material.0." + model + "." + name;
  for (const auto& b : render::section_parameters(d, "material.0"))
    if (b.info.name == own) return render::with_text(d, own, value);
  return render::with_text(d, "material.0." + name, value);
}

Result<Specimen> specimen_of(const Options& o, const std::string& model, const std::vector<std::string>& settings) {
  auto d = document_of(o);
  if (!d) return d.error();
  if (!model.empty()) d = render::with_text(*d, "material.0.model", model);
  if (!d) return d.error();
  const BsdfModelRef chosen = d->scene->materials[0].model;
  const std::string name = chosen ? chosen->info().description.name : "gltf";
  for (const auto& setting : settings) {
    d = with_setting(*d, name, setting);
    if (!d) return d.error();
  }
  Specimen s{name, d->scene->materials[0], {}, {}, {}};
  if (s.material.model) s.parameters = s.material.model->parameters();
  s.lobes = bsdf_analysis::lobes_of(s.material);
  return s;
}

json number(double v) { return std::isfinite(v) ? json(v) : json(); }

json color_json(const Rgb& c) { return {c.r, c.g, c.b}; }

json albedo_json(const std::vector<bsdf_analysis::Albedo>& curve) {
  json list = json::array();
  for (const auto& a : curve)
    list.push_back({{"degrees", a.degrees},
                    {"albedo", color_json(a.value)},
                    {"standard_error", number(a.error)},
                    {"diffuse", color_json(a.diffuse)},
                    {"glossy", color_json(a.glossy)},
                    {"specular", color_json(a.specular)},
                    {"transmitted", color_json(a.transmitted)}});
  return list;
}

json specimen_json(const Specimen& s) {
  json parameters = json::object(), badges = json::object(), sampling = json::array();
  for (const auto& p : s.parameters)
    parameters[p.name] = std::visit([](const auto& v) { return json(v); }, p.default_value);
  for (const auto& b : s.audit.badges) badges[b.name] = {{"holds", b.holds}, {"reason", b.reason}};
  for (const auto& q : s.audit.sampling)
    sampling.push_back({{"degrees", q.degrees},
                        {"deviation", number(q.deviation)},
                        {"largest", number(q.largest)},
                        {"absorbed", q.absorbed},
                        {"deviation_by_cosine", number(q.by_cosine)},
                        {"discrepancy", number(q.discrepancy)}});
  return {{"model", s.name},
          {"parameters", parameters},
          {"badges", badges},
          {"asymmetry", s.audit.plausibility.asymmetry},
          {"hemispherical_albedo", number(bsdf_analysis::hemispherical_albedo(s.audit.albedo))},
          {"albedo", albedo_json(s.audit.albedo)},
          {"albedo_inside", albedo_json(s.audit.albedo_inside)},
          {"sampling", sampling}};
}

void print(const Specimen& s) {
  std::printf("%s\n", s.name.c_str());
  for (const auto& b : s.audit.badges) std::printf("  %s %-22s %s\n", b.holds ? " " : "!", b.label(), b.reason.c_str());
  std::printf("  albedo by angle (hemispherical %.4f)\n", bsdf_analysis::hemispherical_albedo(s.audit.albedo));
  for (const auto& a : s.audit.albedo)
    std::printf("    %5.1f\u00b0  %.4f %.4f %.4f  +- %.1g\n", a.degrees, static_cast<double>(a.value.r),
                static_cast<double>(a.value.g), static_cast<double>(a.value.b), a.error);
  std::printf("  weights of samples: deviation (by the cosine), largest, absorbed\n");
  for (const auto& q : s.audit.sampling)
    std::printf("    %5.1f\u00b0  %.3f (%.3f)  %.3g  %.1f %%\n", q.degrees, q.deviation, q.by_cosine, q.largest,
                100 * q.absorbed);
}

Result<void> write_drawings(const std::vector<Specimen>& specimens, const Options& o) {
  std::error_code error;
  std::filesystem::create_directories(o.out, error);
  if (error) return output_error(o.out + ": cannot be made: " + error.message());
  std::vector<bsdf_analysis::Slice> slices;
  std::vector<std::vector<bsdf_analysis::Albedo>> curves;
  std::vector<std::string> names;
  for (const auto& s : specimens) {
    slices.push_back(bsdf_analysis::slice(s.lobes, o.degrees));
    curves.push_back(s.audit.albedo);
    names.push_back(s.name);
  }
  const auto write = [&](const char* name, const metrics::Drawing& drawing) {
    const std::string svg = metrics::svg_of(drawing);
    return write_file(std::filesystem::path(o.out) / name, svg.data(), svg.size());
  };
  if (auto done = write("polar.svg", bsdf_analysis::polar_drawing(slices, names)); !done) return done;
  if (auto done = write("albedo.svg", bsdf_analysis::albedo_drawing(curves, names)); !done) return done;
  for (const auto& s : specimens) {
    std::vector<bsdf_analysis::LobeSurface> sides{bsdf_analysis::lobe_surface(s.lobes, o.degrees)};
    if (bsdf_analysis::passes_light(s.lobes))
      sides.push_back(bsdf_analysis::lobe_surface(s.lobes, o.degrees, bsdf_analysis::Side::lower));
    const char* name = &s == specimens.data() ? "lobe.svg" : "lobe-against.svg";
    if (auto done = write(name, bsdf_analysis::lobe_drawing(sides, o.degrees)); !done) return done;
  }
  return {};
}

// The virtual gonioreflectometer: what reflects, as a file that the model `tabulated` reads.
Result<void> write_table(const Specimen& s, const Options& o) {
  const auto f = [&](const Vec3& wo, const Vec3& wi) { return s.lobes.eval(wo, wi, Transport::radiance); };
  const bool isotropic = !SurfaceMaterial(s.material, {}).anisotropic;
  return BrdfTable::measured(f, o.steps[0], o.steps[1], isotropic).write(o.table);
}

// Every model as it is by default, a line each, for docs/materials.md.
void print_table() {
  std::printf(
      "| model | class | never negative | reciprocal | conserves energy | most albedo | albedo of even light | "
      "deviation of weights at 0, 45, 80 degrees |\n|---|---|---|---|---|---|---|---|\n");
  const auto sign = [](const bsdf_analysis::Check& b) { return b.holds ? "yes" : "**no**"; };
  for (const BsdfModelInfo& info : bsdf_model_infos()) {
    Material material;
    material.model.model = make_bsdf_model(info.description.name);
    const bsdf_analysis::Audit a = bsdf_analysis::audit(bsdf_analysis::lobes_of(material));
    std::printf("| `%s` | %s | %s | %s | %s | %.3f at %.4g | %.3f |", info.description.name,
                etendue::Options<ModelClass>::kOptions[static_cast<size_t>(info.description.kind)].name,
                sign(a.badges[0]), sign(a.badges[1]), sign(a.badges[2]),
                static_cast<double>(max_component(a.plausibility.most.value)), a.plausibility.most.degrees,
                bsdf_analysis::hemispherical_albedo(a.albedo));
    for (const auto& q : a.sampling)
      if (q.degrees == 0 || q.degrees == 45 || q.degrees == 80) std::printf(" %.2f", q.deviation);
    std::printf(" |\n");
  }
}

int run(const Options& o) {
  if (o.all) return print_table(), 0;
  if (o.model.empty() && o.scene.empty())
    return fail(usage_error("name a model (`etendue list materials`), or a scene and one of its materials"));
  std::vector<Specimen> specimens;
  auto first = specimen_of(o, o.model, o.set);
  if (!first) return fail(first.error());
  specimens.push_back(*first);
  if (!o.against.empty()) {
    auto second = specimen_of(o, o.against, o.set_against);
    if (!second) return fail(second.error());
    specimens.push_back(*second);
  }
  if (!o.table.empty())
    if (const auto written = write_table(specimens.front(), o); !written) return fail(written.error());
  const std::atomic<bool>& interrupted = watch_interrupts();
  for (auto& s : specimens) s.audit = bsdf_analysis::audit(s.lobes, [&] { return !interrupted; });
  if (interrupted) return static_cast<int>(Fault::interrupted);
  if (!o.out.empty())
    if (const auto written = write_drawings(specimens, o); !written) return fail(written.error());
  if (o.json) {
    json list = json::array();
    for (const auto& s : specimens) list.push_back(specimen_json(s));
    std::printf("%s\n", (o.against.empty() ? list[0] : list).dump(2).c_str());
  } else {
    for (const auto& s : specimens) print(s);
  }
  return 0;
}

}  // namespace

Command add_bsdf(CLI::App& app) {
  auto o = std::make_shared<Options>();
  app.add_option("model", o->model, "A reflection model, or gltf; `etendue list materials` has them");
  app.add_option("--set", o->set, "NAME=VALUE: a parameter of the model, or of the material")->take_all();
  app.add_option("--against", o->against, "Another model to put beside it");
  app.add_option("--set-against", o->set_against, "NAME=VALUE of the other model")->take_all();
  app.add_option("--scene", o->scene, "Look at a material of this scene");
  app.add_option("--material", o->material, "Its name or number")->needs("--scene");
  app.add_option("--angle", o->degrees, "Degrees between eye and normal in the drawings")->check(CLI::Range(0.0, 89.9));
  app.add_option("--out", o->out, "Write polar.svg, albedo.svg and lobe.svg into this folder");
  app.add_option("--table", o->table, "Measure it into a table, which the model tabulated reads back");
  app.add_option("--steps", o->steps, "Polar and azimuth steps of the table")->expected(2)->check(CLI::Range(2, 360));
  app.add_flag("--all", o->all, "Every model as it is by default, as a table in Markdown");
  app.add_flag("--json", o->json, "Print JSON");
  return [o] { return run(*o); };
}

}  // namespace etendue::cli
