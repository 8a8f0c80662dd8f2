#include "viewer/state/document_info.h"

#include <cctype>
#include <filesystem>

#include "integrator/integrator.h"
#include "render/document.h"
#include "scene/builtin/builtin.h"
#include "viewer/files/file_names.h"
#include "viewer/panels/object_names.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

// The label of a section that belongs to no object of the scene.
std::string settings_label(const std::string& section) {
  if (const auto* info = integrator::find_integrator(section)) return info->label;
  if (const auto* info = find_sampler(section)) return info->label;
  if (section == "auto") return "Automatic integrator";
  if (section == "film") return "Image";
  return label_of_name(section);
}

}  // namespace

std::string section_label(const render::Document& document, const std::string& section) {
  const scene::Scene& scene = *document.scene;
  const auto name = [&](const auto& objects, const char* kind) -> std::string {
    const auto index = object_index(section + ".", kind);
    const bool exists = index && static_cast<size_t>(*index) < objects.size();
    return exists ? objects[static_cast<size_t>(*index)].name : "";
  };
  std::string label = name(scene.materials, "material");
  if (label.empty()) label = name(scene.lights, "light");
  if (label.empty()) label = name(scene.nodes, "node");
  return label.empty() ? settings_label(section) : label;
}

bool same_view(const render::Document& a, const render::Document& b) {
  return a.scene == b.scene && a.camera == b.camera && a.width == b.width && a.height == b.height &&
         a.filter == b.filter && a.forced_flags == b.forced_flags && a.method.color == b.method.color;
}

std::optional<render::DocumentParameter> document_parameter(const render::Document& document, const std::string& name) {
  for (const auto& section : render::sections(document)) {
    if (!name.starts_with(section + ".")) continue;
    for (auto& parameter : render::section_parameters(document, section))
      if (parameter.info.name == name) return std::move(parameter);
  }
  return std::nullopt;
}

std::string full_label(const render::Document& document, const render::DocumentParameter& parameter) {
  const bool is_of_object = parameter.section.find('.') != std::string::npos;
  return parameter.info.label + (is_of_object ? " of " + section_label(document, parameter.section) : "");
}

std::string title_of(const render::Document& document, const std::string& session) {
  if (!session.empty()) return base_name(session);
  return document.scene_name == scene::kNewScene ? "New scene" : base_name(document.scene_name);
}

std::string method_spec(const render::MethodSettings& method) {
  std::string spec = method.integrator + ":sampler=" + method.sampler;
  for (const auto& [name, value] : method.settings) {
    const size_t dot = name.find('.');
    const std::string owner = name.substr(0, dot);
    if (owner == method.integrator || owner == method.sampler)
      spec += ":" + name.substr(dot + 1) + "=" + to_string(value);
  }
  return spec;
}

std::string short_method_name(const std::string& spec) {
  std::string text;
  for (const char c : spec) text += c == ':' ? ", " : std::string(1, c);
  const std::string sampler = "sampler=";
  if (const size_t at = text.find(sampler); at != std::string::npos) text.erase(at, sampler.size());
  const std::string denoised = "denoise=true";
  if (const size_t at = text.find(denoised); at != std::string::npos) text.replace(at, denoised.size(), "denoised");
  return text;
}

std::string method_label(const std::string& spec) {
  const std::string sampler_key = "sampler=";
  std::string text;
  for (size_t start = 0; start <= spec.size();) {
    const size_t end = std::min(spec.find(':', start), spec.size());
    std::string part = spec.substr(start, end - start);
    if (start == 0) {
      part = integrator_label(part);
    } else if (part.starts_with(sampler_key)) {
      part = part.substr(sampler_key.size());
      if (const auto* sampler = find_sampler(part)) part = sampler->label;
    } else if (part == "denoise=true") {
      part = "denoised";
    }
    text += (text.empty() ? "" : ", ") + part;
    start = end + 1;
  }
  return text;
}

std::string integrator_label(const std::string& name) {
  const auto* info = integrator::find_integrator(name);
  return info ? info->label : name;
}

LabelledMessage with_labels(const render::Document& document, const std::string& message) {
  if (message.empty()) return {};
  LabelledMessage labelled{.text = message};
  std::string& text = labelled.text;
  // The integrator of a comparison need not be that of the document.
  render::Document named = document;
  if (const std::string prefix = text.substr(0, text.find(": ")); integrator::find_integrator(prefix)) {
    text.replace(0, prefix.size(), integrator_label(prefix));
    named.method.integrator = prefix;
  }
  for (const std::string& section :
       {std::string("camera"), std::string("film"), std::string("render"), named.method.integrator})
    for (const auto& parameter : render::section_parameters(named, section)) {
      const std::string& name = parameter.info.name;
      const size_t at = text.find(name);
      if (at == std::string::npos) continue;
      // "camera.lens-radius" is no part of a longer name.
      const size_t end = at + name.size();
      if (end < text.size() && (std::isalnum(static_cast<unsigned char>(text[end])) || text[end] == '-')) continue;
      text.replace(at, name.size(), parameter.info.label);
      // The panels show the parameters of the chosen integrator only.
      if (named.method.integrator == document.method.integrator) labelled.parameters.push_back(name);
    }
  return labelled;
}

std::string scene_stem(const render::Document& document) {
  const std::string stem = std::filesystem::path(document.scene_name).stem().string();
  return stem.empty() ? "scene" : stem;
}

}  // namespace etendue::viewer
