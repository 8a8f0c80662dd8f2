// The settings file of the viewer. Whatever it contains, the settings are in range, and they can be stored and read again.
#include "viewer/state/settings.h"

#include <unistd.h>

#include "base/file.h"
#include "integration/fuzz/json_mutation.h"
#include "viewer/platform/input.h"

namespace etendue::fuzz {
namespace {

namespace fs = std::filesystem;

// The file is renamed if it cannot be read, so it is a real one.
const fs::path& settings_file() {
  static const fs::path file = fs::temp_directory_path() / ("etendue-fuzz-" + std::to_string(::getpid()) + ".json");
  return file;
}

void remove_files() {
  std::error_code code;
  fs::remove(settings_file(), code);
  fs::remove(settings_file().string() + ".damaged", code);
}

void read_settings(Input input) {
  require(static_cast<bool>(write_file(settings_file(), input.data(), input.size())), "the input cannot be written");
  std::string note;
  const viewer::Settings settings = viewer::load_settings(settings_file(), note);
  require(note.empty() == fs::exists(settings_file()), "a damaged file is not renamed");
  require(settings.window.width >= 320 && settings.window.width <= 16384, "a width is out of range");
  require(settings.window.height >= 240 && settings.window.height <= 16384, "a height is out of range");
  require(settings.column_width >= 0 && settings.column_width <= 4096, "the width of the column is out of range");
  require(settings.ui_scale == 0 || (settings.ui_scale >= viewer::kMinScale && settings.ui_scale <= viewer::kMaxScale),
          "a scale is out of range");
  require(settings.font_size >= viewer::kMinFontSize && settings.font_size <= viewer::kMaxFontSize,
          "a font size is out of range");
  require(settings.threads >= 0 && settings.threads <= viewer::kMaxThreads, "a number of threads is out of range");
  for (const auto& [action, shortcut] : settings.shortcuts) (void)viewer::parse_chord(shortcut);
  require(viewer::save_settings(settings_file(), settings), "settings cannot be stored");
  note.clear();
  (void)viewer::load_settings(settings_file(), note);
  require(note.empty(), "stored settings cannot be read");
  remove_files();
}

std::vector<Bytes> files() {
  viewer::Settings settings;
  settings.recent = {"cornell", "/home/a b/\u00e9.glb"};
  settings.folder = "/tmp";
  settings.ui_scale = 1.25f;
  settings.threads = 3;
  settings.environment = "sunset";
  settings.denoiser = render::Denoiser::regression;
  settings.snapshots_have_samples = false;
  settings.shortcuts = {{"file.open", "ctrl+j"}, {"view.fit", "f2 shift+f3"}};
  std::vector<Bytes> seeds;
  for (const viewer::Settings& stored : {viewer::Settings(), settings}) {
    require(viewer::save_settings(settings_file(), stored), "a seed cannot be written");
    const auto bytes = read_file(settings_file());
    require(static_cast<bool>(bytes), "a seed cannot be read");
    seeds.push_back(*bytes);
  }
  remove_files();
  return seeds;
}

}  // namespace

const Target kTarget{.run = read_settings, .seeds = files, .mutate = change_json_text};

}  // namespace etendue::fuzz
