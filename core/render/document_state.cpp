// The state of a document as JSON text: the scene that it was opened from and all parameters that differ from it.
#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/json_text.h"
#include "base/provided_files.h"
#include "light/environments/uniform.h"
#include "render/default_light.h"
#include "render/document.h"
#include "render/setting_order.h"
#include "render/state_opener.h"
#include "render/structure_json.h"

namespace etendue::render {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr int kVersion = 3;
// Recorded completely, because images are displayed without opening their scene.
constexpr const char* kDisplaySection = "display";
constexpr const char* kEnvironmentSection = "environment";

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
  return input_error(source + ": its settings are damaged; give an image or a session that etendue wrote");
}

// The file that a state in the file `source` refers to. A relative path may start at the folder of that file.
std::string resolved(const std::string& file, const std::string& source) {
  const fs::path beside = fs::path(source).parent_path() / file;
  std::error_code code;
  return !provided_file(file) && !fs::exists(file, code) && fs::exists(beside, code) ? beside.string() : file;
}

// How a state in `folder` refers to a file: by a path relative to the folder if the file is in it or below, otherwise
// by an absolute path. Names that are not files, and all names if `folder` is empty, stay as they are.
std::string reference_from(const std::string& folder, const std::string& file) {
  std::error_code code;
  if (folder.empty() || !fs::is_regular_file(file, code)) return file;
  const fs::path path = fs::absolute(file, code).lexically_normal();
  const fs::path relative = path.lexically_relative(fs::absolute(folder, code).lexically_normal());
  const bool is_below = !relative.empty() && *relative.begin() != "..";
  return (is_below ? relative : path).string();
}

// The current values of a section by name.
std::map<std::string, Value> values_of(const Document& document, const std::string& section) {
  std::map<std::string, Value> values;
  for (const auto& parameter : section_parameters(document, section))
    values[parameter.info.name] = parameter.info.default_value;
  return values;
}

// Whether the values of a section can differ between two documents. Comparing the nodes and materials of large scenes is
// much faster than comparing the values of their sections.
bool may_differ(const Document& a, const Document& b, const std::string& section) {
  const auto& materials = a.scene->materials;
  if (const auto material = section_index(section, "material", materials.size()))
    return *material >= b.scene->materials.size() || materials[*material] != b.scene->materials[*material];
  const auto& nodes = a.scene->nodes;
  const auto node = section_index(section, "node", nodes.size());
  return !node || *node >= b.scene->nodes.size() || nodes[*node] != b.scene->nodes[*node];
}

// Whether a parameter decides which other parameters its section has.
bool selects_parameters(const std::string& name) {
  const SettingKind kind = kind_of_setting(name);
  return kind == SettingKind::model || kind == SettingKind::selection;
}

// Applies the settings of a kind.
Result<Document> with_settings(Document document, const json& settings, SettingKind kind, const std::string& source) {
  for (const auto& [name, j] : settings.items()) {
    if (kind_of_setting(name) != kind) continue;
    const auto value = from_json(j);
    if (!value) return invalid_state(source);
    auto changed = with(document, name, *value);
    if (!changed) return input_error(source + ": " + changed.error().message);
    document = std::move(*changed);
  }
  return document;
}

// The document as it was opened, with the objects of this one.
std::shared_ptr<const Document> origin_with_structure(const Document& document) {
  if (!document.origin || document.structure.empty()) return document.origin;
  auto scene = scene::with_edits(*document.origin->scene, document.structure);
  if (!scene) return document.origin;
  auto origin = std::make_shared<Document>(*document.origin);
  origin->scene = std::make_shared<const scene::Scene>(std::move(*scene));
  return origin;
}

// The camera by which the file is opened again. A camera that was added is not in the file; its values are settings.
std::string camera_of_file(const Document& document) {
  if (!document.origin || document.structure.empty()) return document.camera_name;
  return scene::choose_camera(*document.origin->scene, document.camera_name) ? document.camera_name
                                                                             : document.origin->camera_name;
}

// Applies the structural edits.
Result<void> restore_structure(Document& document, const json& state, const std::string& source) {
  if (!state.contains("structure")) return {};
  auto edits = structure_from_json(state["structure"], [&](const std::string& f) { return resolved(f, source); });
  if (!edits) return input_error(source + ": " + edits.error().message);
  // A texture whose file cannot be read stays without an image, with a warning of the scene.
  for (scene::StructuralEdit& edit : *edits) (void)scene::read_image(edit);
  auto scene = scene::with_edits(*document.scene, *edits);
  if (!scene) return input_error(source + ": " + scene.error().message);
  document.scene = std::make_shared<const scene::Scene>(std::move(*scene));
  document.structure = std::move(*edits);
  return {};
}

