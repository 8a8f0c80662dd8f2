#include "viewer/viewport/timeline.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "render/display_frame.h"
#include "render/document.h"
#include "scene/animation.h"
#include "viewer/state/app_state.h"
#include "viewer/state/document_info.h"
#include "viewer/state/editor.h"
#include "viewer/widgets/action_widgets.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/parameter_widgets.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

constexpr const char* kTimeSlider = "timeline.time";
constexpr const char* kFrameRate = "timeline.fps";
constexpr const char* kGesture = "timeline";
constexpr std::array kFrameRates{12, 24, 25, 30, 50, 60};
constexpr float kWidth = 46, kNarrowWidth = 36;  // times the font size; a narrow bar has no choices
constexpr double kMinStep = 1.0 / 30, kMaxStep = 1.0 / 12;  // seconds between images

// Neither the time nor the clip counts as an edit of the scene that has to be saved.
void set_parameter(AppState& state, const char* name, const Value& value, const char* gesture) {
  const auto parameter = document_parameter(state.document(), name);
  const bool is_saved = !state.editor->has_unsaved_scene_edits();
  state.edit(*parameter, value, gesture);
  if (is_saved) state.editor->mark_scene_saved(state.document().scene);
}

void set_time(AppState& state, float time) {
  set_parameter(state, "scene.time", static_cast<double>(time), kGesture);
}

// The frame at the present time, and the last one that is not after the end.
int64_t present_frame(const AppState& state) {
  return std::llround(static_cast<double>(state.document().scene->time) * state.viewport.playback.frames_per_second);
}
int64_t last_frame(const AppState& state) {
  const auto duration = static_cast<double>(scene::animation_duration(*state.document().scene));
  return static_cast<int64_t>(std::floor(duration * state.viewport.playback.frames_per_second + 1e-6));
}

// The clip that plays, if the file has several.
void draw_clip(AppState& state, float width) {
  const auto parameter = document_parameter(state.document(), "scene.clip");
  if (!parameter) return;
  ImGui::SameLine();
  if (const auto clip = compact_choice(state, parameter->info, width)) set_parameter(state, "scene.clip", *clip, "");
}

void draw_frame_rate(AppState& state, float width) {
  ParameterInfo info;
  info.name = kFrameRate;
  info.label = "Frame rate";
  info.doc = "Frames per second of the steps with the keys , and . and of the number of the frame";
  info.type = ParameterType::choice;
  for (const int rate : kFrameRates) {
    info.options.push_back(std::to_string(rate));
    info.option_labels.push_back(std::to_string(rate) + " fps");
  }
  info.default_value = std::to_string(state.viewport.playback.frames_per_second);
  ImGui::SameLine();
  if (const auto chosen = compact_choice(state, info, width))
    state.viewport.playback.frames_per_second = std::stoi(std::get<std::string>(*chosen));
}

// Waits for the full resolution, but not longer than kMaxStep.
bool image_is_on_screen(const AppState& state) {
  const auto& frame = state.viewport.frame;
  if (!frame || frame->version != state.editor->version()) return false;
  return frame->preview_scale == 1 || state.viewport.playback.waiting >= kMaxStep;
}

}  // namespace

bool is_animated(const AppState& state) {
  return state.has_document() && scene::animation_duration(*state.document().scene) > 0;
}

void toggle_playback(AppState& state) {
  Playback& playback = state.viewport.playback;
  playback.is_playing = !playback.is_playing && is_animated(state);
  playback.waiting = 0;
  state.editor->end_gesture();
}

void advance_playback(AppState& state, float seconds) {
  Playback& playback = state.viewport.playback;
  if (!playback.is_playing) return;
  if (!is_animated(state)) {
    playback.is_playing = false;
    return;
  }
  playback.waiting += static_cast<double>(seconds);
  if (playback.waiting < kMinStep || !image_is_on_screen(state)) return;
  const scene::Scene& scene = *state.document().scene;
  const float next = scene.time + static_cast<float>(playback.waiting);
  playback.waiting = 0;
  set_time(state, std::fmod(next, scene::animation_duration(scene)));
}

void step_frame(AppState& state, int step) {
  state.viewport.playback.is_playing = false;
  const int64_t count = last_frame(state) + 1;
  const int64_t frame = ((present_frame(state) + step) % count + count) % count;
  set_time(state, static_cast<float>(static_cast<double>(frame) / state.viewport.playback.frames_per_second));
}

void draw_timeline(AppState& state) {
  Playback& playback = state.viewport.playback;
  playback.bar_height = 0;
  if (!is_animated(state)) return;
  const Placement& region = state.viewport.region;
  const float em = ImGui::GetFontSize();
  const float width = std::min(region.size.x - 20, em * kWidth);
  const bool is_narrow = width < em * kNarrowWidth;
  if (width < em * 12) return;
  ImGui::SetNextWindowPos({region.corner.x + region.size.x / 2, region.corner.y + region.size.y - 10},
                          ImGuiCond_Always, {0.5f, 1});
  ImGui::SetNextWindowSize({width, 0});
  ImGui::SetNextWindowBgAlpha(0.85f);
  ImGui::Begin("##timeline", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoFocusOnAppearing);
  action_button(state, "animation.play");
  if (!is_narrow) {
    draw_clip(state, em * 7);
    draw_frame_rate(state, em * 5);
  }
  ImGui::SameLine();
  const float duration = scene::animation_duration(*state.document().scene);
  float time = state.document().scene->time;
  const std::string text = formatted("%.2f / %.2f s", static_cast<double>(time), static_cast<double>(duration)) +
                           (is_narrow ? "" : formatted(", frame %lld", static_cast<long long>(present_frame(state))));
  ImGui::SetNextItemWidth(-em * (is_narrow ? 7 : 12));
  const bool moved = ImGui::SliderFloat("##time", &time, 0, duration, "");
  state.ui.items.add(kTimeSlider);
  if (ImGui::IsItemHovered()) tooltip(state.ui, "Time at which the animations of the file are evaluated");
  if (moved) {
    playback.is_playing = false;
    set_time(state, time);
  }
  if (ImGui::IsItemDeactivated()) state.editor->end_gesture();
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(text.c_str());
  playback.bar_height = ImGui::GetWindowSize().y + 6;
  ImGui::End();
}

}  // namespace etendue::viewer
