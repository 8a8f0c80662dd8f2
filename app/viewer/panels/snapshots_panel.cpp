// The gallery of snapshots: pictures of the folder, what each one is, and how its settings differ.
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/number_text.h"
#include "render/document.h"
#include "render/state_difference.h"
#include "viewer/actions/action.h"
#include "viewer/files/file_names.h"
#include "viewer/files/image_export.h"
#include "viewer/files/snapshot_list.h"
#include "viewer/panels/panel.h"
#include "viewer/platform/platform.h"
#include "viewer/state/app_state.h"
#include "viewer/state/document_info.h"
#include "viewer/state/editor.h"
#include "viewer/tasks/file_thumbnails.h"
#include "viewer/viewport/comparison.h"
#include "viewer/widgets/action_widgets.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/dialog.h"
#include "viewer/widgets/image_tooltip.h"
#include "viewer/widgets/thumbnails.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

constexpr float kDetailsWidth = 30;     // em
constexpr float kMinGalleryWidth = 16;  // em
constexpr float kThumbnailWidth = 9;    // em
constexpr float kThumbnailAspect = 1.6f;
constexpr float kMarkWidth = 2;  // of the frame around a selected picture, units of the interface
constexpr const char* kNotesItem = "snapshots.notes";
constexpr const char* kDeleteDialog = "##delete-snapshot";

// "~/Pictures" for a folder in the home folder of the user.
std::string shortened_home(const std::string& folder) {
  const char* home = std::getenv("HOME");
  const std::string prefix = home ? std::string(home) + "/" : "";
  return prefix.size() > 1 && folder.starts_with(prefix) ? "~/" + folder.substr(prefix.size()) : folder;
}

// One row of the table of differences.
struct DifferenceRow {
  std::string label, left, right;
};

std::string value_text(const ParameterInfo& info, const std::string& value) {
  for (size_t i = 0; i < info.options.size() && i < info.option_labels.size(); ++i)
    if (info.options[i] == value) return info.option_labels[i];
  return info.unit.empty() ? value : value + " " + info.unit;
}

// States leave out values that are those of the scene as it was opened.
std::string original_text(const render::Document& document, const ParameterInfo& info) {
  if (!document.origin) return "default";
  const auto value = render::get(*document.origin, info.name);
  return value ? value_text(info, to_string(*value)) : "default";
}

DifferenceRow row_of(const render::Document& document, const render::SettingDifference& d) {
  const auto parameter = document_parameter(document, d.name);
  const auto text = [&](const std::string& value) {
    if (!parameter) return value.empty() ? std::string("none") : value;
    return value.empty() ? original_text(document, parameter->info) : value_text(parameter->info, value);
  };
  return {parameter ? full_label(document, *parameter) : label_of_name(d.name), text(d.a), text(d.b)};
}

std::vector<DifferenceRow> difference_rows(const render::Document& document, const std::string& left,
                                           const std::string& right) {
  std::vector<DifferenceRow> rows;
  const auto differences = render::differences_of_states(left, right);
  if (!differences) return rows;
  for (const render::SettingDifference& d : *differences) rows.push_back(row_of(document, d));
  return rows;
}

const std::vector<ItemInfo>& all_items() {
  static const std::vector<ItemInfo> list{
      {"snapshots.N", "Snapshot", "Selects a snapshot. Ctrl+click selects a second one, a double click opens it"},
      {"snapshots.open", "Open", "Shows the picture, restores all settings, and continues with the samples"},
      {"snapshots.use-a", "Use as A", "Compares the picture with image B"},
      {"snapshots.use-b", "Use as B", "Compares the image with this picture"},
      {"snapshots.compare", "Compare A | B", "Shows the two selected snapshots on both sides of a divider"},
      {"snapshots.delete", "Delete...", "Deletes the file and its samples"},
      {"snapshots.delete-yes", "Delete", "Deletes the file and its samples"},
      {"snapshots.delete-no", "Cancel", "Keeps the file"},
      {kNotesItem, "Notes", "Text that is kept in the file, where other programs show it as comments"}};
  return list;
}

const std::string& description_of(const char* item) {
  return std::ranges::find(all_items(), item, &ItemInfo::name)->description;
}

class SnapshotsPanel final : public Panel {
 public:
  PanelInfo info() const override {
    return {.name = "panel.snapshots",
            .label = "Snapshots",
            .description = "Saved snapshots: open, compare, annotate, and see how their settings differ",
            .place = PanelPlace::bottom};
  }