// The method that was chosen automatically, and why.
json automatic_json(const Document& document) {
  return {{"integrator", document.method.integrator}, {"reason", document.automatic.reason}};
}

json part_json(const RenderPart& part) {
  json j{{"first_sample", part.first_sample}};
  if (part.region) j["region"] = {part.region->x, part.region->y, part.region->width, part.region->height};
  return j;
}

// The method of a state that was chosen automatically is used again. Nothing if the state has none.
Result<void> restore_automatic(Document& document, const json& state, const std::string& source) {
  if (!document.automatic.enabled || !state.contains("automatic")) return {};
  const json& automatic = state["automatic"];
  if (!automatic.is_object() || text_member(automatic, "reason").empty()) return invalid_state(source);
  auto chosen = with(document, "render.integrator", Value(text_member(automatic, "integrator")));
  if (!chosen) return input_error(source + ": " + chosen.error().message);
  if (chosen->automatic.enabled) return invalid_state(source);
  document.method.integrator = chosen->method.integrator;
  document.automatic.reason = text_member(automatic, "reason");
  return {};
}

// The defaults of scenes without lights in earlier versions. The environment was visible. In version 1 it was uniform,
// and there was no tone curve unless the state names one.
void restore_defaults(Document& document, int version) {
  if (!document.lit_by_default) return;
  const bool is_uniform = version == 1;
  if (is_uniform) document.display = Display{};
  auto scene = std::make_shared<scene::Scene>(*document.scene);
  scene->environment = make_environment(is_uniform ? kUniform : builtin_environments().front());
  document.scene = std::move(scene);
}

Result<json> parsed(const std::string& text, const std::string& source) {
  json state = json::parse(text, nullptr, false);
  if (!state.is_object() || text_member(state, "program") != "etendue" || !state.contains("scene") ||
      !state["scene"].is_string() || !state.contains("settings") || !state["settings"].is_object())
    return invalid_state(source);
  return state;
}

// States name the visibility of an environment only if it differs from that of the scene as it was opened.
Result<Document> with_environment_of_state(const Document& document, const std::string& file) {
  const bool visible = document.scene->environment.visible;
  auto changed = with_environment(document, file);
  return changed ? with(*changed, "environment.visible", Value(visible)) : changed;
}

// The document of the scene, the camera and the environment that a state names, with their own settings.
Result<Document> opened_document(const json& state, const std::string& source) {
  auto document = new_document(resolved(state["scene"].get<std::string>(), source), text_member(state, "camera"));
  if (!document) return document;
  const int version =
      state.contains("version") && state["version"].is_number_integer() ? state["version"].get<int>() : 1;
  if (version < kVersion) restore_defaults(*document, version);
  if (state.contains("environment") && state["environment"].is_string())
    document = with_environment_of_state(*document, resolved(state["environment"].get<std::string>(), source));
  return document;
}

// The members of a state on which `opened_document` depends.
std::string scene_text_of(const json& state) {
  json members = json::object();
  for (const char* name : {"scene", "camera", "environment", "version"})
    if (state.contains(name)) members[name] = state[name];
  return json_text(members);
}

// An opened document with the edits of a state.
Result<Document> with_state(Document document, const json& state, const std::string& source) {
  if (auto ok = restore_structure(document, state, source); !ok) return ok.error();
  for (const SettingKind kind : kSettingKinds) {
    auto changed = with_settings(std::move(document), state["settings"], kind, source);
    if (!changed) return changed;
    document = std::move(*changed);
  }
  if (auto ok = restore_automatic(document, state, source); !ok) return ok.error();
  return document;
}

// The first setting in which a document differs from a state; empty if there is none.
std::string different_setting(const Document& document, const json& state) {
  const json settings = json::parse(state_json(document, 0))["settings"];
  const json& expected = state["settings"];
  for (const auto& [name, value] : expected.items())
    if (!settings.contains(name) || settings[name] != value) return name;
  for (const auto& [name, value] : settings.items())
    if (!expected.contains(name)) return name;
  return "";
}

// The settings in which two states differ, if the document of `to` is that of `from` with these settings. Null
// otherwise: other members differ, a setting has its original value again, or one differs that affects others.
json changed_settings(const json& from, const json& to) {
  if (!from.is_object() || from.size() != to.size()) return {};
  for (const auto& [name, value] : from.items())
    if (name != "settings" && (!to.contains(name) || to[name] != value)) return {};
  const json &before = from["settings"], &after = to["settings"];
  for (const auto& [name, value] : before.items())
    if (!after.contains(name)) return {};
  json changes = json::object();
  for (const auto& [name, value] : after.items()) {
    if (before.contains(name) && before[name] == value) continue;
    if (kind_of_setting(name) != SettingKind::value) return {};
    changes[name] = value;
  }
  return changes;
}

}  // namespace

