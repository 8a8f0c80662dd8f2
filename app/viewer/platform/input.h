// Pointer and keyboard events, from a window or from a script, in one queue.
//
// Dear ImGui 1.86 samples the state of buttons and keys once per frame, so a press and a release within one frame would
// be lost. The queue therefore delivers events up to the second change of the same button or key. A button and a key
// that is not a modifier do not change in the same frame, which keeps their order, and a button is pressed in a frame in
// which the pointer rests. The rest is delivered in the next frame.
#pragma once
#include <array>
#include <bitset>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/vec.h"

namespace etendue::viewer {

enum class Button : uint8_t { left, right, middle };

// Key codes are those of GLFW, also off-screen.
inline constexpr int kKeys = 512;

struct Event {
  enum class Type : uint8_t { move, button, scroll, key, text, drop, leave, redraw };
  Type type = Type::move;
  Vec2 position{0};  // pixels from the upper left corner of the window; for `scroll` the number of notches
  Button button = Button::left;
  int key = 0;
  bool down = false;
  unsigned character = 0;
  std::string file{};
};

// The input of one frame: the state of all buttons and keys, and the changes since the previous frame.
struct Input {
  Vec2 mouse{-1e6f};
  std::array<bool, 3> buttons{};
  std::array<bool, 3> pressed{};  // buttons that went down in this frame
  float wheel = 0;
  std::bitset<kKeys> keys;
  std::bitset<kKeys> keys_pressed;  // keys that went down in this frame
  std::vector<unsigned> text;
  std::vector<std::string> dropped;

  bool shift() const;
  bool control() const;
  bool alt() const;
};

class EventQueue {
 public:
  void push(Event event);
  bool empty() const;
  // Updates `input` for the next frame. Returns true if there was an event.
  bool take_frame(Input& input);

 private:
  mutable std::mutex mutex_;
  std::deque<Event> events_;
};

// A key with modifiers: "ctrl+shift+z", "f1", "home", "[".
struct Chord {
  int key = 0;
  bool control = false, shift = false, alt = false;

  // Returns whether the key went down in this frame with exactly these modifiers.
  bool pressed(const Input& input) const;
  friend bool operator==(const Chord&, const Chord&) = default;
};
// An unknown key or modifier is a usage error.
Result<Chord> parse_chord(const std::string& text);
// The chord as parse_chord reads it; empty if it cannot.
std::string shortcut_text(const Chord& chord);
// The key that went down in this frame with its modifiers; nothing if none or only a modifier did.
std::optional<Chord> pressed_chord(const Input& input);
// The chord as menus show it: "Ctrl+Shift+Z".
std::string label(const Chord& chord);
// Several chords, separated by commas.
std::string label(const std::vector<Chord>& chords);

}  // namespace etendue::viewer
