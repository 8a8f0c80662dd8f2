// etendue phase: measures normalisation, mean cosine and sampling of a phase function.
#include <cstdio>
#include <filesystem>
#include <memory>

#include "base/file.h"
#include "bsdf_analysis/drawings.h"
#include "bsdf_analysis/phase_analysis.h"
#include "command.h"
#include "json.h"
#include "scene_options.h"
#include "subjects.h"

namespace etendue::cli {
namespace {

struct PhaseArguments {
  std::string name, against, out;
  std::vector<std::string> settings, settings_against;
  bool json = false;
};

struct Subject {
  std::string name;
  std::shared_ptr<const PhaseFunction> phase;
  bsdf_analysis::PhaseAnalysis analysis;
};

Result<std::shared_ptr<const PhaseFunction>> with_setting(std::shared_ptr<const PhaseFunction> phase,
                                                          const std::string& text) {
  const auto setting = split_setting(text);
  if (!setting) return setting.error();
  const std::string owner = phase->info().description.name;
  const ParameterInfo* info = find_parameter(phase->info().parameters, setting->name);
  if (!info) return usage_error("the phase function '" + owner + "' has no parameter '" + setting->name + "'");
  const auto value = parse_value(*info, setting->value);
  if (!value) return value.error();
  return phase->with(setting->name, *value);
}

Result<Subject> make_subject(const std::string& name, const std::vector<std::string>& settings) {
  auto phase = make_phase_function(name, {});
  if (!phase) return phase.error();
  for (const std::string& setting : settings) {
    phase = with_setting(*phase, setting);
    if (!phase) return phase.error();
  }
  return Subject{name, *phase, bsdf_analysis::analyze(**phase)};
}

json subject_json(const Subject& s) {
  json parameters = json::object(), checks = json::object();
  for (const auto& p : s.phase->parameters()) parameters[p.name] = to_json_value<json>(p.default_value);
  for (const auto& check : s.analysis.checks) checks[check.name] = {{"holds", check.holds}, {"reason", check.reason}};
  return {{"phase_function", s.name},
          {"parameters", parameters},
          {"checks", checks},
          {"integral", number_json(s.analysis.integral)},
          {"mean_cosine", number_json(s.analysis.mean_cosine)},
          {"stated_mean_cosine", number_json(s.analysis.stated_mean_cosine)},
          {"backward", number_json(s.analysis.backward)},
          {"minimum", number_json(s.analysis.minimum)},
          {"maximum", number_json(s.analysis.maximum)},
          {"sampling_deviation", number_json(s.analysis.sampling_deviation)}};
}

void print(const Subject& s) {
  std::printf("%s\n", s.name.c_str());
  for (const auto& check : s.analysis.checks) std::printf("  %s: %s\n", check.label(), check.reason.c_str());
  std::printf("  scattered backward: %.1f %%\n", 100 * s.analysis.backward);
}

// Polar plot; light propagates upwards. Lengths are fourth roots, which makes the surroundings of a peak visible.
Result<void> write_drawing(const std::vector<Subject>& subjects, const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return output_error(folder + ": the folder cannot be created: " + error.message());
  std::vector<bsdf_analysis::Slice> slices;
  std::vector<std::string> names;
  for (const auto& s : subjects) {
    slices.push_back(bsdf_analysis::phase_slice(*s.phase));
    names.push_back(s.name);
  }
  bsdf_analysis::DrawingOptions options;
  options.height = 480;
  options.length_scale = bsdf_analysis::LengthScale::root;
  options.title = "Phase functions around the direction of propagation, which is up; lengths are fourth roots";
  const std::string svg = metrics::to_svg(bsdf_analysis::polar_drawing(slices, names, options));
  return write_file(std::filesystem::path(folder) / "phase.svg", svg.data(), svg.size());
}

int run_phase(const PhaseArguments& a) {
  const auto made = make_subjects<Subject>({a.name, a.settings}, {a.against, a.settings_against},
                                           [](const NamedSettings& s) { return make_subject(s.name, s.settings); });
  if (!made) return fail(made.error());
  const std::vector<Subject>& subjects = *made;
  if (!a.out.empty())
    if (const auto ok = write_drawing(subjects, a.out); !ok) return fail(ok.error());
  if (a.json) return print_json_of(subjects, subject_json);
  for (const auto& s : subjects) print(s);
  return 0;
}

}  // namespace

Command phase_command() {
  const auto a = std::make_shared<PhaseArguments>();
  return {.name = "phase",
          .summary = "Analyse a phase function: normalisation, mean cosine, sampling",
          .options = {{.names = "name",
                       .target = &a->name,
                       .doc = "A phase function; see etendue list phase-functions",
                       .required = true},
                      {.names = "--set", .target = &a->settings, .doc = "NAME=VALUE: sets a parameter; may be repeated"},
                      {.names = "--against", .target = &a->against, .doc = "A second phase function for comparison"},
                      {.names = "--set-against",
                       .target = &a->settings_against,
                       .doc = "NAME=VALUE: sets a parameter of the second one; may be repeated"},
                      {.names = "--out", .target = &a->out, .doc = "Folder for the drawing phase.svg"},
                      json_flag(a->json)},
          .run = [a] { return run_phase(*a); }};
}

}  // namespace etendue::cli