std::string state_json(const Document& document, uint32_t samples, const std::string& folder) {
  json settings = json::object();
  const auto origin = origin_with_structure(document);
  for (const auto& section : sections(document)) {
    if (origin && !may_differ(document, *origin, section)) continue;
    const auto original = origin ? values_of(*origin, section) : std::map<std::string, Value>();
    const auto values = values_of(document, section);
    const auto is_changed = [&](const auto& setting) {
      const auto found = original.find(setting.first);
      return found == original.end() || found->second != setting.second;
    };
    // Selecting an environment changes its other parameters, so all of them are recorded then.
    const bool is_complete = section == kDisplaySection ||
                             (section == kEnvironmentSection && std::ranges::any_of(values, [&](const auto& setting) {
                                return selects_parameters(setting.first) && is_changed(setting);
                              }));
    for (const auto& setting : values)
      if (is_complete || is_changed(setting)) settings[setting.first] = to_json_value<json>(setting.second);
  }
  json state{{"program", "etendue"},
             {"version", kVersion},
             {"scene", reference_from(folder, document.scene_name)},
             {"camera", camera_of_file(document)},
             {"samples", samples},
             {"settings", settings}};
  if (!document.structure.empty())
    state["structure"] =
        structure_json(document.structure, [&](const std::string& file) { return reference_from(folder, file); });
  if (!document.part.is_whole()) state["part"] = part_json(document.part);
  if (document.automatic.enabled && !document.automatic.is_pending()) state["automatic"] = automatic_json(document);
  // The environment map of the scene's own file is loaded with the scene.
  const std::string& file = document.scene->environment.file;
  if (!file.empty() && !(document.origin && document.origin->scene->environment.file == file))
    state["environment"] = reference_from(folder, file);
  return json_text(state);
}

Result<Document> document_from_state(const std::string& text, const std::string& source, uint32_t* samples) {
  const auto state = parsed(text, source);
  if (!state) return state.error();
  const auto opened = opened_document(*state, source);
  if (!opened) return opened;
  auto document = with_state(*opened, *state, source);
  if (!document) return document;
  if (samples && state->contains("samples") && (*state)["samples"].is_number_unsigned())
    *samples = (*state)["samples"].get<uint32_t>();
  return document;
}

struct StateOpener::Opened {
  std::string name;   // of the scene, the camera and the environment
  Document document;  // without edits
  json state;         // the state that was opened last, and its document
  Document latest;
};

StateOpener::StateOpener() = default;
StateOpener::~StateOpener() = default;

Result<Document> StateOpener::open(const std::string& text, const std::string& source) {
  auto state = parsed(text, source);
  if (!state) return state.error();
  const std::string name = scene_text_of(*state);
  is_reopened_ = !opened_ || opened_->name != name;
  if (is_reopened_) {
    opened_.reset();  // frees the memory of the old scene first
    auto document = opened_document(*state, source);
    if (!document) return document;
    opened_ = std::make_unique<Opened>(name, std::move(*document), json(), Document());
  }
  Result<Document> document = Document();
  const json changes = changed_settings(opened_->state, *state);
  if (!changes.is_null()) document = with_settings(opened_->latest, changes, SettingKind::value, source);
  if (changes.is_null() || !document || !different_setting(*document, *state).empty())
    document = with_state(opened_->document, *state, source);
  if (!document) return document;
  if (const std::string setting = different_setting(*document, *state); !setting.empty())
    return input_error(source + ": the setting " + setting + " cannot be applied to " + opened_->document.scene_name);
  opened_->state = std::move(*state);
  opened_->latest = *document;
  return document;
}

const Document& StateOpener::opened() const { return opened_->document; }

RenderPart part_from_state(const std::string& text) {
  RenderPart part;
  const json state = json::parse(text, nullptr, false);
  if (!state.is_object() || !state.contains("part") || !state["part"].is_object()) return part;
  const json& j = state["part"];
  if (j.contains("first_sample") && j["first_sample"].is_number_unsigned())
    part.first_sample = j["first_sample"].get<uint32_t>();
  const auto is_integer = [](const json& v) { return v.is_number_integer(); };
  if (j.contains("region") && j["region"].is_array() && j["region"].size() == 4 &&
      std::ranges::all_of(j["region"], is_integer))
    part.region = {j["region"][0].get<int>(), j["region"][1].get<int>(), j["region"][2].get<int>(),
                   j["region"][3].get<int>()};
  return part;
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
