#include "viewer/platform/input.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <cctype>
#include <utility>

namespace etendue::viewer {
namespace {

struct KeyName {
  const char* name;   // in scripts
  const char* label;  // in menus
  int key;
};

constexpr KeyName kNames[] = {
    {"space", "Space", GLFW_KEY_SPACE},
    {"tab", "Tab", GLFW_KEY_TAB},
    {"enter", "Enter", GLFW_KEY_ENTER},
    {"escape", "Esc", GLFW_KEY_ESCAPE},
    {"home", "Home", GLFW_KEY_HOME},
    {"end", "End", GLFW_KEY_END},
    {"delete", "Delete", GLFW_KEY_DELETE},
    {"backspace", "Backspace", GLFW_KEY_BACKSPACE},
    {"left", "Left", GLFW_KEY_LEFT},
    {"right", "Right", GLFW_KEY_RIGHT},
    {"up", "Up", GLFW_KEY_UP},
    {"down", "Down", GLFW_KEY_DOWN},
    {"f1", "F1", GLFW_KEY_F1},
    {"f2", "F2", GLFW_KEY_F2},
    {"f3", "F3", GLFW_KEY_F3},
    {"f4", "F4", GLFW_KEY_F4},
    {"f5", "F5", GLFW_KEY_F5},
    {"f6", "F6", GLFW_KEY_F6},
    {"f7", "F7", GLFW_KEY_F7},
    {"f8", "F8", GLFW_KEY_F8},
    {"f9", "F9", GLFW_KEY_F9},
    {"f10", "F10", GLFW_KEY_F10},
    {"f12", "F12", GLFW_KEY_F12},
    {"shift", "Shift", GLFW_KEY_LEFT_SHIFT},
    {"ctrl", "Ctrl", GLFW_KEY_LEFT_CONTROL},
    {"alt", "Alt", GLFW_KEY_LEFT_ALT},
    {"f11", "F11", GLFW_KEY_F11},
    {"pageup", "Page up", GLFW_KEY_PAGE_UP},
    {"pagedown", "Page down", GLFW_KEY_PAGE_DOWN},
};

bool is_modifier(int key) { return key >= GLFW_KEY_LEFT_SHIFT && key <= GLFW_KEY_RIGHT_SUPER; }

}  // namespace

bool Input::shift() const { return keys[GLFW_KEY_LEFT_SHIFT] || keys[GLFW_KEY_RIGHT_SHIFT]; }
bool Input::control() const { return keys[GLFW_KEY_LEFT_CONTROL] || keys[GLFW_KEY_RIGHT_CONTROL]; }
bool Input::alt() const { return keys[GLFW_KEY_LEFT_ALT] || keys[GLFW_KEY_RIGHT_ALT]; }

void EventQueue::push(Event event) {
  const std::lock_guard lock(mutex_);
  events_.push_back(std::move(event));
}

bool EventQueue::empty() const {
  const std::lock_guard lock(mutex_);
  return events_.empty();
}

bool EventQueue::take_frame(Input& input) {
  const std::lock_guard lock(mutex_);
  input.pressed = {};
  input.keys_pressed.reset();
  input.wheel = 0;
  input.text.clear();
  input.dropped.clear();
  const bool any = !events_.empty();
  std::array<bool, 3> changed{};
  std::bitset<kKeys> keys_changed;
  bool has_moved = false, button_changed = false, key_pressed = false, pressed_any = false;
  while (!events_.empty()) {
    const Event& e = events_.front();
    const auto b = static_cast<size_t>(e.button);
    const auto k = static_cast<size_t>(e.key);
    if (e.type == Event::Type::button && changed[b]) break;
    if (e.type == Event::Type::key && (k >= kKeys || keys_changed[k])) {
      if (k < kKeys) break;
      events_.pop_front();
      continue;
    }
    // A key press keeps the modifiers that were down at that moment.
    if (e.type == Event::Type::key && is_modifier(e.key) && pressed_any) break;
    // A button event keeps the pointer position of that moment.
    if (e.type == Event::Type::move && button_changed) break;
    // Dear ImGui ignores a press on a tab if the pointer was on another item in the frame before.
    if (e.type == Event::Type::button && e.down && has_moved) break;
    // Escape after a click must find the menu that the click has opened, and a click after Escape the closed menu.
    const bool presses_key = e.type == Event::Type::key && e.down && !is_modifier(e.key);
    if ((presses_key && button_changed) || (e.type == Event::Type::button && key_pressed)) break;
    switch (e.type) {
      case Event::Type::move:
        has_moved = true;
        input.mouse = e.position;
        break;
      case Event::Type::leave:
        input.mouse = Vec2(-1e6f);
        break;
      case Event::Type::button:
        changed[b] = button_changed = true;
        pressed_any |= e.down;
        input.pressed[b] = e.down && !input.buttons[b];
        input.buttons[b] = e.down;
        break;
      case Event::Type::scroll:
        input.wheel += e.position.y;
        break;
      case Event::Type::key:
        keys_changed[k] = true;
        key_pressed |= presses_key;
        pressed_any |= presses_key;
        input.keys_pressed[k] = e.down && !input.keys[k];
        input.keys[k] = e.down;
        break;
      case Event::Type::text:
        input.text.push_back(e.character);
        break;
      case Event::Type::drop:
        input.dropped.push_back(e.file);
        break;
      case Event::Type::redraw:
        break;
    }
    events_.pop_front();
  }
  return any;
}

bool Chord::pressed(const Input& input) const {
  return key > 0 && input.keys_pressed[static_cast<size_t>(key)] && input.control() == control &&
         input.shift() == shift && input.alt() == alt;
}

Result<Chord> parse_chord(const std::string& text) {
  Chord chord;
  size_t at = 0;
  while (true) {
    const size_t plus = text.find('+', at);
    const bool last = plus == std::string::npos || plus + 1 >= text.size();
    std::string word = text.substr(at, last ? std::string::npos : plus - at);
    for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (last) {
      if (word.size() == 1) chord.key = std::toupper(static_cast<unsigned char>(word[0]));
      // On most keyboards the question mark is Shift and slash.
      if (word == "?") {
        chord.key = GLFW_KEY_SLASH;
        chord.shift = true;
      }
      for (const auto& name : kNames)
        if (word == name.name) chord.key = name.key;
      if (chord.key > 0 && chord.key < kKeys) return chord;
      return usage_error("'" + text +
                         "' is not a key; use a character, f1, space, tab, enter, escape, home or an arrow key, "
                         "optionally after ctrl+, shift+ or alt+");
    }
    if (word == "ctrl")
      chord.control = true;
    else if (word == "shift")
      chord.shift = true;
    else if (word == "alt")
      chord.alt = true;
    else
      return usage_error("'" + text + "': '" + word + "' is not a modifier; use ctrl, shift or alt");
    at = plus + 1;
  }
}

std::string shortcut_text(const Chord& chord) {
  std::string key;
  for (const auto& name : kNames)
    if (chord.key == name.key) key = name.name;
  const bool is_printable = chord.key > GLFW_KEY_SPACE && chord.key < 127;
  if (key.empty() && is_printable) key = static_cast<char>(std::tolower(chord.key));
  if (key.empty()) return "";
  return std::string(chord.control ? "ctrl+" : "") + (chord.shift ? "shift+" : "") + (chord.alt ? "alt+" : "") + key;
}

std::optional<Chord> pressed_chord(const Input& input) {
  for (int key = 0; key < kKeys; ++key)
    if (input.keys_pressed[static_cast<size_t>(key)] && !is_modifier(key))
      return Chord{.key = key, .control = input.control(), .shift = input.shift(), .alt = input.alt()};
  return std::nullopt;
}

std::string label(const Chord& chord) {
  if (chord.key == 0) return "";
  std::string text;
  if (chord.control) text += "Ctrl+";
  if (chord.alt) text += "Alt+";
  if (chord.key == GLFW_KEY_SLASH && chord.shift) return text + "?";
  if (chord.shift) text += "Shift+";
  for (const auto& name : kNames)
    if (chord.key == name.key) return text + name.label;
  return text + static_cast<char>(chord.key);
}

std::string label(const std::vector<Chord>& chords) {
  std::string text;
  for (const Chord& chord : chords) text += (text.empty() ? "" : ", ") + label(chord);
  return text;
}

}  // namespace etendue::viewer
