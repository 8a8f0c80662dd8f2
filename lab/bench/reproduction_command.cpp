#include "bench/reproduction_command.h"

#include <set>

#include "bench/shell_command.h"
#include "metrics/log_axis.h"

namespace etendue::bench {
namespace {

std::string option(const char* name, const std::string& value) {
  return std::string(" ") + name + " " + shell_quoted(value);
}

// Options for the settings that differ from those of the scene file. Size, seed and limits have separate options.
std::string changed_settings(const render::Document& d) {
  static const std::set<std::string> kSeparateOptions{"film.width",          "film.height",    "render.seed",
                                                      "render.samples",      "render.seconds", "render.error",
                                                      "render.error-measure"};
  if (!d.origin) return "";
  std::string text;
  for (const auto& section : render::sections(d)) {
    const auto current = render::section_parameters(d, section),
               original = render::section_parameters(*d.origin, section);
    for (size_t i = 0; i < current.size(); ++i) {
      const ParameterInfo& info = current[i].info;
      const bool is_same = i < original.size() && original[i].info.default_value == info.default_value;
      if (!is_same && !kSeparateOptions.contains(info.name))
        text += option("--set", info.name + "=" + to_string(info.default_value));
    }
  }
  return text;
}

std::string environment_option(const render::Document& d) {
  const std::string& file = d.scene->environment.file;
  const bool is_changed = d.origin && d.origin->scene->environment.file != file;
  return is_changed && !file.empty() ? option("--env", file) : "";
}

}  // namespace

std::string reproduction_command(const Report& r) {
  const render::Document& d = r.document;
  std::string methods;
  for (const MethodSpec& m : r.plan.methods) methods += (methods.empty() ? "" : ",") + m.name;
  std::string text = "etendue bench " + shell_quoted(d.scene_name) + option("--methods", methods) +
                     option("--size", std::to_string(d.width) + "x" + std::to_string(d.height));
  if (r.plan.seconds > 0) text += option("--budget", metrics::short_number(r.plan.seconds));
  if (r.plan.samples > 0) text += option("--samples", std::to_string(r.plan.samples));
  text += option("--repeats", std::to_string(r.plan.repeats)) + option("--seed", std::to_string(r.plan.seed)) +
          option("--threads", std::to_string(r.threads));
  if (r.measure != film::ErrorMeasure::rmse)
    text += option("--error-measure", Options<film::ErrorMeasure>::kOptions[static_cast<size_t>(r.measure)].name);
  if (!d.camera_name.empty()) text += option("--camera", d.camera_name);
  text += environment_option(d) + changed_settings(d);
  // A reference without a sample count was read from a file.
  if (r.reference.samples == 0)
    text += option("--reference", r.reference.file);
  else
    text += option("--reference-samples", std::to_string(r.reference.samples));
  return text + " --out bench";
}

}  // namespace etendue::bench
