#include "bench/method_spec.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "bench/alternatives.h"
#include "bench/external_renderer.h"
#include "bsdf/bsdf_model.h"
#include "render/incompatibility.h"

namespace etendue::bench {
namespace {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> list;
  size_t begin = 0;
  for (size_t end; (end = text.find(separator, begin)) != std::string::npos; begin = end + 1)
    list.push_back(text.substr(begin, end - begin));
  list.push_back(text.substr(begin));
  return list;
}

constexpr std::string_view kExternal = "external:";

// The parts between commas that are neither inside double quotes nor inside braces.
std::vector<std::string> split_outside_quotes(const std::string& text) {
  std::vector<std::string> list(1);
  bool is_quoted = false, is_alternative = false;
  for (const char c : text) {
    is_quoted ^= c == '"';
    if (c == '{' || c == '}') is_alternative = c == '{';
    if (c == ',' && !is_quoted && !is_alternative)
      list.emplace_back();
    else
      list.back() += c;
  }
  return list;
}

// Splits a list at its commas. Method names begin with a letter or a brace; a piece that does not continues the value in
// front of its comma, as in bdpt:without=1,*.
std::vector<std::string> split_methods(const std::string& list) {
  std::vector<std::string> methods;
  for (const std::string& piece : split_outside_quotes(list)) {
    const bool begins_method =
        piece.empty() || piece[0] == '{' || std::isalpha(static_cast<unsigned char>(piece[0])) != 0;
    if (begins_method || methods.empty())
      methods.push_back(piece);
    else
      methods.back() += ',' + piece;
  }
  return methods;
}

// True if both documents describe the same image, regardless of the method that renders it.
bool is_same_image(const render::Document& a, const render::Document& b) {
  return a.scene == b.scene && a.camera == b.camera && a.width == b.width && a.height == b.height && a.seed == b.seed &&
         a.limits == b.limits && a.display == b.display;
}

// Whether a parameter of the scene only selects how the image is estimated.
bool is_estimator_of_scene(std::string_view name) { return name.ends_with(".medium-transmittance"); }

bool has_diffusion_profile(std::string_view model) {
  const auto made = make_bsdf_model(model);
  return made && !is_black(made->subsurface().mean_free_path);
}

// Whether a setting approximates a scattering body by a diffusion profile: the model of a material or one of its
// parameters. The error of the method then includes the difference from the body of the scene.
bool is_diffusion_profile(std::string_view name, std::string_view value) {
  if (!name.starts_with("material.")) return false;
  if (name.ends_with(".model")) return has_diffusion_profile(value);
  return std::ranges::any_of(bsdf_model_infos(), [&](const BsdfModelInfo& info) {
    const std::string section = "." + std::string(info.description.name) + ".";
    return name.find(section) != std::string_view::npos && has_diffusion_profile(info.description.name);
  });
}

Error method_error(const std::string& method, const std::string& why) {
  return usage_error("--methods: '" + method + "': " + why);
}

struct Assignment {
  std::string name, value;
};

// The integrator and the sampler come first, because they determine which parameter names exist.
Result<std::vector<Assignment>> assignments_of(const std::string& method) {
  const auto parts = split(method, ':');
  if (parts[0].empty()) return method_error(method, "the integrator is missing; give integrator[:name=value]...");
  std::vector<Assignment> list{{"render.integrator", parts[0]}};
  for (size_t i = 1; i < parts.size(); ++i) {
    const size_t equals = parts[i].find('=');
    if (equals == std::string::npos) return method_error(method, "'" + parts[i] + "' has no '='; give name=value");
    std::string name = parts[i].substr(0, equals), value = parts[i].substr(equals + 1);
    if (parts[0] == render::kAutomatic && (name == "allow" || name == "error")) name = "auto." + name;
    if (name == "sampler" || name == "render.sampler")
      list.insert(list.begin() + 1, {"render.sampler", value});
    else
      list.push_back({name, value});
  }
  return list;
}

Result<MethodSpec> parse_external(const std::string& text, const render::Document& base) {
  std::string command = text.substr(kExternal.size());
  if (command.size() >= 2 && command.front() == '"' && command.back() == '"')
    command = command.substr(1, command.size() - 2);
  if (auto ok = check_external_command(command); !ok) return method_error(text, ok.error().message);
  return MethodSpec{.name = text, .document = base, .command = command};
}

// An integrator with its settings, or the automatic choice.
Result<MethodSpec> parse_integrator(const std::string& text, const render::Document& base) {
  const auto assignments = assignments_of(text);
  if (!assignments) return assignments.error();
  MethodSpec method{.name = text, .document = base};
  render::Document image = base;
  for (const auto& [name, value] : *assignments) {
    if (name == "denoise") {
      if (value == "false") continue;
      const auto denoiser = render::denoiser_named(value == "true" ? "auto" : value);
      if (!denoiser) return method_error(text, "denoise: " + denoiser.error().message + ", true or false");
      method.denoiser = *denoiser;
      continue;
    }
    auto changed = render::with_text(method.document, name, value);
    if (!changed) return method_error(text, changed.error().message);
    method.document = std::move(*changed);
    if (is_estimator_of_scene(name) || is_diffusion_profile(name, value)) image.scene = method.document.scene;
    if (!is_same_image(method.document, image))
      return method_error(text, "'" + name + "' changes the image, not the method; set it for all methods with --set");
  }
  const render::MethodSettings& settings = method.document.method;
  if (settings.adaptive != base.method.adaptive && settings.adaptive != render::Adaptive::off)
    if (const std::string incompatibility = render::adaptive_incompatibility(settings.integrator);
        !incompatibility.empty())
      return method_error(text, incompatibility);
  return method;
}

}  // namespace

std::string MethodSpec::label() const {
  if (!is_external()) return name;
  return std::filesystem::path(command.substr(0, command.find(' '))).stem().string();
}

Result<MethodSpec> parse_method(const std::string& text, const render::Document& base) {
  auto method = parse_integrator(text, base);
  if (method && method->is_automatic())
    return method_error(text, "the automatic choice is not a single method; give the integrator");
  return method;
}

Result<std::vector<MethodSpec>> parse_methods(const std::string& list, const render::Document& base) {
  std::vector<std::string> texts;
  for (const auto& text : split_methods(list)) {
    if (text.starts_with(kExternal)) {
      texts.push_back(text);
      continue;
    }
    const auto alternatives = expand_alternatives(text);
    if (!alternatives) return usage_error("--methods: " + alternatives.error().message);
    texts.insert(texts.end(), alternatives->begin(), alternatives->end());
  }
  std::vector<MethodSpec> methods;
  for (const auto& text : texts) {
    if (text.empty()) continue;
    auto method = text.starts_with(kExternal) ? parse_external(text, base) : parse_integrator(text, base);
    if (!method) return method.error();
    if (std::ranges::any_of(methods, [&](const MethodSpec& m) { return m.name == text; }))
      return method_error(text, "the method is given twice");
    methods.push_back(std::move(*method));
  }
  if (methods.empty())
    return usage_error("--methods: the list is empty; give methods like path:sampler=sobol,path-pure");
  return methods;
}

}  // namespace etendue::bench
