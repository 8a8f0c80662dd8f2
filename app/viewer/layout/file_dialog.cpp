#include "viewer/layout/file_dialog.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <utility>

#include "base/number_text.h"
#include "viewer/files/file_names.h"
#include "viewer/platform/platform.h"
#include "viewer/state/app_state.h"
#include "viewer/tasks/file_thumbnails.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/dialog.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace fs = std::filesystem;
namespace {

constexpr float kPlacesWidth = 10, kPreviewWidth = 12, kFormatWidth = 14;  // font sizes

int64_t change_time(const fs::directory_entry& entry) {
  std::error_code code;
  const auto time = entry.last_write_time(code);
  if (code) return 0;
  const auto system = std::chrono::file_clock::to_sys(time);
  return std::chrono::duration_cast<std::chrono::seconds>(system.time_since_epoch()).count();
}

}  // namespace

void FileDialog::open(const AppState& state) {
  const FileRequest& request = *state.files.request;
  std::error_code code;
  const bool has_folder = fs::is_directory(request.folder, code);
  const fs::path folder = has_folder ? request.folder : state.settings.folder;
  saves_ = request.saves;
  extensions_ = request.extensions;
  formats_ = request.formats;
  filter_.clear();
  enter_folder(fs::is_directory(folder, code) ? folder : fs::current_path(code));
  find_places(state);
  name_ = request.name;
  replaced_file_.clear();
  is_open_ = true;
}

void FileDialog::enter_folder(const fs::path& folder) {
  folder_ = folder.lexically_normal();
  if (!saves_) name_.clear();
  read_folder();
}

void FileDialog::read_folder() {
  entries_.clear();
  problem_.clear();
  std::error_code code;
  fs::directory_iterator entry(folder_, fs::directory_options::skip_permission_denied, code);
  for (; !code && entry != fs::directory_iterator(); entry.increment(code)) {
    const std::string name = entry->path().filename().string();
    std::error_code ignored;
    const bool is_folder = entry->is_directory(ignored);
    const bool is_suitable = std::ranges::find(extensions_, lower_extension(name)) != extensions_.end();
    if (name.starts_with('.') || (!is_folder && !is_suitable)) continue;
    const uintmax_t bytes = is_folder ? 0 : entry->file_size(ignored);
    entries_.push_back({name, is_folder, ignored ? 0 : bytes, change_time(*entry)});
  }
  if (code) problem_ = folder_.string() + ": " + code.message();
  sort_entries();
  has_new_entries_ = true;
}

void FileDialog::add_glyphs(AppState& state) {
  if (!std::exchange(has_new_entries_, false)) return;
  GlyphSet& glyphs = state.ui.glyphs;
  glyphs.add(folder_.string());
  for (const Place& place : places_) glyphs.add(place.label);
  for (const Entry& entry : entries_) glyphs.add(entry.name);
}

// Home, the folder in which the program was started, and the folders of recent files.
void FileDialog::find_places(const AppState& state) {
  constexpr size_t kMaxPlaces = 9;
  places_.clear();
  std::error_code code;
  const auto add = [&](const fs::path& folder, std::string label) {
    const bool is_known = std::ranges::any_of(places_, [&](const Place& p) { return p.folder == folder; });
    if (places_.size() < kMaxPlaces && !is_known && !folder.empty() && fs::is_directory(folder, code))
      places_.push_back({std::move(label), folder});
  };
  if (const char* home = std::getenv("HOME")) add(home, "Home");
  add(fs::current_path(code), "Working folder");
  add(snapshot_folder(state.settings), "Snapshots");
  add(state.settings.scene_folder, "Scenes");
  add(state.settings.environment_folder, "Environments");
  for (const std::string& file : state.settings.recent)
    if (const fs::path folder = fs::path(file).parent_path(); !folder.empty()) add(folder, folder.filename().string());
  add("/", "File system");
}

void FileDialog::sort_entries() {
  const auto precedes = [this](const Entry& a, const Entry& b) {
    if (sort_column_ == 1 && a.seconds != b.seconds) return a.seconds < b.seconds;
    if (sort_column_ == 2 && a.bytes != b.bytes) return a.bytes < b.bytes;
    const std::string first = lower_case(a.name), second = lower_case(b.name);
    return first != second ? first < second : a.name < b.name;
  };
  // Folders come first in either direction.
  std::ranges::sort(entries_, [&](const Entry& a, const Entry& b) {
    if (a.is_folder != b.is_folder) return a.is_folder;
    return sort_descending_ ? precedes(b, a) : precedes(a, b);
  });
}

