// The state of a document as JSON text: the scene that it was opened from and all parameters that differ from it.
#include <nlohmann/json.hpp>
#include <optional>

#include "light/environments/uniform.h"
#include "render/document.h"

namespace etendue::render {
namespace {

using nlohmann::json;

constexpr int kVersion = 2;
// Recorded completely, because images are displayed without opening their scene.
constexpr const char* kDisplaySection = "display";

std::optional<Value> from_json(const json& j) {
  if (j.is_boolean()) return Value(j.get<bool>());
  if (j.is_number_integer()) return Value(j.get<int64_t>());
  if (j.is_number()) return Value(j.get<double>());
  if (j.is_string()) return Value(j.get<std::string>());
  return std::nullopt;
}

// A string member, or an empty string.
std::string text_member(const json& state, const char* name) {
  return state.contains(name) && state[name].is_string() ? state[name].get<std::string>() : "";
}

Error invalid_state(const std::string& source) {
  return input_error(source + ": the settings it carries are damaged; give an image that etendue wrote");
}

// In version 1 a scene without lights had a uniform environment, and no tone curve unless the state names one.
void restore_version_1(Document& document) {
  if (!document.lit_by_default) return;
  document.display = Display{};
  auto scene = std::make_shared<scene::Scene>(*document.scene);
  scene->environment = make_environment(kUniform);
  document.scene = std::move(scene);
}

}  // namespace

std::string state_json(const Document& document, uint32_t samples) {
  json settings = json::object();
  for (const auto& section : sections(document)) {
    const auto current = section_parameters(document, section);
    const auto original =
        document.origin ? section_parameters(*document.origin, section) : std::vector<DocumentParameter>{};
    for (size_t i = 0; i < current.size(); ++i)
      if (i >= original.size() || original[i].info.default_value != current[i].info.default_value ||
          section == kDisplaySection)
        settings[current[i].info.name] = to_json_value<json>(current[i].info.default_value);
  }
  json state{{"program", "etendue"},           {"version", kVersion}, {"scene", document.scene_name},
             {"camera", document.camera_name}, {"samples", samples},  {"settings", settings}};
  // The environment map of the scene's own file is loaded with the scene.
  const std::string& file = document.scene->environment.file;
  if (!file.empty() && !(document.origin && document.origin->scene->environment.file == file))
    state["environment"] = file;
  return state.dump();
}

Result<Document> document_from_state(const std::string& text, const std::string& source, uint32_t* samples) {
  const json state = json::parse(text, nullptr, false);
  if (!state.is_object() || text_member(state, "program") != "etendue" || !state.contains("scene") ||
      !state["scene"].is_string() || !state.contains("settings") || !state["settings"].is_object())
    return invalid_state(source);
  auto document = new_document(state["scene"].get<std::string>(), text_member(state, "camera"));
  if (!document) return document;
  if (!state.contains("version") || state["version"] == 1) restore_version_1(*document);
  if (state.contains("environment") && state["environment"].is_string()) {
    document = with_environment(*document, state["environment"].get<std::string>());
    if (!document) return document;
  }
  for (const auto& [name, j] : state["settings"].items()) {
    const auto value = from_json(j);
    if (!value) return invalid_state(source);
    auto changed = with(*document, name, *value);
    if (!changed) return input_error(source + ": " + changed.error().message);
    document = std::move(changed);
  }
  if (samples && state.contains("samples") && state["samples"].is_number_unsigned())
    *samples = state["samples"].get<uint32_t>();
  return document;
}

Display display_from_state(const std::string& text) {
  Display display;
  const json state = json::parse(text, nullptr, false);
  if (!state.is_object() || !state.contains("settings") || !state["settings"].is_object()) return display;
  const json& settings = state["settings"];
  if (settings.contains("camera.exposure") && settings["camera.exposure"].is_number())
    display.exposure = settings["camera.exposure"].get<float>();
  if (!settings.contains("display.curve")) return display;
  const auto& curves = Options<image::ToneCurve>::kOptions;
  for (size_t i = 0; i < curves.size(); ++i)
    if (settings["display.curve"] == curves[i].name) display.curve = static_cast<image::ToneCurve>(i);
  return display;
}

}  // namespace etendue::render
