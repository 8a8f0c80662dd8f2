// The state of a document as text: the scene it starts from and every setting that differs from the start.
#include <nlohmann/json.hpp>

#include "render/document.h"

namespace etendue::render {
namespace {

using nlohmann::json;

json to_json(const Value& value) {
  return std::visit([](const auto& v) { return json(v); }, value);
}

bool from_json(const json& j, Value& value) {
  if (j.is_boolean()) return value = j.get<bool>(), true;
  if (j.is_number_integer()) return value = j.get<int64_t>(), true;
  if (j.is_number()) return value = j.get<double>(), true;
  if (j.is_string()) return value = j.get<std::string>(), true;
  return false;
}

constexpr const char* kWrong = ": its state is not what this program writes; give a snapshot of this program";

}  // namespace

std::string state_json(const Document& document, uint32_t samples) {
  json settings = json::object();
  for (const auto& section : sections(document)) {
    const auto now = section_parameters(document, section);
    const auto before =
        document.origin ? section_parameters(*document.origin, section) : std::vector<DocumentParameter>{};
    for (size_t i = 0; i < now.size(); ++i)
      if (i >= before.size() || before[i].info.default_value != now[i].info.default_value)
        settings[now[i].info.name] = to_json(now[i].info.default_value);
  }
  json state{{"program", "etendue"},           {"version", 1},       {"scene", document.scene_name},
             {"camera", document.camera_name}, {"samples", samples}, {"settings", settings}};
  // A scene may bring its own along.
  const std::string& file = document.scene->environment.file;
  if (!file.empty() && !(document.origin && document.origin->scene->environment.file == file))
    state["environment"] = file;
  return state.dump();
}

Result<Document> document_from_state(const std::string& text, const std::string& source, uint32_t* samples) {
  const json state = json::parse(text, nullptr, false);
  if (!state.is_object() || state.value("program", "") != "etendue" || !state.contains("scene") ||
      !state["scene"].is_string() || !state.contains("settings") || !state["settings"].is_object())
    return input_error(source + kWrong);
  auto document =
      new_document(state["scene"].get<std::string>(),
                   state.contains("camera") && state["camera"].is_string() ? state["camera"].get<std::string>() : "");
  if (!document) return document;
  if (state.contains("environment") && state["environment"].is_string()) {
    document = with_environment(*document, state["environment"].get<std::string>());
    if (!document) return document;
  }
  for (const auto& [name, j] : state["settings"].items()) {
    Value value;
    if (!from_json(j, value)) return input_error(source + kWrong);
    auto changed = with(*document, name, value);
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
