// etendue energy: where the light of a scene goes, by object.
#include <cstdio>
#include <memory>

#include "base/json_text.h"
#include "command.h"
#include "interrupt.h"
#include "json.h"
#include "render/transport_audit.h"
#include "scene/compiled_scene.h"
#include "scene_options.h"

namespace etendue::cli {
namespace {

using render::EnergyAudit;
using render::Measured;

struct EnergyArguments {
  SceneArguments scene;
  uint64_t paths = 262'144;
  int64_t seed = -1;
  int threads = 0;
  bool json = false;
};

json measured_json(const Measured& m) { return {{"value", m.value}, {"standard_error", m.standard_error}}; }

json audit_json(const std::string& name, const EnergyAudit& audit) {
  json objects = json::array();
  for (const auto& o : audit.objects)
    objects.push_back({{"name", o.name},
                       {"node", o.node},
                       {"emitted", measured_json(o.emitted)},
                       {"received", measured_json(o.received)},
                       {"absorbed", measured_json(o.absorbed)},
                       {"largest_albedo", o.largest_albedo},
                       {"creates_energy", o.creates_energy}});
  return {{"scene", name},
          {"unit", "lm"},
          {"paths", audit.paths},
          {"objects", objects},
          {"emitted", measured_json(audit.emitted)},
          {"emitted_by_media", measured_json(audit.by_media)},
          {"emitted_by_environment", measured_json(audit.by_environment)},
          {"emitted_by_point_lights", measured_json(audit.by_point_lights)},
          {"absorbed", measured_json(audit.absorbed)},
          {"absorbed_by_media", measured_json(audit.absorbed_by_media)},
          {"escaped", measured_json(audit.escaped)},
          {"beyond_range", measured_json(audit.beyond_range)},
          {"missing", measured_json(audit.missing)},
          {"warnings", audit.warnings}};
}

std::string text_of(const Measured& m) {
  char text[64];
  std::snprintf(text, sizeof text, "%.4g ± %.2g", m.value, m.standard_error);
  return text;
}

// Columns are aligned by characters; '±' has two bytes.
void print_cell(const Measured& m) { std::printf("  %21s", m.value == 0 ? "-" : text_of(m).c_str()); }

void print_total(const char* name, const Measured& m, const Measured& emitted) {
  if (m.value == 0 && m.standard_error == 0) return;
  std::printf("%-24s  %20s lm  %6.2f %%\n", name, text_of(m).c_str(), 100 * m.value / emitted.value);
}

void print(const EnergyAudit& audit) {
  std::printf("%-24s  %20s  %20s  %20s  albedo\n", "object (lm)", "emitted", "received", "absorbed");
  for (const auto& o : audit.objects) {
    std::printf("%-24s", o.name.c_str());
    for (const Measured* m : {&o.emitted, &o.received, &o.absorbed}) print_cell(*m);
    std::printf("  %.4g%s\n", o.largest_albedo, o.creates_energy ? "  creates energy" : "");
  }
  std::printf("\n");
  print_total("emitted", audit.emitted, audit.emitted);
  print_total("  by media", audit.by_media, audit.emitted);
  print_total("  by the environment", audit.by_environment, audit.emitted);
  print_total("  by point lights", audit.by_point_lights, audit.emitted);
  print_total("absorbed by objects", audit.absorbed, audit.emitted);
  print_total("absorbed by media", audit.absorbed_by_media, audit.emitted);
  print_total("escaped", audit.escaped, audit.emitted);
  print_total("beyond the light's range", audit.beyond_range, audit.emitted);
  print_total("missing", audit.missing, audit.emitted);
}

int run_energy(const EnergyArguments& a) {
  auto document = open_document(a.scene);
  if (!document) return fail(document.error());
  if (a.seed >= 0) document->seed = static_cast<uint64_t>(a.seed);
  const auto scene = scene::compile(document->scene, document->camera, nullptr);
  const std::atomic<bool>& interrupted = watch_interrupts();
  const auto audit = render::audit_energy(*document, scene, a.paths, a.threads, [&] { return !interrupted.load(); });
  if (interrupted) return static_cast<int>(Fault::interrupted);
  if (!audit) return fail(input_error(a.scene.scene + ": " + audit.error().message));
  if (a.json)
    std::printf("%s\n", json_text(audit_json(document->scene_name, *audit), 2).c_str());
  else
    print(*audit);
  for (const std::string& warning : audit->warnings)
    std::fprintf(stderr, "etendue: %s: %s\n", a.scene.scene.c_str(), warning.c_str());
  return audit->warnings.empty() ? 0 : 1;
}

}  // namespace

Command energy_command() {
  const auto a = std::make_shared<EnergyArguments>();
  return {.name = "energy",
          .summary = "Where the light of a scene goes: emitted, absorbed and escaped flux by object",
          .options = {scene_option(a->scene.scene),
                      {.names = "--light-paths",
                       .target = &a->paths,
                       .doc = "Number of light paths (262144); the standard error falls with its square root",
                       .bounds = between(64, 2'000'000'000)},
                      set_option(a->scene.settings),
                      environment_option(a->scene.environment),
                      seed_option(a->seed),
                      threads_option(a->threads),
                      json_flag(a->json)},
          .run = [a] { return run_energy(*a); }};
}

}  // namespace etendue::cli