  void draw(AppState& state) override {
    drop_missing_selection();
    const float em = ImGui::GetFontSize(), available = ImGui::GetContentRegionAvail().x;
    const bool has_details = selected_.has_value();
    const float details = has_details ? std::min(kDetailsWidth * em, available - kMinGalleryWidth * em) : 0;
    ImGui::BeginChild("##gallery", {has_details ? available - details - em : 0, 0});
    draw_gallery(state);
    ImGui::EndChild();
    if (!has_details) return;
    ImGui::SameLine(0, em);
    ImGui::BeginChild("##details", {details, 0});
    if (const SnapshotInfo* info = find(*selected_)) draw_details(state, *info);
    ImGui::EndChild();
    draw_delete_dialog(state);
  }

  std::vector<ItemInfo> items() const override { return all_items(); }

  bool reveal_parameter(AppState&, const std::string& name) override { return name == kNotesItem; }

  void report(AppState& state, nlohmann::json& json) override {
    auto& report = json["snapshots"];
    report["reading"] = list_.is_reading();
    report["files"] = nlohmann::json::array();
    for (const SnapshotInfo& s : list_.all())
      report["files"].push_back({{"name", base_name(s.file)},
                                 {"samples", s.samples},
                                 {"notes", s.notes},
                                 {"has_samples", s.checkpoint_bytes > 0}});
    if (selected_) report["selected"] = base_name(*selected_);
    if (other_) report["other"] = base_name(*other_);
    report["differences"] = nlohmann::json::array();
    if (selected_ && find(*selected_))
      for (const DifferenceRow& row : differences(state)) report["differences"].push_back({row.label, row.left, row.right});
  }

  std::vector<WaitCondition> wait_conditions() override {
    // Everything that was saved is in the list.
    const auto check = [this](AppState& state, std::optional<uint32_t>) -> StepStatus {
      if (!state.is_visible(*this)) return {.error = "the panel is closed; click panel.snapshots first"};
      const bool is_busy = state.files.image_export->is_busy() || list_.is_reading() || list_.is_saving();
      return {.done = !is_busy && list_.is_current(snapshot_folder(state.settings))};
    };
    return {{.name = "snapshots", .check = check, .needs_frames = true}};
  }

  void update(AppState& state) override {
    // The folder is looked at while the panel is open, and for results that are waiting.
    if (state.is_visible(*this) || list_.has_update()) list_.update(state.task_context, snapshot_folder(state.settings));
    if (list_.revision() == seen_revision_) return;
    seen_revision_ = list_.revision();
    rows_are_current_ = false;
  }
  std::vector<Task*> tasks() override { return {&list_}; }

 private:
  const SnapshotInfo* find(const std::string& file) const {
    const auto found = std::ranges::find(list_.all(), file, &SnapshotInfo::file);
    return found == list_.all().end() ? nullptr : &*found;
  }

  void drop_missing_selection() {
    if (list_.is_reading()) return;
    if (other_ && !find(*other_)) select(selected_, std::nullopt);
    if (selected_ && !find(*selected_)) select(other_, std::nullopt);
  }

  void select(std::optional<std::string> selected, std::optional<std::string> other) {
    selected_ = std::move(selected);
    other_ = std::move(other);
    rows_are_current_ = false;
    const SnapshotInfo* info = selected_ ? find(*selected_) : nullptr;
    notes_ = info ? info->notes : "";
  }

  // ---- Gallery

  void draw_gallery(AppState& state) {
    action_button(state, "snapshot.save");
    const std::string folder = shortened_home(snapshot_folder(state.settings).string());
    if (list_.all().empty()) {
      const char* text = list_.is_reading() ? "Reading " : "There are no snapshots in ";
      return note(state.ui, folder.empty() ? "There is no folder for snapshots; Preferences can name one."
                                           : text + folder);
    }
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("%s", shortened(folder, ImGui::GetContentRegionAvail().x).c_str());
    ImGui::BeginChild("##pictures");
    const float width = kThumbnailWidth * ImGui::GetFontSize(), spacing = ImGui::GetStyle().ItemSpacing.x;
    const int columns = std::max(1, static_cast<int>((ImGui::GetContentRegionAvail().x + spacing) / (width + spacing)));
    for (size_t i = 0; i < list_.all().size(); ++i) {
      if (i % static_cast<size_t>(columns) != 0) ImGui::SameLine();
      draw_snapshot(state, list_.all()[i], i, width);
    }
    ImGui::EndChild();
  }