// The folder as a line of buttons, one per ancestor.
void FileDialog::draw_path(AppState& state) {
  fs::path target, ancestor;
  int id = 0;
  for (const fs::path& part : folder_) {
    if (part.empty()) continue;
    ancestor /= part;
    ImGui::PushID(id++);
    if (ImGui::SmallButton(part.c_str())) target = ancestor;
    ImGui::PopID();
    ImGui::SameLine(0, 2);
    if (ImGui::GetContentRegionAvail().x < ImGui::GetFontSize() * 12) ImGui::NewLine();
  }
  ImGui::NewLine();
  ImGui::SetNextItemWidth(-1);
  ImGui::InputTextWithHint("##filter", "Filter names", &filter_);
  state.ui.items.add("files.filter");
  if (const auto text = state.ui.items.take_request("files.filter")) {
    filter_ = *text;
    state.ui.items.answer("");
  }
  if (!target.empty()) enter_folder(target);
}

void FileDialog::draw_places(AppState& state) {
  fs::path target;
  for (size_t i = 0; i < places_.size(); ++i) {
    const Place& place = places_[i];
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::Selectable(place.label.c_str(), place.folder == folder_)) target = place.folder;
    ImGui::PopID();
    state.ui.items.add("files.place." + std::to_string(i));
    if (ImGui::IsItemHovered()) tooltip(state.ui, place.folder.string());
  }
  if (!target.empty()) enter_folder(target);
}

void FileDialog::draw_formats(AppState& state) {
  const std::string current = lower_extension(name_);
  const auto label = [&](size_t i) { return formats_[i] + " (" + extensions_[i] + ")"; };
  const auto selected = static_cast<size_t>(std::ranges::find(extensions_, current) - extensions_.begin());
  ImGui::SetNextItemWidth(-1);
  if (begin_combo("##format", selected < formats_.size() ? label(selected).c_str() : "Format")) {
    for (size_t i = 0; i < formats_.size(); ++i) {
      if (ImGui::Selectable(label(i).c_str(), i == selected)) name_ = fs::path(name_).replace_extension(extensions_[i]);
      state.ui.items.add("files.format." + extensions_[i].substr(1));
    }
    ImGui::EndCombo();
  }
  state.ui.items.add("files.format");
}

bool FileDialog::draw_entry(AppState& state, const Entry& entry) {
  bool accepted = false;
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  const std::string label = entry.is_folder ? entry.name + "/" : entry.name;
  const ImGuiSelectableFlags flags = ImGuiSelectableFlags_AllowDoubleClick | ImGuiSelectableFlags_SpanAllColumns;
  if (ImGui::Selectable(label.c_str(), !entry.is_folder && entry.name == name_, flags)) {
    name_ = entry.name;
    accepted = entry.is_folder || ImGui::IsMouseDoubleClicked(0);
  }
  state.ui.items.add("files." + entry.name);
  ImGui::TableNextColumn();
  ImGui::TextDisabled("%s", date_text(entry.seconds).c_str());
  ImGui::TableNextColumn();
  if (!entry.is_folder) ImGui::TextDisabled("%s", format_bytes(entry.bytes).c_str());
  return accepted;
}

bool FileDialog::draw_list(AppState& state) {
  bool accepted = false;
  const ImGuiTableFlags flags = ImGuiTableFlags_ScrollY | ImGuiTableFlags_Sortable | ImGuiTableFlags_SizingFixedFit;
  if (!ImGui::BeginTable("##files", 3, flags)) return false;
  const float em = ImGui::GetFontSize();
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("Name", ImGuiTableColumnFlags_WidthStretch | ImGuiTableColumnFlags_DefaultSort);
  ImGui::TableSetupColumn("Changed", ImGuiTableColumnFlags_WidthFixed, em * 8.2f);
  ImGui::TableSetupColumn("Size", ImGuiTableColumnFlags_WidthFixed, em * 4.5f);
  ImGui::TableHeadersRow();
  if (ImGuiTableSortSpecs* specs = ImGui::TableGetSortSpecs(); specs && specs->SpecsDirty && specs->SpecsCount > 0) {
    sort_column_ = specs->Specs[0].ColumnIndex;
    sort_descending_ = specs->Specs[0].SortDirection == ImGuiSortDirection_Descending;
    specs->SpecsDirty = false;
    sort_entries();
  }
  const auto is_shown = [&](const Entry& e) { return contains_ignoring_case(e.name, filter_); };
  bool any = false;
  for (const Entry& entry : entries_) {
    if (!is_shown(entry)) continue;
    any = true;
    accepted = draw_entry(state, entry) || accepted;
  }
  if (!any) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextDisabled(filter_.empty() ? "No suitable files in this folder" : "No name contains the filter");
  }
  ImGui::EndTable();
  return accepted;
}

