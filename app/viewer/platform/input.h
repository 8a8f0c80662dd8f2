// What a user's hands do, from a real window or from a script, in one queue.
//
// Dear ImGui 1.86 looks at the state of buttons and keys once a frame: a press and a release between two looks are
// lost. The queue therefore hands out events only up to the second change of the same button or key; the rest waits for
// the next frame.
#pragma once
#include <array>
#include <bitset>
#include <deque>
#include <mutex>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/vec.h"

namespace etendue::viewer {

enum class Button : uint8_t { left, right, middle };

// Keys go by GLFW's numbers, also where there is no GLFW.
inline constexpr int kKeys = 512;

struct Event {
  enum class Type : uint8_t { move, button, scroll, key, text, drop, leave, redraw };
  Type type = Type::move;
  Vec2 position{0};  // pixels from the upper left corner of the window; the amount, for scroll
  Button button = Button::left;
  int key = 0;
  bool down = false;
  unsigned character = 0;
  std::string file{};
};

// The state at a frame, and what changed since the last.
struct Input {
  Vec2 mouse{-1e6f};
  std::array<bool, 3> buttons{};
  std::array<bool, 3> pressed{};  // went down in this frame
  float wheel = 0;
  std::bitset<kKeys> keys, keys_pressed;
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
  // Brings `input` to the next frame; true if anything happened.
  bool take_frame(Input& input);

 private:
  mutable std::mutex mutex_;
  std::deque<Event> events_;
};

// A chord as it is written: "ctrl+shift+z", "f1", "home", "[".
struct Chord {
  int key = 0;
  bool control = false, shift = false, alt = false;

  // Whether the key went down in this frame with exactly these modifiers.
  bool pressed(const Input& input) const;
  friend bool operator==(const Chord&, const Chord&) = default;
};
Result<Chord> parse_chord(const std::string& text);
// "Ctrl+Shift+Z", for menus.
std::string label(const Chord& chord);

}  // namespace etendue::viewer
