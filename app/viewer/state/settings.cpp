#include "viewer/state/settings.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "base/json_text.h"
#include "base/user_folders.h"

namespace etendue::viewer {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr size_t kMaxRecent = 12;

int clamped(const json& number, int low, int high) {
  return static_cast<int>(std::clamp(number.get<double>(), static_cast<double>(low), static_cast<double>(high)));
}

Settings from_json(const json& j) {
  Settings s;
  s.window.width = clamped(j.at("window").at("width"), 320, 16384);
  s.window.height = clamped(j.at("window").at("height"), 240, 16384);
  s.window.maximised = j.at("window").at("maximised").get<bool>();
  s.column_width = std::clamp(j.at("column").get<float>(), 0.0f, 4096.0f);
  s.bottom_panel_height = std::clamp(j.value("drawer", 0.0f), 0.0f, 4096.0f);
  if (j.contains("pixel_values_offset")) {
    const json& offset = j["pixel_values_offset"];
    s.pixel_values_offset = glm::clamp(Vec2(offset.at(0).get<float>(), offset.at(1).get<float>()), Vec2(0), Vec2(16384));
  }
  s.dark = j.at("dark").get<bool>();
  s.recent = j.at("recent").get<std::vector<std::string>>();
  s.folder = j.at("folder").get<std::string>();
  if (const float scale = j.value("scale", 0.0f); scale > 0) s.ui_scale = std::clamp(scale, kMinScale, kMaxScale);
  s.font_size = std::clamp(j.value("font_size", s.font_size), kMinFontSize, kMaxFontSize);
  s.show_welcome = j.value("show_welcome", true);
  s.show_details = j.value("show_timing", false);
  s.automatic_integrator = j.value("automatic_integrator", true);
  s.threads = clamped(j.value("threads", json(0)), 0, kMaxThreads);
  s.environment = j.value("environment", "");
  s.snapshot_folder = j.value("snapshot_folder", "");
  s.snapshots_have_samples = j.value("snapshots_have_samples", true);
  for (const auto denoiser : {render::Denoiser::regression, render::Denoiser::open_image_denoise})
    if (j.value("denoiser", "") == render::name_of(denoiser)) s.denoiser = denoiser;
  s.material_folder = j.value("material_folder", "");
  s.scene_folder = j.value("scene_folder", "");
  s.environment_folder = j.value("environment_folder", "");
  if (j.contains("shortcuts")) s.shortcuts = j["shortcuts"].get<std::map<std::string, std::string>>();
  return s;
}

json to_json(const Settings& s) {
  json j{{"window", {{"width", s.window.width}, {"height", s.window.height}, {"maximised", s.window.maximised}}},
         {"column", s.column_width},
         {"drawer", s.bottom_panel_height},
         {"dark", s.dark},
         {"recent", s.recent},
         {"folder", s.folder},
         {"scale", s.ui_scale},
         {"font_size", s.font_size},
         {"show_welcome", s.show_welcome},
         {"show_timing", s.show_details},
         {"automatic_integrator", s.automatic_integrator},
         {"threads", s.threads},
         {"environment", s.environment},
         {"snapshot_folder", s.snapshot_folder},
         {"snapshots_have_samples", s.snapshots_have_samples},
         {"denoiser", render::name_of(s.denoiser)},
         {"material_folder", s.material_folder},
         {"scene_folder", s.scene_folder},
         {"environment_folder", s.environment_folder},
         {"shortcuts", s.shortcuts}};
  if (s.pixel_values_offset) j["pixel_values_offset"] = {s.pixel_values_offset->x, s.pixel_values_offset->y};
  return j;
}

}  // namespace

fs::path settings_file(const fs::path& folder) {
  const fs::path used = folder.empty() ? config_folder() : folder;
  return used.empty() ? used : used / "viewer.json";
}

fs::path recovery_folder(const fs::path& folder) {
  const fs::path used = folder.empty() ? state_folder() : folder;
  return used.empty() ? used : used / "recovery";
}

fs::path default_snapshot_folder() {
  if (const fs::path pictures = pictures_folder(); !pictures.empty()) return pictures / "etendue";
  const fs::path state = state_folder();
  return state.empty() ? state : state / "snapshots";
}

fs::path snapshot_folder(const Settings& settings) {
  return settings.snapshot_folder.empty() ? default_snapshot_folder() : fs::path(settings.snapshot_folder);
}

fs::path default_material_folder() {
  const fs::path data = data_folder();
  return data.empty() ? data : data / "materials";
}

Settings load_settings(const fs::path& file, std::string& note) {
  std::error_code code;
  if (file.empty() || !fs::exists(file, code)) return {};
  if (const auto bytes = read_file(file)) {
    const auto* text = reinterpret_cast<const char*>(bytes->data());
    const json j = json::parse(text, text + bytes->size(), nullptr, false);
    try {
      return from_json(j);
    } catch (const json::exception&) {
      // The file is renamed below.
    }
  }
  fs::path renamed = file;
  renamed += ".damaged";
  fs::rename(file, renamed, code);
  note = "The settings file could not be read. It was renamed to " + renamed.string() + "; defaults are used";
  return {};
}

bool save_settings(const fs::path& file, const Settings& settings) {
  if (file.empty()) return false;
  std::error_code code;
  fs::create_directories(file.parent_path(), code);
  const std::string text = json_text(to_json(settings), 2);
  return static_cast<bool>(write_file(file, text.data(), text.size()));
}

void remember_recent(Settings& settings, const std::string& file) {
  std::error_code code;
  const bool is_file = fs::exists(file, code);
  const std::string path = is_file ? fs::absolute(file, code).string() : file;
  std::erase(settings.recent, path);
  settings.recent.insert(settings.recent.begin(), path);
  if (settings.recent.size() > kMaxRecent) settings.recent.resize(kMaxRecent);
  if (is_file) settings.folder = fs::path(path).parent_path().string();
}

}  // namespace etendue::viewer