void FileDialog::draw_preview(AppState& state) {
  const fs::path path = selected_path();
  std::error_code code;
  if (name_.empty() || !fs::is_regular_file(path, code)) return;
  FileThumbnails& thumbnails = *state.tasks.thumbnails;
  const ThumbnailImage* image = thumbnails.find(path.string());
  if (!image) {
    ImGui::TextDisabled("%s", thumbnails.is_pending(path.string()) ? "Reading..." : "No preview");
    return;
  }
  const float width = ImGui::GetContentRegionAvail().x;
  const float scale = width / static_cast<float>(std::max(image->width, image->height));
  ImGui::Image(texture_.texture(state.platform.gl(), 0, *image),
               {static_cast<float>(image->width) * scale, static_cast<float>(image->height) * scale});
}

void FileDialog::draw(AppState& state) {
  if (!state.files.request) return;
  if (!is_open_) open(state);
  add_glyphs(state);
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const float em = ImGui::GetFontSize(), line = ImGui::GetFrameHeightWithSpacing();
  const ImVec2 size(std::min(screen.x * 0.94f, em * 54), std::min(screen.y * 0.9f, line * 22));
  if (!begin_dialog("##files", size)) return;
  UiContext& ui = state.ui;
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(state.files.request->title.c_str());
  ImGui::PopTextWrapPos();
  draw_path(state);
  const float list_height = -2 * line - ImGui::GetStyle().ItemSpacing.y;
  const bool has_preview = size.x > em * 40;
  ImGui::BeginChild("##places", {em * kPlacesWidth, list_height});
  draw_places(state);
  ImGui::EndChild();
  ImGui::SameLine();
  ImGui::BeginChild("##list", {has_preview ? -em * (kPreviewWidth + 1) : 0, list_height});
  bool accepted = draw_list(state);
  ImGui::EndChild();
  if (has_preview) {
    ImGui::SameLine();
    ImGui::BeginChild("##preview", {0, list_height});
    draw_preview(state);
    ImGui::EndChild();
  }
  const bool has_formats = !formats_.empty();
  ImGui::SetNextItemWidth(has_formats ? -em * kFormatWidth : -1);
  if (ImGui::InputTextWithHint("##name", "File name or path", &name_, ImGuiInputTextFlags_EnterReturnsTrue))
    accepted = true;
  ui.items.add("files.name");
  if (const auto name = ui.items.take_request("files.name")) {
    name_ = *name;
    ui.items.answer("");
  }
  if (has_formats) {
    ImGui::SameLine();
    draw_formats(state);
  }
  const bool replaces = saves_ && !replaced_file_.empty() && replaced_file_ == selected_path().string();
  const char* label = !saves_ ? "Open" : replaces ? "Replace" : "Save";
  if (ImGui::Button(label)) accepted = true;
  ui.items.add("files.accept");
  ImGui::SameLine();
  bool closed = ImGui::Button("Cancel") || escape_is_pressed();
  ui.items.add("files.cancel");
  if (!problem_.empty()) {
    ImGui::SameLine();
    ImGui::TextColored(ui.theme.warning, "%s", problem_.c_str());
  }
  std::function<void(const std::string&)> callback;
  std::string path;
  if (!closed && accepted && !name_.empty() && accept(state)) {
    closed = true;
    callback = std::move(state.files.request->accept);
    path = selected_path().string();
  }
  if (closed) {
    is_open_ = false;
    state.files.request.reset();
    state.tasks.thumbnails->cancel_waiting();
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndPopup();
  // The callback may request another file.
  if (callback) callback(path);
}

fs::path FileDialog::selected_path() const { return fs::path(name_).is_absolute() ? fs::path(name_) : folder_ / name_; }

bool FileDialog::accept(AppState& state) {
  const fs::path path = selected_path();
  std::error_code code;
  if (fs::is_directory(path, code)) {
    const std::string name = state.files.request->name;
    enter_folder(path);
    name_ = saves_ ? name : "";
    return false;
  }
  if (!saves_ && !fs::exists(path, code)) {
    problem_ = "File not found";
    return false;
  }
  if (saves_ && fs::exists(path, code) && replaced_file_ != path.string()) {
    replaced_file_ = path.string();
    problem_ = "The file exists.";
    return false;
  }
  state.settings.folder = path.parent_path().string();
  return true;
}

}  // namespace etendue::viewer
