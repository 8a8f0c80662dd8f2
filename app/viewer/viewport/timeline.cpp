#include "viewer/viewport/timeline.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "render/display_frame.h"
#include "render/document.h"
#include "scene/animation.h"
#include "scene/keyframes.h"
#include "viewer/state/app_state.h"
#include "viewer/state/document_info.h"
#include "viewer/state/editor.h"
#include "viewer/state/object_edits.h"
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
constexpr float kKeyframeRoom = 5;  // seconds; the slider ends at a multiple of it
constexpr double kMinStep = 1.0 / 30, kMaxStep = 1.0 / 12;  // seconds between images

// Neither the time nor the clip counts as an edit of the scene that has to be saved.
void set_parameter(AppState& state, const char* name, const Value& value, const char* gesture) {
  const auto parameter = document_parameter(state.document(), name);
  const bool is_saved = !state.editor->has_unsaved_scene_edits();
  state.edit(*parameter, value, gesture);
  if (is_saved) state.editor->mark_scene_saved(state.document().scene);
}

void set_time(AppState& state, float time) { set_parameter(state, "scene.time", static_cast<double>(time), kGesture); }

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

// The range keeps its times, up to the length of a frame.
void set_frame_rate(AppState& state, int rate) {
  Playback& playback = state.viewport.playback;
  for (std::optional<int64_t>* frame : {&playback.first, &playback.last})
    if (*frame) *frame = **frame * rate / playback.frames_per_second;
  playback.frames_per_second = rate;
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
    set_frame_rate(state, std::stoi(std::get<std::string>(*chosen)));
}

double time_of(const AppState& state, int64_t frame) {
  return static_cast<double>(frame) / state.viewport.playback.frames_per_second;
}

// The seconds that are played: the whole clip, or the frames of the range.
struct TimeRange {
  double begin = 0, end = 0;
};
TimeRange time_range(const AppState& state) {
  const auto duration = static_cast<double>(scene::animation_duration(*state.document().scene));
  const Playback& playback = state.viewport.playback;
  const render::FrameRange frames = playback_range(state);
  return {.begin = playback.first ? time_of(state, frames.first) : 0,
          .end = playback.last ? std::min(time_of(state, frames.end), duration) : duration};
}

// Marks the range on the slider that was drawn last.
void draw_range(const AppState& state, double end) {
  const Playback& playback = state.viewport.playback;
  if (!playback.first && !playback.last) return;
  const TimeRange range = time_range(state);
  const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
  const auto x_of = [&](double time) { return min.x + (max.x - min.x) * static_cast<float>(time / end); };
  const float height = std::max(2.0f, 0.12f * ImGui::GetFontSize());
  ImGui::GetWindowDrawList()->AddRectFilled({x_of(range.begin), max.y - height}, {x_of(range.end), max.y},
                                            ImGui::GetColorU32(state.ui.theme.accent));
}

// Darkens the part of the slider that was drawn last that is beyond the end of the animation.
void shade_beyond_end(const AppState& state, float duration, float end) {
  if (duration >= end) return;
  const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
  ImVec4 shade = state.ui.theme.background;
  shade.w = 0.6f;
  ImGui::GetWindowDrawList()->AddRectFilled({min.x + (max.x - min.x) * duration / end, min.y}, max,
                                            ImGui::GetColorU32(shade));
}

// Marks the keyframes of the selected object on the slider that was drawn last.
void draw_keyframes(const AppState& state, float end) {
  const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
  const float half = 0.22f * ImGui::GetFontSize(), y = 0.5f * (min.y + max.y);
  for (const float time : selected_keyframes(state)) {
    const float x = std::clamp(min.x + (max.x - min.x) * time / end, min.x + half, max.x - half);
    const bool is_present = std::abs(time - state.document().scene->time) <= scene::kKeyframeTolerance;
    const ImU32 color = ImGui::GetColorU32(is_present ? state.ui.theme.accent : state.ui.theme.text);
    ImGui::GetWindowDrawList()->AddQuadFilled({x - half, y}, {x, y - half}, {x + half, y}, {x, y + half}, color);
  }
}