  void draw_snapshot(AppState& state, const SnapshotInfo& info, size_t index, float width) {
    ImGui::PushID(info.file.c_str());
    ImGui::BeginGroup();
    const ImVec2 corner = ImGui::GetCursorScreenPos(), size{width, std::floor(width / kThumbnailAspect)};
    const bool clicked = ImGui::InvisibleButton("##picture", size);
    state.ui.items.add("snapshots." + std::to_string(index));
    const bool hovered = ImGui::IsItemHovered();
    draw_picture(state, info, index, corner, size, hovered);
    if (hovered) draw_enlarged(state, info, index);
    ImGui::TextUnformatted(shortened(caption(info), width).c_str());
    ImGui::EndGroup();
    ImGui::PopID();
    if (hovered && ImGui::IsMouseDoubleClicked(0)) return state.open_file(info.file);
    if (!clicked) return;
    if (state.ui.input.control() && selected_ && *selected_ != info.file)
      select(selected_, info.file);
    else
      select(info.file, std::nullopt);
  }

  // The picture in the middle of its rectangle, and a frame if it is selected.
  void draw_picture(AppState& state, const SnapshotInfo& info, size_t index, const ImVec2& corner, const ImVec2& size,
                    bool hovered) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImVec2 end(corner.x + size.x, corner.y + size.y);
    draw.AddRectFilled(corner, end, ImGui::GetColorU32(ImGuiCol_FrameBg));
    if (const ThumbnailImage* image = state.tasks.thumbnails->find(info.file)) {
      const Placement place = fit_inside({{corner.x, corner.y}, {size.x, size.y}}, {image->width, image->height});
      draw.AddImage(thumbnails_.texture(state.platform.gl(), index, *image), {place.corner.x, place.corner.y},
                    {place.corner.x + place.size.x, place.corner.y + place.size.y});
    }
    const bool is_selected = selected_ == info.file, is_other = other_ == info.file;
    const float mark = kMarkWidth * state.ui.scale;
    if (is_selected || is_other || hovered)
      draw.AddRect(corner, end, ImGui::GetColorU32(is_selected || is_other ? state.ui.theme.accent
                                                                           : state.ui.theme.secondary_text),
                   0, 0, mark);
    if (!other_ || !(is_selected || is_other)) return;
    draw.AddText({corner.x + 3 * mark, corner.y + 2 * mark}, ImGui::GetColorU32(state.ui.theme.accent),
                 is_selected ? "A" : "B");
  }

  // The picture with what the file says.
  void draw_enlarged(AppState& state, const SnapshotInfo& info, size_t index) {
    const ThumbnailImage* image = state.tasks.thumbnails->find(info.file);
    const ImTextureID texture = image ? thumbnails_.texture(state.platform.gl(), index, *image) : nullptr;
    const std::string notes = info.notes.empty() ? "" : "\n" + info.notes;
    image_tooltip(state.ui, texture, image ? *image : ThumbnailImage(),
                  base_name(info.file) + "\n" + description(info) + notes);
  }

  // The first line of the notes, or the method.
  static std::string caption(const SnapshotInfo& info) {
    const std::string line = info.notes.substr(0, info.notes.find('\n'));
    return line.empty() ? formatted("%u spp, %s", info.samples, info.integrator.c_str()) : line;
  }

  static std::string description(const SnapshotInfo& info) {
    return formatted("%s, %u spp, %d x %d, %s", info.integrator.c_str(), info.samples, info.width, info.height,
                     info.date.c_str());
  }

  // ---- Details

  void draw_details(AppState& state, const SnapshotInfo& info) {
    ImGui::TextUnformatted(shortened(base_name(info.file), ImGui::GetContentRegionAvail().x).c_str());
    note(state.ui, description(info) + "; " + samples_text(info) + ".");
    draw_buttons(state, info);
    draw_notes(state, info);
    draw_differences(state);
  }

  static std::string samples_text(const SnapshotInfo& info) {
    if (info.checkpoint_bytes == 0) return "without samples, so it starts again";
    return "continues with its samples (" + format_bytes(info.checkpoint_bytes) + ")";
  }

  bool button(AppState& state, const char* label, const char* item, bool is_first = false) {
    if (!is_first) same_line_if_fits(ImGui::CalcTextSize(label).x + 2 * ImGui::GetStyle().FramePadding.x);
    const bool pressed = ImGui::Button(label);
    state.ui.items.add(item);
    if (ImGui::IsItemHovered()) tooltip(state.ui, description_of(item));
    return pressed;
  }

  void draw_buttons(AppState& state, const SnapshotInfo& info) {
    Comparison& comparison = *state.viewport.comparison;
    if (other_) {
      if (button(state, "Compare A | B", "snapshots.compare", true)) comparison.load_both(info.file, *other_);
    } else {
      if (button(state, "Open", "snapshots.open", true)) state.open_file(info.file);
      if (button(state, "Use as A", "snapshots.use-a")) comparison.load(info.file, Comparison::Target::a);
      if (button(state, "Use as B", "snapshots.use-b")) comparison.load(info.file, Comparison::Target::b);
    }
    if (button(state, "Delete...", "snapshots.delete")) asks_to_delete_ = true;
  }

  void draw_notes(AppState& state, const SnapshotInfo& info) {
    const ImVec2 padding = ImGui::GetStyle().FramePadding, corner = ImGui::GetCursorScreenPos();
    ImGui::InputTextMultiline("##notes", &notes_, {-1, 2 * ImGui::GetTextLineHeight() + 2 * padding.y});
    const bool left = ImGui::IsItemDeactivatedAfterEdit();
    if (notes_.empty() && !ImGui::IsItemActive())
      ImGui::GetWindowDrawList()->AddText({corner.x + padding.x, corner.y + padding.y},
                                          ImGui::GetColorU32(state.ui.theme.secondary_text), "Notes");
    state.ui.items.add(kNotesItem);
    if (ImGui::IsItemHovered()) tooltip(state.ui, description_of(kNotesItem));
    if (const auto requested = state.ui.items.take_request(kNotesItem)) {
      notes_ = *requested;
      state.ui.items.answer("");
    } else if (!left) {
      return;
    }
    if (notes_ == info.notes) return;
    list_.write_notes(state.task_context, info.file, notes_);
  }

  const std::vector<DifferenceRow>& differences(AppState& state) {
    const uint64_t revision = state.editor->revision();
    if (rows_are_current_ && rows_revision_ == revision) return rows_;
    const SnapshotInfo* other = other_ ? find(*other_) : nullptr;
    const std::string& snapshot = find(*selected_)->state;
    rows_ = other ? difference_rows(state.document(), snapshot, other->state)
                  : difference_rows(state.document(), render::state_json(state.document(), 0), snapshot);
    rows_are_current_ = true;
    rows_revision_ = revision;
    return rows_;
  }

  void draw_differences(AppState& state) {
    const auto& rows = differences(state);
    if (rows.empty()) return note(state.ui, other_ ? "Both have the same settings." : "The settings are the current ones.");
    if (!ImGui::BeginTable("##differences", 3, ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_RowBg)) return;
    for (const char* heading : {"Setting", other_ ? "A" : "Now", other_ ? "B" : "Snapshot"})
      ImGui::TableSetupColumn(heading);
    ImGui::TableHeadersRow();
    for (const DifferenceRow& row : rows) {
      ImGui::TableNextRow();
      for (const std::string* text : {&row.label, &row.left, &row.right}) {
        ImGui::TableNextColumn();
        ImGui::TextWrapped("%s", text->c_str());
      }
    }
    ImGui::EndTable();
  }

  void draw_delete_dialog(AppState& state) {
    if (!asks_to_delete_) return;
    std::vector<std::string> files{*selected_};
    if (other_) files.push_back(*other_);
    if (!begin_dialog(kDeleteDialog)) return;
    ImGui::Text(files.size() == 1 ? "Delete %s?" : "Delete %s and the other selected snapshot?",
                base_name(files.front()).c_str());
    ImGui::TextDisabled("The picture and its samples cannot be recovered.");
    ImGui::Spacing();
    const bool yes = dialog_button(state, "Delete", "snapshots.delete-yes");
    ImGui::SameLine();
    const bool no = dialog_button(state, "Cancel", "snapshots.delete-no") || escape_is_pressed();
    if (yes || no) {
      ImGui::CloseCurrentPopup();
      asks_to_delete_ = false;
    }
    ImGui::EndPopup();
    if (!yes) return;
    for (const std::string& file : files)
      if (const std::string problem = remove_snapshot(file); !problem.empty()) state.notices.add_error(problem);
  }

  SnapshotList list_;
  uint64_t seen_revision_ = 0;
  std::optional<std::string> selected_, other_;  // files; the second one is compared with the first
  Thumbnails thumbnails_;
  std::string notes_;  // as they are being edited
  bool asks_to_delete_ = false;
  std::vector<DifferenceRow> rows_;
  bool rows_are_current_ = false;
  uint64_t rows_revision_ = 0;  // of the document
};

}  // namespace

std::unique_ptr<Panel> make_snapshots_panel() { return std::make_unique<SnapshotsPanel>(); }

}  // namespace etendue::viewer
