// What am I looking at, and how do I get around it? Hands on the picture, and what is drawn over it.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <chrono>

#include "spectrum/colormap.h"
#include "viewer/panels.h"
#include "viewer/widgets.h"

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

void click(Workbench& w, Hold& hold, Vec2 at) {
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

// Figures whose upper edge has its middle at `at`; letters of another size would blur.
void centred(const Workbench& w, ImDrawList* draw, Vec2 at, const char* text) {
  ImFont* font = w.faces.figures;
  const float width = font->CalcTextSizeA(font->FontSize, 1e6f, 0, text).x;
  draw->AddText(font, font->FontSize, {at.x - width * 0.5f, at.y}, ImGui::GetColorU32(ImGuiCol_Text), text);
}

void color_bar(ImDrawList* draw, Vec2 corner, Vec2 size) {
  constexpr int kSteps = 64;
  for (int i = 0; i < kSteps; ++i) {
    const Rgb c = viridis((static_cast<float>(i) + 0.5f) / kSteps);
    const float x = corner.x + size.x * static_cast<float>(i) / kSteps;
    draw->AddRectFilled({x, corner.y}, {x + size.x / kSteps + 1, corner.y + size.y},
                        ImGui::GetColorU32({c.r, c.g, c.b, 1}));
  }
}

// The scale of false colour, with the luminances at its ends and in between.
void legend(const Workbench& w, ImDrawList* draw) {
  const float em = ImGui::GetFontSize();
  const float margin = em * 2;  // half of the widest figure stands out at both ends
  const Placement& p = w.view.picture;
  const Vec2 size(em * 16, em * 0.8f);
  const Vec2 corner(p.corner.x + p.size.x - size.x - margin - em * 0.5f, p.corner.y + em * 1.2f);
  draw->AddRectFilled({corner.x - margin, corner.y - em * 0.6f},
                      {corner.x + size.x + margin, corner.y + size.y + em * 3.3f},
                      ImGui::GetColorU32(ImGuiCol_PopupBg, 0.9f), 4);
  color_bar(draw, corner, size);
  const Vec2 stops = false_color_stops(w.editor.document().display.exposure);
  for (int i = 0; i <= 4; ++i) {
    const float at = static_cast<float>(i) / 4;
    char text[24];
    std::snprintf(text, sizeof text, "%.2g", static_cast<double>(std::exp2(stops.x + (stops.y - stops.x) * at)));
    centred(w, draw, {corner.x + size.x * at, corner.y + size.y + em * 0.4f}, text);
  }
  centred(w, draw, {corner.x + size.x * 0.5f, corner.y + size.y + em * 1.8f}, "luminance, W/(m\u00b2 sr)");
}

}  // namespace

void handle_viewport(Workbench& w, float seconds) {
  static Hold hold;  // one pointer
  if (w.editor.empty()) return;
  const bool over = !ImGui::GetIO().WantCaptureMouse && w.view.region.contains(w.input.mouse);
  if (hold.grip == Hold::Grip::none && over) grab(w, hold);
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
  if (w.view.false_color && w.view.aov.empty()) legend(w, draw);
  if (!w.view.aov.empty()) {
    const float em = ImGui::GetFontSize();
    const std::string text = w.view.aov + (w.aov.busy() ? " ..." : "");
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const ImVec2 at{w.view.picture.corner.x + em, w.view.picture.corner.y + em};
    draw->AddRectFilled({at.x - em * 0.5f, at.y - em * 0.3f}, {at.x + size.x + em * 0.5f, at.y + size.y + em * 0.3f},
                        ImGui::GetColorU32(ImGuiCol_PopupBg, 0.9f), 4);
    draw->AddText(at, ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
  }
  draw->PopClipRect();
}

}  // namespace etendue::viewer
