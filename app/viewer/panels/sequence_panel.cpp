// Images of an animation or of a turn of the camera, as numbered files.
#include <imgui.h>

#include <nlohmann/json.hpp>

#include "render/document.h"
#include "viewer/actions/action.h"
#include "viewer/files/file_names.h"
#include "viewer/files/file_request.h"
#include "viewer/panels/panel.h"
#include "viewer/state/app_state.h"
#include "viewer/state/document_info.h"
#include "viewer/tasks/sequence_task.h"
#include "viewer/widgets/action_widgets.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/parameter_widgets.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {

enum class SequenceKind : uint8_t { animation, turntable };

}  // namespace etendue::viewer

namespace etendue {

template <>
struct Options<viewer::SequenceKind> {
  static constexpr std::array<Option, 2> kOptions{{{"animation", "Animation"}, {"turntable", "Turntable"}}};
};

}  // namespace etendue

namespace etendue::viewer {
namespace {

constexpr const char* kStart = "sequence.start";
constexpr const char* kStop = "sequence.stop";
constexpr float kSettingsWidth = 26;  // em

// The numbers of the files, as "0000 to 0023".
std::string numbers_text(const render::FrameRange& range) {
  return formatted("%04u to %04u", range.first, range.end - 1);
}

class SequencePanel final : public Panel {
 public:
  PanelInfo info() const override {
    return {.name = "panel.sequence",
            .label = "Sequence",
            .description = "Renders the frames of an animation or a turntable to numbered files",
            .place = PanelPlace::bottom};
  }

  void draw(AppState& state) override {
    const float em = ImGui::GetFontSize();
    ImGui::BeginChild("##settings", {std::min(kSettingsWidth * em, ImGui::GetContentRegionAvail().x), 0});
    action_button(state, task_.running() ? kStop : kStart);
    parameter_widgets(state, std::tie(kind_));
    if (is_turntable()) parameter_widgets(state, std::tie(images_));
    parameter_widgets(state, std::tie(samples_, replaces_));
    ImGui::EndChild();
    same_line_if_fits(kSettingsWidth * em);
    ImGui::BeginChild("##progress");
    draw_plan(state);
    draw_progress(state.ui);
    ImGui::EndChild();
  }

  std::vector<ParameterInfo> parameters() const override {
    const SequencePanel defaults;
    return describe_all(std::tie(defaults.kind_, defaults.images_, defaults.samples_, defaults.replaces_));
  }

  void add_actions(ActionList& actions) override {
    actions.add({.name = kStart,
                 .menu = "Render",
                 .label = "Render sequence...",
                 .tooltip = "Renders the images that the Sequence panel describes to numbered files",
                 .run = [this](AppState& state) { request_files(state); },
                 .enabled = [this](const AppState& state) { return state.has_document() && !task_.running(); },
                 .section = "sequence"});
    actions.add({.name = kStop,
                 .menu = "Render",
                 .label = "Stop sequence",
                 .tooltip = "Ends the sequence. Images that are complete stay",
                 .run = [this](AppState& state) { task_.stop(state.task_context); },
                 .enabled = [this](const AppState&) { return task_.running(); },
                 .section = "sequence"});
  }

  std::vector<WaitCondition> wait_conditions() override {
    const auto check = [this](AppState&, std::optional<uint32_t>) -> StepStatus {
      if (task_.running()) return {};
      if (!task_.progress()) return {.error = "no sequence was rendered; click sequence.start first"};
      return {.done = true};
    };
    return {{.name = "sequence", .check = check}};
  }

  void report(AppState& state, nlohmann::json& json) override {
    const render::FrameRange range = plan(state).frames;
    json["sequence"] = {{"running", task_.running()}, {"first", range.first}, {"end", range.end}};
    if (const SequenceProgress* progress = task_.progress()) {
      json["sequence"]["done"] = progress->done;
      json["sequence"]["file"] = progress->file;
      json["sequence"]["error"] = progress->error;
    }
  }

  void update(AppState& state) override { task_.update(state.task_context); }
  std::vector<Task*> tasks() override { return {&task_}; }

 private:
  bool is_turntable() const { return kind_ == SequenceKind::turntable; }

  render::SequencePlan plan(const AppState& state) const {
    if (is_turntable()) return {.frames = {0, static_cast<uint32_t>(images_.value)}, .is_turntable = true};
    if (!state.has_document()) return {.frames = {0, 1}};
    return {.frames = playback_range(state),
            .frames_per_second = static_cast<double>(state.viewport.playback.frames_per_second)};
  }

  void draw_plan(const AppState& state) const {
    const render::SequencePlan planned = plan(state);
    const std::string numbers = numbers_text(planned.frames);
    if (is_turntable()) {
      note(state.ui, formatted("One turn about the vertical axis through the centre of the view; images %s.", numbers.c_str()));
    } else if (!is_animated(state)) {
      note(state.ui, "The scene has no animation: the sequence is one image. A turntable turns the camera.");
    } else {
      note(state.ui, formatted("Frames %s at %g fps, as on the timeline. View > Animation sets the range.",
                               numbers.c_str(), planned.frames_per_second));
    }
  }

  void draw_progress(const UiContext& ui) const {
    const SequenceProgress* progress = task_.progress();
    if (!progress) return;
    const float height = std::max(2.0f, std::floor(2 * ui.scale));
    const double share = task_.running() ? task_.share() : static_cast<double>(progress->done) / progress->count;
    progress_line(static_cast<float>(share), ImGui::GetContentRegionAvail().x, height,
                  task_.running() ? ui.theme.accent : ui.theme.secondary_text);
    std::string text = formatted("%u of %u images", progress->done, progress->count);
    if (task_.running() && progress->done > 0)
      text += ", " + clock_text(progress->seconds / progress->done * (progress->count - progress->done)) + " left";
    else if (!task_.running() && progress->done < progress->count)
      text += ", stopped";
    ImGui::TextUnformatted(text.c_str());
    if (!progress->file.empty()) note(ui, "Last file: " + progress->file);
    if (!progress->error.empty()) warning(ui, progress->error);
  }

  void request_files(AppState& state) {
    state.panels.open(*this);
    state.files.request = image_file_request("Render sequence; #### in the name stands for the number of the image",
                                             scene_stem(state.document()) + ".####.png",
                                             [this, &state](const std::string& file) { start(state, file); });
  }

  void start(AppState& state, const std::string& file) {
    const auto started = task_.start(state.task_context, {.plan = plan(state),
                                                          .samples = samples_,
                                                          .pattern = file,
                                                          .replaces = replaces_});
    if (!started) state.notices.add_error(started.error().message);
  }

  Choice<SequenceKind> kind_{"sequence.kind", "Images", SequenceKind::animation,
                             "Animation: the frames of the timeline. Turntable: a full turn of the camera"};
  Number<int> images_{"sequence.images",
                      "Images of the turn",
                      36,
                      {1, 10'000},
                      "Number of images of a full turn. More make the motion smoother",
                      "",
                      Scale::logarithmic};
  Number<int> samples_{"sequence.samples",
                       "Samples",
                       64,
                       {1, 1'000'000},
                       "Samples per pixel of each image. More give less noise and take longer",
                       "spp",
                       Scale::logarithmic};
  Toggle replaces_{"sequence.replace", "Replace files", false,
                   "Replaces files that exist. Otherwise a sequence whose files exist is not started"};
  SequenceTask task_;
};

}  // namespace

std::unique_ptr<Panel> make_sequence_panel() { return std::make_unique<SequencePanel>(); }

}  // namespace etendue::viewer
