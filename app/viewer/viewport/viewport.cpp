// What am I looking at, and how do I get around it? Hands on the picture, and what is drawn over it.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <chrono>

#include "spectrum/colormap.h"
#include "viewer/layout/interface.h"
#include "viewer/widgets/format.h"
#include "viewer/widgets/scale_bar.h"

namespace etendue::viewer {
namespace {

using Clock = std::chrono::steady_clock;

constexpr float kClickSlack = 4;       // pixels that a click may wander
constexpr double kDoubleClick = 0.35;  // seconds
constexpr double kWheelGesture = 0.6;  // seconds of rest that end a step

// One hand: what it holds and since when.
struct Hold {
  enum class Grip { none, orbit, pan, fly } grip = Grip::none;
  Vec2 start{0}, last{0};
  bool moved = false;
  Vec2 click_at{-1e6f};
  Clock::time_point clicked{}, wheeled{};
};

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::optional<Picked> picked_at(const Workbench& w, Vec2 at) {
  const auto scene = w.session.scene();
  return scene ? pick(w.editor.document(), *scene, w.view.picture, at) : std::nullopt;
}

// Whether the click is for the sampling sheet.
bool choose_pixel(Workbench& w, Vec2 at) {
  const bool wanted = w.view.sampling.picks || (w.view.sheet == "sheet.sampling" && w.input.control());
  if (!wanted || !w.view.picture.contains(at)) return false;
  w.view.sampling.picks = false;
  w.view.sheet = "sheet.sampling";
  w.probe.choose(pixel_at(w.view.picture, {w.editor.document().width, w.editor.document().height}, at));
  return true;
}

// Whether the click is for the light meter.
bool measure(Workbench& w, Vec2 at) {
  if (!w.meter.picks || !w.view.picture.contains(at)) return false;
  w.meter.picks = false;
  const Placement& p = w.view.picture;
  w.meter.measure((at - p.corner) / p.size * Vec2(w.editor.document().width, w.editor.document().height));
  w.show_tab(Tab::light);
  return true;
}

void click(Workbench& w, Hold& hold, Vec2 at) {
  if (choose_pixel(w, at) || measure(w, at)) return;
  const auto picked = picked_at(w, at);
  const bool twice = seconds_since(hold.clicked) < kDoubleClick && glm::length(at - hold.click_at) <= kClickSlack;
  hold.clicked = twice ? Clock::time_point{} : Clock::now();
  hold.click_at = at;
  if (picked && (twice || w.view.focus_by_click)) {
    w.view.focus_by_click = false;
    w.focus_at(*picked);
  }
  if (picked)
    w.select(picked->node, picked->material);
  else
    w.selection.node = -1;
}

void grab(Workbench& w, Hold& hold) {
  const auto pressed = [&](Button b) { return w.input.pressed[static_cast<size_t>(b)]; };
  Hold::Grip grip = Hold::Grip::none;
  if (pressed(Button::left)) grip = w.input.shift() ? Hold::Grip::pan : Hold::Grip::orbit;
  if (pressed(Button::middle)) grip = Hold::Grip::pan;
  if (pressed(Button::right)) grip = Hold::Grip::fly;
  if (grip == Hold::Grip::none) return;
  w.editor.end_gesture();
  hold.grip = grip;
  hold.start = hold.last = w.input.mouse;
  hold.moved = false;
}

void drag(Workbench& w, Hold& hold) {
  const Vec2 move = w.input.mouse - hold.last;
  if (glm::length(w.input.mouse - hold.start) > kClickSlack) hold.moved = true;
  if (!hold.moved || move == Vec2(0)) return;
  hold.last = w.input.mouse;
  const Camera& camera = w.editor.document().camera;
  if (hold.grip == Hold::Grip::orbit) w.edit_camera(w.hand.orbit(camera, move), "Orbit", "camera.orbit");
  if (hold.grip == Hold::Grip::pan) w.edit_camera(w.hand.pan(camera, move, w.view.picture.size.y), "Pan", "camera.pan");
  if (hold.grip == Hold::Grip::fly) w.edit_camera(w.hand.look_around(camera, move), "Fly", "camera.fly");
}

void fly(Workbench& w, float seconds) {
  const auto axis = [&](int forth, int back) {
    return (w.input.keys[static_cast<size_t>(forth)] ? 1.0f : 0.0f) -
           (w.input.keys[static_cast<size_t>(back)] ? 1.0f : 0.0f);
  };
  const Vec3 direction(axis(GLFW_KEY_D, GLFW_KEY_A), axis(GLFW_KEY_E, GLFW_KEY_Q), axis(GLFW_KEY_S, GLFW_KEY_W));
  if (direction != Vec3(0))
    w.edit_camera(w.hand.fly(w.editor.document().camera, direction, std::min(seconds, 0.2f)), "Fly", "camera.fly");
}

void let_go(Workbench& w, Hold& hold) {
  const size_t button = hold.grip == Hold::Grip::fly ? 1 : w.input.buttons[2] ? 2 : 0;
  if (w.input.buttons[button] || (hold.grip == Hold::Grip::pan && w.input.buttons[2])) return;
  if (hold.grip == Hold::Grip::orbit && !hold.moved) click(w, hold, hold.start);
  if (hold.grip == Hold::Grip::fly && hold.moved)
    if (const auto scene = w.session.scene()) {
      const float speed = w.hand.speed();
      w.hand.find_pivot(w.editor.document().camera, *scene);
      w.hand.set_speed(speed);
    }
  hold.grip = Hold::Grip::none;
  w.editor.end_gesture();
}

void wheel(Workbench& w, Hold& hold) {
  if (hold.grip == Hold::Grip::fly) return w.hand.set_speed(w.hand.speed() * std::pow(1.25f, w.input.wheel));
  const auto picked = picked_at(w, w.input.mouse);
  if (seconds_since(hold.wheeled) > kWheelGesture) w.editor.end_gesture();
  hold.wheeled = Clock::now();
  w.edit_camera(w.hand.dolly(w.editor.document().camera, picked ? picked->position : w.hand.pivot(), w.input.wheel),
                "Dolly", "camera.dolly");
}

void outline(const Workbench& w, ImDrawList* draw) {
  const auto scene = w.session.scene();
  if (w.selection.node < 0 || !scene || w.view.picture.size.x < 2) return;
  const Bounds b = bounds_of_node(*scene, w.selection.node);
  if (b.empty()) return;
  const auto corner = [&](int i) {
    return Vec3(i & 1 ? b.max.x : b.min.x, i & 2 ? b.max.y : b.min.y, i & 4 ? b.max.z : b.min.z);
  };
  // It lies on the picture, whose brightness no theme knows: a bright line in a dark one is seen on everything.
  struct Stroke {
    ImU32 color;
    float width;
  };
  for (const Stroke& stroke : {Stroke{IM_COL32(0, 0, 0, 140), 3.5f}, Stroke{IM_COL32(120, 190, 240, 255), 1.5f}})
    for (int i = 0; i < 8; ++i)
      for (int bit : {1, 2, 4}) {
        if (i & bit) continue;
        const auto from = project(w.editor.document().camera, w.view.picture, corner(i));
        const auto to = project(w.editor.document().camera, w.view.picture, corner(i | bit));
        if (from && to) draw->AddLine({from->x, from->y}, {to->x, to->y}, stroke.color, stroke.width);
      }
}

// The scale of false colour, with the luminances at its ends and in between.
void legend(const Workbench& w, ImDrawList* draw) {
  const Vec2 stops = false_color_stops(w.editor.document().display.exposure);
  std::string figures[5];
  for (int i = 0; i <= 4; ++i)
    figures[i] =
        text_of("%.2g", static_cast<double>(std::exp2(stops.x + (stops.y - stops.x) * static_cast<float>(i) / 4)));
  draw_scale_bar(w, draw, viridis, figures, "luminance, W/(m\u00b2 sr)");
}

std::string layer_label(const Workbench& w) {
  const AovPicture& shown = w.aov.picture();
  if (shown.name != w.view.aov) return w.view.aov + " ...";
  return shown.scale.empty() ? w.view.aov + (w.aov.busy() ? " ..." : "") : w.view.aov + ", " + shown.scale;
}

// Dark rims keep them apart from the picture and from each other.
void points(const Workbench& w, ImDrawList* draw) {
  const SeenPoints* seen = w.points.shown();
  if (!seen || w.shows_layer()) return;
  const Placement& p = w.view.picture;
  const Vec2 scale = p.size / Vec2(w.editor.document().width, w.editor.document().height);
  const float half = std::max(1.0f, ImGui::GetFontSize() * (seen->points.size() > 2000 ? 0.07f : 0.14f));
  for (const SeenPoint& point : seen->points) {
    const Vec2 at = p.corner + point.raster * scale;
    const ImU32 color =
        ImGui::ColorConvertFloat4ToU32({std::sqrt(point.tint.r), std::sqrt(point.tint.g), std::sqrt(point.tint.b), 1});
    draw->AddRectFilled({at.x - half - 1, at.y - half - 1}, {at.x + half + 1, at.y + half + 1}, IM_COL32(0, 0, 0, 150));
    draw->AddRectFilled({at.x - half, at.y - half}, {at.x + half, at.y + half}, color);
  }
  const std::string words =
      seen->kept == 0 ? w.editor.document().method.integrator + " keeps nothing in space"
                      : text_of("%zu points of light, %zu of them seen here", seen->kept, seen->points.size());
  const float em = ImGui::GetFontSize();
  draw_label(draw, Vec2(p.corner.x + em * 0.6f, p.corner.y + p.size.y - em * 0.6f - label_size(words).y), words);
}

// Why the picture is black, in its middle.
void obstacle_notice(const Workbench& w, ImDrawList* draw) {
  const std::string text = w.incompatibility();
  if (text.empty() || w.shows_layer()) return;
  const Placement& p = w.view.picture;
  const float em = ImGui::GetFontSize(), width = std::min(em * 26, w.view.region.size.x - 2 * em);
  const ImVec2 words = ImGui::CalcTextSize(text.c_str(), nullptr, false, width);
  const Vec2 corner = glm::floor(p.corner + (p.size - Vec2(words.x, words.y)) * 0.5f), margin(em * 0.7f, em * 0.5f);
  const Vec2 from = corner - margin, to = corner + Vec2(words.x, words.y) + margin;
  draw->AddRectFilled({from.x, from.y}, {to.x, to.y}, ImGui::GetColorU32(ImGuiCol_WindowBg, 0.92f), em * 0.25f);
  draw->AddRect({from.x, from.y}, {to.x, to.y}, ImGui::GetColorU32(w.theme.warning), em * 0.25f);
  draw->AddText(ImGui::GetFont(), em, {corner.x, corner.y}, ImGui::GetColorU32(ImGuiCol_Text), text.c_str(), nullptr,
                width);
}

}  // namespace

void handle_viewport(Workbench& w, float seconds) {
  static Hold hold;  // one pointer
  if (w.editor.empty()) return;
  const bool over = !ImGui::GetIO().WantCaptureMouse && w.view.region.contains(w.input.mouse);
  const bool divides = hold.grip == Hold::Grip::none && handle_divider(w, over);
  if (hold.grip == Hold::Grip::none && over && !divides) grab(w, hold);
  if (hold.grip != Hold::Grip::none) {
    drag(w, hold);
    if (hold.grip == Hold::Grip::fly) fly(w, seconds);
    let_go(w, hold);
  }
  if (w.input.wheel != 0 && (over || hold.grip == Hold::Grip::fly)) wheel(w, hold);
}

void draw_viewport_overlay(Workbench& w) {
  if (w.editor.empty()) return;
  ImDrawList* draw = ImGui::GetBackgroundDrawList();
  const Placement& r = w.view.region;
  draw->PushClipRect({r.corner.x, r.corner.y}, {r.corner.x + r.size.x, r.corner.y + r.size.y});
  if (w.view.interface) outline(w, draw);
  if (w.view.health_map)
    if (const auto health = w.session.status().health) draw_health_map(w, *health, draw);
  if (w.view.points) points(w, draw);
  const bool map = w.comparison.map() && !w.comparison.reference_on_screen();
  if (w.view.false_color && w.view.aov.empty() && !map) legend(w, draw);
  draw_comparison_overlay(w, draw);
  draw_pixel_marker(w, draw);
  draw_meter_marker(w, draw);
  if (w.view.interface) obstacle_notice(w, draw);
  if (!w.view.aov.empty()) draw_label(draw, w.view.picture.corner + Vec2(ImGui::GetFontSize() * 0.5f), layer_label(w));
  draw->PopClipRect();
}

}  // namespace etendue::viewer