bool has_channels(const AppState& state) {
  return state.has_document() &&
         std::ranges::any_of(state.document().scene->animations, [](const auto& a) { return !a->channels.empty(); });
}

// The end of the slider: of the animation, or beyond it where keyframes were set, so that there is room for the next one.
float slider_end(const AppState& state) {
  const float duration = scene::animation_duration(*state.document().scene);
  const bool has_own_keyframes = std::ranges::any_of(
      state.document().structure, [](const auto& edit) { return edit.kind == scene::EditKind::set_keyframe; });
  if (!has_own_keyframes) return duration;
  return std::max(kKeyframeRoom * (std::floor(duration / kKeyframeRoom) + 1), state.document().scene->time);
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
  const TimeRange range = time_range(state);
  const double length = std::max(range.end - range.begin, kMinStep);
  const double elapsed = double{state.document().scene->time} + playback.waiting - range.begin;
  playback.waiting = 0;
  // A time before the range continues at its start.
  set_time(state, static_cast<float>(range.begin + std::fmod(std::max(elapsed, 0.0), length)));
}

render::FrameRange playback_range(const AppState& state) {
  const Playback& playback = state.viewport.playback;
  const int64_t last = last_frame(state);
  const int64_t first = std::clamp<int64_t>(playback.first.value_or(0), 0, last);
  const int64_t end = std::clamp<int64_t>(playback.last.value_or(last), first, last) + 1;
  return {static_cast<uint32_t>(first), static_cast<uint32_t>(end)};
}

void start_range_here(AppState& state) {
  Playback& playback = state.viewport.playback;
  playback.first = present_frame(state);
  if (playback.last && *playback.last < *playback.first) playback.last.reset();
}

void end_range_here(AppState& state) {
  Playback& playback = state.viewport.playback;
  playback.last = present_frame(state);
  if (playback.first && *playback.first > *playback.last) playback.first.reset();
}

void step_frame(AppState& state, int step) {
  state.viewport.playback.is_playing = false;
  const render::FrameRange range = playback_range(state);
  const auto count = static_cast<int64_t>(range.count()), first = static_cast<int64_t>(range.first);
  const int64_t frame = first + ((present_frame(state) - first + step) % count + count) % count;
  set_time(state, static_cast<float>(time_of(state, frame)));
}

void draw_timeline(AppState& state) {
  Playback& playback = state.viewport.playback;
  playback.bar_height = 0;
  if (!has_channels(state)) return;
  const Placement& region = state.viewport.region;
  const float em = ImGui::GetFontSize();
  const float width = std::min(region.size.x - 20, em * kWidth);
  const bool is_narrow = width < em * kNarrowWidth;
  if (width < em * 12) return;
  ImGui::SetNextWindowPos({region.corner.x + region.size.x / 2, region.corner.y + region.size.y - 10}, ImGuiCond_Always,
                          {0.5f, 1});
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
  const float end = std::max(slider_end(state), 1e-6f);
  float time = state.document().scene->time;
  const std::string text = formatted("%.2f / %.2f s", static_cast<double>(time), static_cast<double>(duration)) +
                           (is_narrow ? "" : formatted(", frame %lld", static_cast<long long>(present_frame(state))));
  ImGui::SetNextItemWidth(-em * (is_narrow ? 7 : 12));
  const bool moved = ImGui::SliderFloat("##time", &time, 0, end, "");
  state.ui.items.add(kTimeSlider);
  shade_beyond_end(state, duration, end);
  draw_range(state, static_cast<double>(end));
  draw_keyframes(state, end);
  if (ImGui::IsItemHovered())
    tooltip(state.ui,
            "Time at which animations are evaluated. Marks: keyframes of the selected object. The darker part after "
            "the last keyframe is for new ones");
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
